// Sums over a world.
#include <gtest/gtest.h>

#include <carom/analysis.hpp>

#include "error_of.hpp"

using namespace carom;
using test::error_of;

TEST(CentreOfMass, IsThatOfTheDynamicBodies) {
    World world;
    world.add(Body{.position = {0, 0}, .mass = 1});
    world.add(Body{.position = {4, 2}, .mass = 3});
    world.add(Body{.kind = Kind::fixed, .position = {100, 100}, .mass = 50});
    EXPECT_EQ(centre_of_mass(world), (Vec2{3, 1.5}));
}

TEST(CentreOfMass, OfNoDynamicBodyIsAnError) {
    World world;
    world.add(Body{.kind = Kind::driven});
    EXPECT_EQ(error_of([&] { centre_of_mass(world); }),
              "centre_of_mass: the world must have a dynamic body, and has none");
}
