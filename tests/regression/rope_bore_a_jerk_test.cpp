// Joints were held against what they bore in the last substep of a step: of ropes that bear 20 N one in four broke when
// a stone had fallen a metre and more.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(Jerk, BreaksARopeWheneverItComes) {
    for (int i = 0; i < 20; ++i) {
        World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
        const BodyId stone = world.add(Body{.mass = 1, .radius = 0.05});
        const DistanceJoint rope{.limits = {.upper = 1 + 0.05 * i}};
        const JointId weak = world.add(Joint{.b = stone, .type = rope, .break_force = 500});
        run(world, 1, 1.0 / 60);
        EXPECT_FALSE(world.contains(weak)) << rope.limits.upper.value();
    }
}

TEST(Jerk, BreaksAHingeAtItsLimit) {
    for (int i = 0; i < 20; ++i) {
        World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
        const BodyId stone = world.add(Body{.position = {1 + 0.01 * i, 0}, .mass = 1, .radius = 0.05});
        const JointId weak = world.add(
            Joint{.b = stone, .at = Vec2{}, .type = RevoluteJoint{.limits = {.lower = -1}}, .break_torque = 100});
        run(world, 2, 1.0 / 60);
        EXPECT_FALSE(world.contains(weak)) << i;
    }
}

}  // namespace
}  // namespace carom
