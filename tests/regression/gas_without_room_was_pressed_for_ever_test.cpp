// A piston that left a gas no room struck its discs ever faster, and a run under events never ended: there is no last
// blow before the discs are as near as they can be. Nor did that of a pendulum's bob that its rod, floor and wall held
// where it was deep in discs, and struck them wherever they turned: who presses was asked of driven bodies alone.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "error_of.hpp"

namespace carom {
namespace {

World pressed(int discs) {
    World world({.solver = Events{}});
    world.add(Rectangle{.low = {-1, 0}, .high = {2, 1}});
    world.add(Body{.kind = Kind::driven,
                   .position = {0, 0.5},
                   .velocity = {0.5, 0},
                   .shapes = {{.geometry = Segment{{0, -0.5}, {0, 0.5}}}},
                   .name = "piston"});
    Gas gas{.fill = {.low = {0.1, 0}, .high = {2, 1}, .count = discs, .smallest_radius = 0.05, .largest_radius = 0.05}};
    gas.temperature = 1;
    build(world, gas);
    return world;
}

TEST(GasWithoutRoom, EndsItsRunAndSaysWhoPresses) {
    for (const int discs : {2, 20}) {
        World world = pressed(discs);
        EXPECT_EQ(test::error_of([&] { run(world, 10, 0.05); }),
                  "the gas has no room left: body 'piston' presses it, and strikes it ever faster and more often");
        EXPECT_GT(world.time(), 3);  // twenty fit into a column of 0.2 m, which it has left at 3.6 s
        EXPECT_LT(world.time(), 4);
    }
}

TEST(GasWithoutRoom, EndsItsRunBesideWhatIsHeldInSteps) {
    World world({.gravity = {0, -1}, .solver = Events{}});
    world.add(Rectangle{.low = {-8, 0}, .high = {8, 12}});
    // Its rod has it come to lie on the floor at x = 7.28, and the wall stops it at 7.2.
    const BodyId bob = world.add(Body{.position = {6, 0}, .mass = 200, .radius = 0.8, .name = "bob"});
    world.add(Joint{.b = bob, .anchor_a = {0, 11}, .type = DistanceJoint{}});
    Gas gas{.fill = {.low = {6.9, 0}, .high = {8, 1}, .count = 8, .smallest_radius = 0.08, .largest_radius = 0.08}};
    gas.fill.seed = 7, gas.temperature = 2;
    build(world, gas);
    EXPECT_EQ(test::error_of([&] { run(world, 4, 0.05); }),
              "the gas has no room left: body 'bob' presses it, and strikes it wherever it turns, again and again");
}

// What is squeezed by a lid of finite mass throws it back in the end: it may be a hundred times as fast as at first.
TEST(GasWithoutRoom, IsNotWhatALidSqueezes) {
    for (const double mass : {20.0, 1e3, 1e6})
        for (const double restitution : {1.0, 0.9}) {
            World world({.gravity = {0, -9.81}, .solver = Events{}});
            world.add(Rectangle{.low = {0, 0}, .high = {10, 20}});
            const BodyId lid = world.add(Body{
                .position = {5, 6}, .mass = mass, .shapes = {{.geometry = Box{9.9, 1}}}, .restitution = restitution});
            world.add(Joint{.b = lid, .at = Vec2{5, 6}, .type = PrismaticJoint{.axis = {0, 1}}});
            Gas gas{
                .fill = {.low = {0, 0}, .high = {10, 5}, .count = 20, .smallest_radius = 0.2, .largest_radius = 0.2}};
            gas.temperature = 1;
            build(world, gas);
            EXPECT_NO_THROW(run(world, 1.5, 1.0 / 60)) << mass << ' ' << restitution;
            EXPECT_GT(world.position(lid).y, 0.5) << mass << ' ' << restitution;
        }
}

}  // namespace
}  // namespace carom
