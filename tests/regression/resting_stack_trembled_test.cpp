// What a solve left of the velocities of bodies at rest became a force of the next one, which was taken back by
// another, and so on: a stack trembled by 1e-11 m/s, and half of its solves had to be done anew.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <vector>

namespace carom {
namespace {

TEST(RestingStack, IsAtRestToTheBit) {
    World world({.gravity = {0, -10}, .solver = SoftStep{.sleep = false}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
    for (int i = 0; i < 10; ++i)
        world.add(Body{.position = {0.01 * (i % 3), 0.5 + i},
                       .mass = i < 9 ? 1.0 : 1000,
                       .shapes = {{.geometry = Box{1, 1}}},
                       .restitution = 0,
                       .friction = 0.6});
    for (int i = 0; i < 300; ++i) world.step(1.0 / 60);
    const std::vector<Vec2> places(world.positions().begin(), world.positions().end());
    for (int i = 0; i < 60; ++i) {
        world.step(1.0 / 60);
        for (std::size_t k = 0; k < places.size(); ++k) {
            EXPECT_EQ(world.velocities()[k], Vec2{});
            EXPECT_EQ(world.angular_velocities()[k], 0);
            EXPECT_EQ(world.positions()[k], places[k]);
        }
    }
}

}  // namespace
}  // namespace carom
