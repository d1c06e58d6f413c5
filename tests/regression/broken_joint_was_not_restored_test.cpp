// A state from before a joint broke could not be restored into the same world, which did not know the joint any more.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "restored.hpp"

namespace carom {
namespace {

TEST(BrokenJoint, IsThereAgainInAStateFromBefore) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    const BodyId stone = world.add(Body{.mass = 1, .radius = 0.05});
    const JointId rope =
        world.add(Joint{.name = "rope", .b = stone, .type = DistanceJoint{.limits = {.upper = 1}}, .break_force = 20});
    const JointId other = world.add(Joint{.b = stone, .type = FrictionJoint{0.1, 0}});
    run(world, 0.2, 1.0 / 60);
    const std::string before = test::saved(world);
    run(world, 1, 1.0 / 60);
    ASSERT_FALSE(world.contains(rope));
    const std::string after = test::saved(world);

    for (int i = 0; i < 2; ++i) {
        Loader from_before(before);
        world.restore(from_before);
        ASSERT_TRUE(world.contains(rope));
        EXPECT_EQ(world.joint(rope).name, "rope");
        EXPECT_TRUE(world.contains(other));
        EXPECT_EQ(test::saved(world), before);
        if (i == 0) {  // it breaks again,
            run(world, 1, 1.0 / 60);
            EXPECT_EQ(test::saved(world), after);
        } else {  // or a state is taken in which it has
            Loader from_after(after);
            world.restore(from_after);
            EXPECT_FALSE(world.contains(rope));
        }
    }
}

// A number that was given after the state that is restored is given again, to another joint.
TEST(BrokenJoint, IsNotTakenForAnotherOfItsNumber) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    const BodyId stone = world.add(Body{.mass = 1, .radius = 0.05});
    const std::string before = test::saved(world);
    const DistanceJoint rope{.limits = {.upper = 0.1}};
    const JointId weak = world.add(Joint{.b = stone, .type = rope, .break_force = 1});
    run(world, 1, 1.0 / 60);
    ASSERT_FALSE(world.contains(weak));
    Loader from(before);
    world.restore(from);
    const JointId strong = world.add(Joint{.b = stone, .type = rope});
    EXPECT_EQ(strong, weak);
    run(world, 1, 1.0 / 60);
    const std::string held = test::saved(world);
    Loader again(held);
    world.restore(again);
    EXPECT_TRUE(world.contains(strong));
}

}  // namespace
}  // namespace carom
