#include <gtest/gtest.h>

#include <carom/carom.hpp>

// A block of a million kilograms presses one of a kilogram against a wall: 3141 impacts, most within a millisecond.
// They were taken for a jam, and all the energy vanished without an account.

namespace carom {
namespace {

TEST(Regression, ElasticBlocksKeepTheirEnergyThroughThousandsOfImpactsAStep) {
    World world;
    world.add(HalfPlane{.normal = {1, 0}});
    world.add(Body{.position = {1, 0}, .mass = 1, .radius = 0.1});
    world.add(Body{.position = {2, 0}, .velocity = {-1, 0}, .mass = 1e6, .radius = 0.2});
    run(world, 8, 0.1);
    EXPECT_EQ(world.collisions(), 3141u);
    EXPECT_NEAR(energy(world).kinetic / 5e5, 1, 1e-11);  // 3141 roundings
}

TEST(Regression, AJamOfInelasticBlocksBooksItsHeat) {
    World world;
    world.add(HalfPlane{.normal = {1, 0}});
    world.add(Body{.position = {1, 0}, .mass = 1, .radius = 0.1, .restitution = 0.999});
    world.add(Body{.position = {2, 0}, .velocity = {-1, 0}, .mass = 1e6, .radius = 0.2, .restitution = 0.999});
    run(world, 8, 0.1);
    EXPECT_NEAR(energy(world).residual, 0, 1e-6);
}

}  // namespace
}  // namespace carom
