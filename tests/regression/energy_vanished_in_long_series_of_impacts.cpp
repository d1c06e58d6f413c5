// More than 512 impacts of a body within a step were a jam: its velocity into the wall was dropped, in no account, and
// Galperin's blocks of 1 : 10⁶ lost all of their 5e5 J.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

using namespace carom;

TEST(EnergyVanished, InALongSeriesOfElasticImpacts) {
    // truth.json ed.galperin; most of the impacts lie within one step.
    const int counts[] = {3141, 31415};
    for (int n = 0; n < 2; ++n) {
        World world;
        world.add(HalfPlane{.normal = {1, 0}});
        world.add(Body{.position = {1, 0}, .radius = 0.1});
        world.add(Body{.position = {2, 0}, .velocity = {-1, 0}, .mass = 1e6 * std::pow(100, n), .radius = 0.1});
        run(world, 10, 1.0 / 60);
        EXPECT_EQ(world.collisions(), counts[n]);
        EXPECT_NEAR(energy(world).residual() / energy(world).total(), 0, 1e-12);
    }
}

TEST(EnergyVanished, InAnInelasticCollapse) {
    // truth.json ed.collapse3: below e = 0.0718 three discs on a line collide infinitely often and stay together.
    World world;
    for (int i = 0; i < 3; ++i)
        world.add(Body{.position = {1.5 * i, 0}, .velocity = {1. - i, 0}, .radius = 0.5, .restitution = 0.05});
    run(world, 5, 1.0 / 60);
    EXPECT_NEAR(energy(world).heat.impact, 1, 1e-12);
    EXPECT_NEAR(energy(world).residual(), 0, 1e-12);
    for (const Vec2 v : world.velocities()) EXPECT_NEAR(v.x, 0, 1e-9);
    EXPECT_NEAR(world.positions()[1].x - world.positions()[0].x, 1, 1e-9);
}
