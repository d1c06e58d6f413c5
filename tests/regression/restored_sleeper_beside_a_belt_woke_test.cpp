// A crate slept three centimetres beside a belt, which in short steps was too far to be looked at. A restored world
// looked at all who sleep again, in a longer step that sees farther, and woke it; the world that was saved let it
// sleep.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "restored.hpp"

namespace carom {
namespace {

World beside_a_belt() {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.friction = 0.5}});
    world.add(Body{.kind = Kind::fixed,
                   .position = {0, 0.2},
                   .shapes = {{.geometry = Box{2, 0.4}, .surface_speed = -1}},
                   .friction = 0.5});
    world.add(
        Body{.position = {1.23, 0.2}, .shapes = {{.geometry = Box{0.4, 0.4}}}, .restitution = 0, .friction = 0.5});
    return world;
}

TEST(RestoredSleeper, SleepsOnBesideABelt) {
    World world = beside_a_belt();
    const BodyId crate = world.ids()[1];
    run(world, 1, 1.0 / 240);
    ASSERT_TRUE(world.asleep(crate));
    World restored = beside_a_belt();
    test::restore_from(world, restored);
    for (World* one : {&world, &restored}) one->step(1.0 / 20);
    EXPECT_TRUE(world.asleep(crate));
    EXPECT_TRUE(restored.asleep(crate));
    EXPECT_EQ(restored.events(), world.events());
    EXPECT_EQ(state_hash(restored), state_hash(world));
}

}  // namespace
}  // namespace carom
