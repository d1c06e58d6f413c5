// An elastic ball that a game had set down, but for a picometre, bounced fifty thousand times in a step, which took
// 35 ms.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

constexpr double g = 10, dt = 1.0 / 60, radius = 0.4, size = 2 * radius;

struct Bouncing {
    World world{{.gravity = {0, -g}, .solver = SoftStep{}}};
    BodyId ball;

    explicit Bouncing(double height) {
        world.add(HalfPlane{.side = {.restitution = 1}});
        ball = world.add(Body{.position = {0, radius + height}, .mass = 1, .radius = radius, .restitution = 1});
    }
};

TEST(HardlyBouncingBall, ComesToRest) {
    for (const double height : {1e-12, 1e-10}) {
        Bouncing low(height);
        for (int i = 0; i < 60; ++i) {
            const std::uint64_t before = low.world.collisions();
            low.world.step(dt);
            ASSERT_LE(low.world.collisions() - before, 10u) << height;
        }
        EXPECT_NEAR(low.world.position(low.ball).y, radius, 1e-9 * size);
        EXPECT_NEAR(energy(low.world).residual, -g * height, 1e-3 * g * height) << "the method lost it";
        EXPECT_NEAR(energy(low.world).unaccounted(), 0, 1e-15);
    }
}

TEST(HardlyBouncingBall, KeepsABounceOfAMicrometre) {
    const double height = 1e-6;
    Bouncing low(height);
    double highest = 0;
    for (int i = 0; i < 60; ++i) low.world.step(dt), highest = std::max(highest, low.world.position(low.ball).y - radius);
    EXPECT_EQ(energy(low.world).heat.impact, 0);
    // 1100 bounces on the rounding of a place, 1e-16 m, which shift an apex of 1e-6 m by 1e-7 of it at most.
    EXPECT_GT(highest, 0.9 * height);
    EXPECT_LT(highest, 1.001 * height);
}

}  // namespace
}  // namespace carom
