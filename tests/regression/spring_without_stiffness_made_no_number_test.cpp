// A joint's spring of stiffness −0, which is 0, and which a formula may well give, had an energy that was no number.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(SpringWithoutStiffness, IsTheSameWhateverTheSignOfItsZero) {
    const auto fallen = [](const JointType& type) {
        World world({.gravity = {0, -10}, .solver = SoftStep{}});
        const BodyId body = world.add(Body{.position = {1, 3}, .mass = 1, .radius = 0.1});
        world.add(Joint{.b = body, .type = type});
        EXPECT_EQ(energy(world).spring, 0);
        run(world, 0.1, 0.01);
        EXPECT_EQ(energy(world).spring, 0);
        EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-12) << "J, rounding of 10 steps of 30 J";
        return state_hash(world);
    };
    const auto rod = [](double stiffness) {
        return DistanceJoint{.spring = JointSpring{.stiffness = stiffness, .damping = 1}};
    };
    const auto handle = [](double stiffness) {
        return DragHandle{.spring = JointSpring{.stiffness = stiffness, .damping = 1}, .maximum = 5};
    };
    EXPECT_EQ(fallen(rod(-0.0)), fallen(rod(0.0)));
    EXPECT_EQ(fallen(handle(-0.0)), fallen(handle(0.0)));
}

}  // namespace
}  // namespace carom
