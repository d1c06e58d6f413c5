// Elastic discs with friction, and discs before a thermal wall, ended the run of an exact gas with "the gas is jammed":
// the rule against collapse knew a loss of energy by restitution alone. Of 60 pairs of a thousand to one 21 ended so.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "trials.hpp"

namespace carom {
namespace {

TEST(RoughDiscs, GoOnBetweenAHeavyOneAndACorner) {
    constexpr double side = 2.34, r = 0.49;
    for (const double mass : {1e3, 1e6})
        for (std::uint64_t seed = 0; seed < test::trials(60); ++seed) {
            Random random(seed);
            const auto speed = [&random] { return 2 * random.uniform() - 1; };
            World world({.solver = Events{}});
            const Side wall{.friction = 0.3};
            world.add(Rectangle{{0, 0}, {side, side}, wall, wall, wall, wall});
            for (const double m : {mass, 1.0}) {
                const double at = m == 1 ? side - r - 0.1 * random.uniform() : r + 0.1 * random.uniform();
                world.add(Body{
                    .position = {at, at}, .velocity = {speed(), speed()}, .mass = m, .radius = r, .friction = 0.3});
            }
            EXPECT_NO_THROW(run(world, 20, 0.2)) << mass << ' ' << seed << ' ' << world.time();
            // Each blow rounds a few numbers no larger than the energy, by 1.1e-16.
            const double rounding = 4 * 1.1e-16 * static_cast<double>(world.collisions());
            EXPECT_NEAR(energy(world).unaccounted(), 0, rounding * energy(world).initial_total) << mass << ' ' << seed;
        }
}

TEST(DiscBeforeAThermalWall, TurnsAHeavyOneBack) {
    for (const double mass : {1e3, 1e6}) {
        World world({.solver = Events{}});
        const Side warm{.temperature = 1};
        world.add(Rectangle{.low = {0, 0}, .high = {1.5, 10}, .bottom = warm});
        const BodyId light = world.add(Body{.position = {0.75, 1}, .velocity = {0, 1}, .radius = 0.5});
        const BodyId heavy = world.add(Body{.position = {0.75, 4}, .velocity = {0, -10}, .mass = mass, .radius = 0.5});
        EXPECT_NO_THROW(run(world, 0.8, 0.1)) << mass;
        EXPECT_GT(world.velocity(heavy).y, 0);
        EXPECT_GT(world.position(light).y, 0.5 - 1e-9);
    }
}

}  // namespace
}  // namespace carom
