// A piston that left a gas no room struck its discs ever faster, and a run under events never ended: there is no last
// blow before the discs are as near as they can be.

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

}  // namespace
}  // namespace carom
