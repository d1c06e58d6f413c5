// In a step of 1e-150 s the squares in the adaptive method's error underflowed, and zero over zero was no error small
// enough: "found no step short enough", or a run without end.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(Regression, TinyStepIsTaken) {
    for (const Pair pair : {Pair::dormand_prince54, Pair::dormand_prince853}) {
        for (const double step : {1e-100, 1e-150, 1e-200, 1e-300, 1e-308, 1.7e-313}) {
            World world({.gravity = {5, 5}, .integrator = Adaptive{.pair = pair}});
            world.add(Body{.velocity = {-2, 6}, .angular_velocity = 5});
            ASSERT_NO_THROW(world.step(step)) << step;
            EXPECT_EQ(world.time(), step);
        }
    }
}

}  // namespace
}  // namespace carom
