// The ground is the last of the solver's movers. Where the last body was removed, the ground had that body's velocity
// in the sums of what contacts do: the floor was taken for driven, and did work of -100 J in a step.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom::test {
namespace {

void slide(bool precise) {
    World world({.gravity = {0, -10}, .solver = SoftStep{.precise = precise ? Precise::all : Precise::some}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    Body box{.position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.5};
    box.velocity.x = 3;
    for (int i = 0; i < 30; ++i, box.position.x += 2) world.add(box);
    const BodyId bird = world.add(Body{.position = {0, 50}, .velocity = {40, 0}, .radius = 0.5});
    world.step(1.0 / 60);
    world.remove(bird);
    world.step(1.0 / 60);
    const Energy e = energy(world);
    // A few nm of overlap are undone: µg times nm, and not 100 J.
    EXPECT_EQ(e.work.driven, 0);
    EXPECT_LT(e.work.total(), 1e-6);
    EXPECT_GT(e.heat.friction, 0);
}

TEST(RemovedBody, LeavesNoWind) {
    slide(false);
    slide(true);
}

}  // namespace
}  // namespace carom::test
