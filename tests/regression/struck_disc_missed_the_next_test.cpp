// Contacts were looked for in the room that bodies reach with the speed that they have at the start of a step: a disc
// that was struck in it flew into the next one, and they were found inside one another in the step after.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(StruckDisc, StrikesTheNextInTheSameStep) {
    World world({.solver = SoftStep{}});
    for (const double x : {0.0, 0.22, 0.62}) world.add(Body{.position = {x, 0}, .radius = 0.1});
    world.set_velocity(world.ids()[0], {20, 0}, 0);  // 0.33 m in a step; the gaps are 0.02 and 0.2 m
    world.step(1.0 / 60);
    EXPECT_EQ(world.collisions(), 2u);
    EXPECT_NEAR(world.positions()[1].x, 0.42, 1e-12);
    EXPECT_NEAR(world.positions()[2].x, 0.62 + 20.0 / 60 - 0.22, 1e-12);
    EXPECT_NEAR(world.velocities()[2].x, 20, 1e-12);
}

}  // namespace
}  // namespace carom
