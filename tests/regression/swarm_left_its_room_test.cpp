// Blows of what does not bounce are shared with all that touches, for as long as the patience of a substep lasts; then
// contacts held without a blow, or where their corners turned fast not at all, walls too. Of 25 boxes of 5 cm at 100
// m/s in a room of 2 m up to five left through its walls in a second, of 300 m/s eleven.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/random.hpp>
#include <cmath>
#include <numbers>
#include <vector>

namespace carom {
namespace {

constexpr double half = 1, side = 0.05;

World room(bool of_chain) {
    World world({.solver = SoftStep{}});
    const auto wall = [](const Geometry& shape, const Pose& at) {
        return Body{.kind = Kind::fixed,
                    .position = at.position,
                    .angle = at.angle,
                    .shapes = {{.geometry = shape}},
                    .restitution = 0,
                    .friction = 0};
    };
    if (of_chain) {
        world.add(wall(Chain{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, true}, {}));
        return world;
    }
    constexpr double thick = 0.02;
    for (int k = 0; k < 4; ++k) {
        const double angle = k * std::numbers::pi / 2, away = half + thick / 2;
        world.add(wall(Box{thick, 2 * (half + thick)}, {{away * std::cos(angle), away * std::sin(angle)}, angle}));
    }
    return world;
}

TEST(SwarmThatDoesNotBounce, StaysInItsRoom) {
    constexpr double speed = 100;
    constexpr int count = 25;
    for (const bool of_chain : {true, false})
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            Random random(seed);
            World world = room(of_chain);
            std::vector<BodyId> bodies;
            while (bodies.size() < count) {
                const Vec2 at{random.uniform(side - half, half - side), random.uniform(side - half, half - side)};
                if (!world.shapes_touching(Disc{{}, 0.8 * side}, {at, 0}).empty()) continue;
                const double angle = random.uniform(0, 2 * std::numbers::pi);
                bodies.push_back(world.add(Body{.position = at,
                                                .angle = angle,
                                                .velocity = speed * Vec2{std::cos(angle), std::sin(angle)},
                                                .angular_velocity = random.uniform(-50, 50),
                                                .shapes = {{.geometry = Box{side, side}}},
                                                .restitution = 0,
                                                .friction = 0.2}));
            }
            run(world, 1, 1.0 / 60);
            for (const BodyId id : bodies) {
                EXPECT_LT(std::abs(world.position(id).x), half) << seed << of_chain;
                EXPECT_LT(std::abs(world.position(id).y), half) << seed << of_chain;
            }
        }
}

}  // namespace
}  // namespace carom
