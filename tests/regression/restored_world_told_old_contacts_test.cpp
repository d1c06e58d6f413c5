// A restored world told the contacts that it had had before: a crate in flight was said to press on the floor.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "restored.hpp"

namespace carom {
namespace {

TEST(RestoredWorld, TellsNoContactsOfAnotherState) {
    for (const bool sleep : {false, true}) {
        World world({.gravity = {0, -9.81}, .solver = SoftStep{.sleep = sleep}});
        world.add(HalfPlane{});
        const BodyId crate =
            world.add(Body{.position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0});
        run(world, 2, 1.0 / 60);
        ASSERT_EQ(world.contacts().size(), 2);
        World flying = world;
        flying.set_position(crate, {0, 5}, 0);
        run(flying, 0.1, 1.0 / 60);
        test::restore_from(flying, world);
        EXPECT_TRUE(world.contacts().empty());
        for (int i = 0; i < 120; ++i) {
            flying.step(1.0 / 60), world.step(1.0 / 60);
            ASSERT_EQ(state_hash(flying), state_hash(world)) << i;
        }
        EXPECT_EQ(world.contacts().size(), 2);
    }
}

}  // namespace
}  // namespace carom
