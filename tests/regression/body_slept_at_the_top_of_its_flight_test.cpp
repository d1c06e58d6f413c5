// A ball thrown up on a small moon, in steps of a second, was at the top of its flight just as a step ended, and hung
// there for ever: a step as long as it takes to fall asleep was one of rest.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(Flight, GoesOnAfterATopAtTheEndOfALongStep) {
    constexpr double g = 0.25, up = 0.75, height = 10;  // numbers that steps of 0.5 and 1 s meet without rounding
    for (const double dt : {0.5, 1.0}) {
        World world({.gravity = {0, -g}, .solver = SoftStep{}});
        world.add(HalfPlane{});
        const BodyId ball = world.add(Body{.position = {0, height}, .velocity = {0, up}, .radius = 0.1});
        while (world.time() < 8) world.step(dt);
        const double t = world.time();
        EXPECT_FALSE(world.asleep(ball)) << dt;
        // A parabola is exact but for rounding.
        EXPECT_NEAR(world.position(ball).y, height + up * t - 0.5 * g * t * t, 1e-12) << dt;
    }
}

}  // namespace
}  // namespace carom
