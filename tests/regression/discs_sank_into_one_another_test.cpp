// Discs at rest on discs were only put apart after a jam of 512 impacts, and not always then: a disc on another sank
// by 20 cm in 5 s.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

using namespace carom;

namespace {

World column(int size, double restitution) {
    World world({.gravity = {0, -9.81}});
    world.add(HalfPlane{});
    for (int i = 0; i < size; ++i)
        world.add(Body{.position = {0, 0.5 + i}, .radius = 0.5, .restitution = restitution, .friction = 0.5});
    return world;
}

}  // namespace

TEST(DiscsSank, NotAColumn) {
    for (const double restitution : {0.0, 0.5, 1.0})
        for (const int size : {2, 3, 5}) {
            World world = column(size, restitution);
            run(world, 5, 1.0 / 60);
            // What 100 sweeps leave of five discs that fell by ½ g h² = 1.4 mm in the step.
            for (int i = 0; i < size; ++i) EXPECT_NEAR(world.positions()[i].y, 0.5 + i, 1e-6) << size << restitution;
            EXPECT_NEAR(energy(world).residual(), 0, 1e-9);
            EXPECT_LT(world.collisions(), 10000u);  // 300 steps: no jams
        }
}

TEST(DiscsSank, NorOneThatIsStruckWhileItRests) {
    // The disc on top strikes within the step in which the others came to rest on one another.
    World world = column(2, 0.5);
    world.add(Body{.position = {0, 3}, .velocity = {0, -300}, .radius = 0.5, .restitution = 0.5, .friction = 0.5});
    for (int n = 0; n < 10; ++n) {
        world.step(1.0 / 60);
        for (const Vec2 x : world.positions()) EXPECT_GT(x.y, 0.5 - 1e-6);
        EXPECT_LT(world.positions()[0].y, world.positions()[1].y);
        EXPECT_LT(world.positions()[1].y, world.positions()[2].y);
    }
    EXPECT_NEAR(energy(world).residual(), 0, 1e-8);
}

TEST(DiscsSank, NorAGrainIntoItsPile) {
    World world({.gravity = {0, -9.81}});
    world.add(Rectangle{{0, 0}, {2, 10}});
    build(world, Gas{.fill = {.high = {2, 10},
                              .count = 15,
                              .smallest_radius = 0.2,
                              .largest_radius = 0.2,
                              .body = {.restitution = 0.5, .friction = 0.4}}});
    run(world, 5, 1.0 / 60);
    for (std::size_t i = 0; i < world.size(); ++i) {
        EXPECT_GT(world.positions()[i].y, 0.2 - 0.01);
        for (std::size_t j = i + 1; j < world.size(); ++j)
            EXPECT_GT(length(world.positions()[i] - world.positions()[j]), 0.4 - 0.01);
    }
    EXPECT_NEAR(energy(world).residual(), 0, 1e-6);
}
