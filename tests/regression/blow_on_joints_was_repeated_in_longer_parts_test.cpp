// Who hangs on joints and bounces cuts a substep where it strikes. A part after a short one began with the forces of
// that for its whole length: a blow in a thousandth of a second was given again a hundred times. Sweeps do not take all
// of it back beside joints, and what was left of it grew from part to part, in a room without any force.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(BlowOnJoints, IsNotRepeatedInALongerPartOfTheStep) {
    World world({.solver = SoftStep{.substeps = 1}});
    const auto disc = [&](Vec2 position, Vec2 velocity, double angular_velocity, double mass) {
        return world.add(Body{.position = position,
                              .velocity = velocity,
                              .angular_velocity = angular_velocity,
                              .mass = mass,
                              .radius = 0.1,
                              .restitution = 1,
                              .friction = 0.5});
    };
    const BodyId a = disc({0, 0}, {0.188, 8.76}, 17, 0.114);
    disc({0.21, 0.05}, {1.68, -2.53}, 6.4, 0.986);
    const BodyId b = disc({0.42, 0}, {4.62, -2.35}, 15.7, 0.757);
    world.add(Joint{.a = a, .b = b, .anchor_a = {4.66, -1.92}, .anchor_b = {-7.54, 4.21}, .type = WeldJoint{}});
    world.add(Rectangle{.low = {-1, -1}, .high = {2.5, 1}});
    const double before = energy(world).kinetic;
    for (int i = 0; i < 20; ++i) {
        world.step(i % 2 ? 0.02 : 0.06);
        EXPECT_LE(energy(world).kinetic, before) << i;  // it was 1.4 times as much, and in rooms like this 5e4 times
    }
}

}  // namespace
}  // namespace carom
