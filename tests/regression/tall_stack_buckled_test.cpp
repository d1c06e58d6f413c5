// Soft contacts give a column of boxes the stiffness of a soft beam: one of fifty buckled under its own weight and fell
// within 20 s.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(TallStack, OfFiftyStandsUpright) {
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
    for (int i = 0; i < 50; ++i)
        world.add(
            Body{.position = {0, 0.5 + i}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.6});
    run(world, 20, 1.0 / 60);
    for (int i = 0; i < 50; ++i) {
        EXPECT_NEAR(world.positions()[i].x, 0, 1e-3);
        EXPECT_NEAR(world.positions()[i].y, 0.5 + i, 1e-3);
    }
}

}  // namespace
}  // namespace carom
