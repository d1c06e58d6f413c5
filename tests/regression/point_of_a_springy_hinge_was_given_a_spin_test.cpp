// What took back the energy that joints' springs made slowed all bodies of the mechanism down towards its common
// motion, also the spin of a point, which has no inertia: it turned from then on, and wound up the spring for ever.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace {

using namespace carom;

TEST(PointOfASpringyHinge, IsGivenNoSpin) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    const BodyId box = world.add(Body{.position = {2, 2},
                                      .angular_velocity = 1,
                                      .shapes = {{.geometry = Box{1, 1}}},
                                      .restitution = 0,
                                      .friction = 1});
    const BodyId point = world.add(Body{.position = {0, 0.0005}, .restitution = 0, .friction = 1});
    world.add(Joint{
        .a = box, .b = point, .at = Vec2{0, 0.0005}, .type = RevoluteJoint{.spring = JointSpring{.stiffness = 1000}}});
    for (int i = 0; i < 60; ++i) {
        world.step(1.0 / 60);
        ASSERT_EQ(world.angular_velocity(point), 0) << "in step " << i;
        // Rounding of some 100 J.
        ASSERT_LT(std::abs(energy(world).unaccounted()), 1e-12) << "in step " << i;
    }
    EXPECT_EQ(energy(world).work.driven, 0);
}

}  // namespace
