// Among an exact gas a body whose joint broke was still taken for a part of its mechanism: the next disc that struck it
// ended the program. And a world restored after that had it hang in the air, for it took it for a disc of the gas,
// which had no flight of it.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "restored.hpp"

namespace carom {
namespace {

struct Bob {
    World world{{.gravity = {0, -1}, .solver = Events{}}};
    BodyId bob, disc;

    Bob() {
        world.add(Rectangle{.low = {0, 0}, .high = {4, 4}});
        bob = world.add(Body{.position = {2, 2}, .velocity = {1, 0}, .radius = 0.3});
        disc = world.add(Body{.position = {2, 1}, .velocity = {0.3, 2}, .radius = 0.2});
        world.add(Joint{.b = bob, .at = Vec2{2, 3}, .type = RevoluteJoint{}, .break_force = 0.1});
    }
    void step_until_it_breaks() {
        for (int i = 0; i < 100 && !world.joints().empty(); ++i) world.step(0.01);
        ASSERT_TRUE(world.joints().empty());
    }
};

TEST(JointBrokeAmongAGas, ItsBodyIsStruckAsAFreeOne) {
    Bob one;
    one.step_until_it_breaks();
    const std::uint64_t before = one.world.collisions();
    for (int i = 0; i < 300; ++i) one.world.step(0.01);
    EXPECT_GT(one.world.collisions(), before);
    EXPECT_TRUE(one.world.in_steps(one.bob));
    EXPECT_NEAR(energy(one.world).unaccounted(), 0, 1e-12);
}

TEST(JointBrokeAmongAGas, ARestoredWorldGoesOnWithTheSameBits) {
    Bob one;
    World other = one.world;
    one.step_until_it_breaks();
    test::restore_from(one.world, other);
    EXPECT_TRUE(other.in_steps(one.bob));
    for (int i = 0; i < 100; ++i) {
        one.world.step(0.01), other.step(0.01);
        ASSERT_EQ(state_hash(one.world), state_hash(other)) << i;
    }
}

TEST(JointBrokeAmongAGas, ItsBodyMayBeRemoved) {
    Bob one;
    World other = one.world;
    one.step_until_it_breaks();
    one.world.remove(one.bob);
    for (int i = 0; i < 100; ++i) one.world.step(0.01);
    test::restore_from(one.world, other);
    one.world.step(0.01), other.step(0.01);
    EXPECT_EQ(state_hash(one.world), state_hash(other));
}

}  // namespace
}  // namespace carom
