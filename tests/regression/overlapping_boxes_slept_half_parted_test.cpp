// Who was parted slowly passed for calm after half a second: forces were found that hold him as he is, and two boxes
// that had been put into one another by half slept there, a quarter apart.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

using namespace carom;

TEST(OverlappingBoxes, PartAndSleepBesideOneAnother) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.friction = 0.5}});
    const auto add = [&](double x) {
        return world.add(
            Body{.position = {x, 0.5}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.5});
    };
    const BodyId left = add(0), right = add(0.5);
    run(world, 10, 1.0 / 60);
    // What friction holds together gives way by less than 1/1000 of a box.
    EXPECT_NEAR(world.position(right).x - world.position(left).x, 1, 1e-3);
    EXPECT_TRUE(world.asleep(left) && world.asleep(right));
}
