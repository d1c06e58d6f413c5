// An elastic bounce shorter than 1/256 of a step came to rest, its energy booked as heat of an impact that loses none.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

TEST(Regression, LowElasticBounceCameToRest) {
    const double g = 10, step = 1.0 / 60, height = 1e-9;  // a flight of 28 µs, 1/600 of the step
    World world({.gravity = {0, -g}});
    world.add(HalfPlane{});
    const BodyId ball = world.add(Body{.position = {0, 0.5 + height}, .radius = 0.5});
    double highest = 0;
    for (int n = 0; n < 60; ++n) {
        world.step(step);
        highest = std::max(highest, world.position(ball).y - 0.5);
    }
    EXPECT_EQ(energy(world).heat.impact, 0);
    // 70 000 bounces on the rounding of a place, 1e-16 m, which shift an apex of 1e-9 m by a thousandth at most.
    EXPECT_GT(highest, 0.9 * height);
    EXPECT_LT(highest, 1.1 * height);
    EXPECT_GT(world.collisions(), 30000u);
}

TEST(Regression, FiniteNumbersWereCalledNotFinite) {
    // Their sum is infinite, they are not.
    World world({.solver = NoContact{}});
    world.add(Body{.position = {1e308, 1e308}});
    EXPECT_NO_THROW(world.step(1));
}

}  // namespace
}  // namespace carom
