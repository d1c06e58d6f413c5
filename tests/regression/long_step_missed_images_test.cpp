#include <gtest/gtest.h>

#include <carom/carom.hpp>

// In a step in which a body flew more than half a periodic box, only the image that was nearest at the step's start was
// looked at: the others were flown through.

namespace carom {
namespace {

World between_images(bool under_forces) {
    World world;
    world.add(Periodic{{-0.5, -0.5}, {0.5, 0.5}});
    world.add(Body{.kind = Kind::fixed, .radius = 0.1});
    const BodyId point = world.add(Body{.position = {0.3, 0}, .velocity = {1, 0}});
    if (under_forces) world.add(Drag{.body = point, .angular = 1});  // a point does not turn: it feels nothing
    return world;
}

TEST(Regression, LongStepsHitEveryImage) {
    for (const bool under_forces : {false, true}) {
        for (const double step : {0.1, 0.3, 0.5, 0.75, 0.9, 1.5, 3.0, 9.0}) {
            World world = between_images(under_forces);
            run(world, 9, step);
            // From 0.3 to 0.9 and then to and fro over 0.8: 11 impacts, the last at t = 8.6.
            EXPECT_EQ(world.collisions(), 11u) << step << (under_forces ? " under forces" : "");
            EXPECT_NEAR(world.positions()[1].x, 0.5, 1e-9) << step << (under_forces ? " under forces" : "");
        }
    }
}

}  // namespace
}  // namespace carom
