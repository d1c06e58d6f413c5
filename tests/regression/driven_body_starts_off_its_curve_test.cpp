// A body given a curve stayed where it was added until the first step: minima and means of a run began with a wrong
// place.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(Regression, DrivenBodyStartsOffItsCurve) {
    World world;
    const BodyId id = world.add(Body{.kind = Kind::driven});
    world.drive(id, [](double t) { return Pose{{3 + 2 * t, 0}, t}; });
    EXPECT_EQ(world.position(id).x, 3);
    EXPECT_NEAR(world.velocity(id).x, 2, 1e-12);  // five-point difference of a line: rounding alone
    EXPECT_NEAR(world.angular_velocity(id), 1, 1e-12);
}

}  // namespace
}  // namespace carom
