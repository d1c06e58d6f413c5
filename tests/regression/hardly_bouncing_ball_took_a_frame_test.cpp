// An elastic ball that was put on a floor, but for a rounding, or set down by a game, bounced on and on: fifty thousand
// times in a step of 'softstep', which took 35 ms, and four million times in one of 'impulse', which took up to 3 s.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

constexpr double g = 10, dt = 1.0 / 60, radius = 0.4, size = 2 * radius;

/// A ball of 1 kg over a floor or over a fixed ball, in the air or not.
struct Bouncing {
    World world;
    BodyId ball;

    Bouncing(Solver solver, double height, bool on_a_ball, bool in_air)
        : world({.gravity = {0, -g}, .solver = std::move(solver)}) {
        if (on_a_ball)
            world.add(Body{.kind = Kind::fixed, .position = {0, -1}, .radius = 1, .restitution = 1});
        else
            world.add(HalfPlane{.side = {.restitution = 1}});
        ball = world.add(Body{.position = {0, radius + height}, .mass = 1, .radius = radius, .restitution = 1});
        if (in_air) world.add(Drag{.linear = 1e-12});
    }
};

const std::pair<const char*, Solver> solvers[] = {{"softstep", SoftStep{}}, {"impulse", Impulse{}}};

TEST(HardlyBouncingBall, ComesToRest) {
    for (const auto& [name, solver] : solvers)
        for (const bool on_a_ball : {false, true})
            for (const bool in_air : {false, true})
                for (const double height : {1e-16, 1e-14, 1e-11}) {
                    Bouncing low(solver, height, on_a_ball, in_air);
                    for (int i = 0; i < 60; ++i) {
                        const std::uint64_t before = low.world.collisions();
                        low.world.step(dt);
                        ASSERT_LE(low.world.collisions() - before, 10u) << name << ' ' << on_a_ball << in_air << height;
                    }
                    EXPECT_NEAR(low.world.position(low.ball).y, radius, 1e-9 * size) << name;
                    const Energy end = energy(low.world);
                    constexpr double rounding = 1e-14;  // J, of a place of 0.4 m and a total of 4 J
                    EXPECT_GE(end.initial_total - end.total(), -rounding) << name;
                    EXPECT_LE(end.initial_total - end.total(), g * height + rounding) << name;
                    EXPECT_NEAR(end.unaccounted(), 0, 10 * rounding) << name;
                }
}

TEST(HardlyBouncingBall, KeepsABounceOfAMicrometre) {
    const double height = 1e-6;
    for (const auto& [name, solver] : solvers)
        for (const bool on_a_ball : {false, true}) {
            Bouncing low(solver, height, on_a_ball, false);
            double highest = 0;
            for (int i = 0; i < 60; ++i)
                low.world.step(dt), highest = std::max(highest, low.world.position(low.ball).y - radius);
            EXPECT_EQ(energy(low.world).heat.impact, 0) << name;
            // 1100 bounces on the rounding of a place, 1e-16 m, which shift an apex of 1e-6 m by 1e-7 of it at most.
            EXPECT_GT(highest, 0.9 * height) << name;
            EXPECT_LT(highest, 1.001 * height) << name;
        }
}

}  // namespace
}  // namespace carom
