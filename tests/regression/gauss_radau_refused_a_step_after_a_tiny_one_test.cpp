// After steps of 2e-10 and 2.2e-8 s Gauss-Radau found no step short enough in a smooth world: rounding had left 3e-25 s
// of the second one for a step of its own, whose polynomial, continued by 1e17 times its length, is beyond all numbers.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

World well_with_drag() {
    World world({.integrator = GaussRadau{}, .solver = NoContact{}});
    world.add(Body{.position = {4.3, 4.4}, .mass = 0.0266});
    world.add(Drag{.linear = 0.3, .quadratic = 0.0448});
    world.add(ForceField{.name = "well",
                         .force = [](Vec2 x, Vec2, double, double) { return -2 * x; },
                         .potential = [](Vec2 x, double, double) { return dot(x, x); },
                         .sees_velocity = false});
    return world;
}

TEST(GaussRadau, TakesAnyStepAfterATinyOne) {
    for (int i = -12; i < -2; ++i)
        for (int j = -12; j < -2; ++j) {
            const double first = std::pow(10, i), second = 1.1 * std::pow(10, j), third = 1.8e-4;
            World world = well_with_drag(), whole = well_with_drag();
            for (const double dt : {first, second, third}) world.step(dt);
            whole.step(first + second + third);
            // To the rounding of the place, and of velocities of some metres a second.
            EXPECT_NEAR(world.positions()[0].x, whole.positions()[0].x, 1e-14) << first << ' ' << second;
            EXPECT_NEAR(world.velocities()[0].x, whole.velocities()[0].x, 1e-13) << first << ' ' << second;
        }
    World world = well_with_drag();
    for (const double dt : {2e-10, 2.2e-8, 1.8e-4}) EXPECT_NO_THROW(world.step(dt));
}

}  // namespace
}  // namespace carom
