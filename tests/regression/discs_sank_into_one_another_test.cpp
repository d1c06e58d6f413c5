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
            EXPECT_NEAR(energy(world).residual, 0, 1e-9);
            EXPECT_LT(world.collisions(), 10000u);  // 300 steps: no jams
        }
}

TEST(DiscsSank, NorOneThatIsStruckWhileItRests) {
    // A third disc strikes within the step in which the others came to rest on one another: one step must give what
    // many give, but for what gravity does in a step, g h = 0.16 m/s each, against blows of 300 m/s.
    const auto struck = [](int steps) {
        World world = column(2, 0.5);
        world.add(Body{.position = {0, 3}, .velocity = {0, -300}, .radius = 0.5, .restitution = 0.5, .friction = 0.5});
        for (int n = 0; n < steps; ++n) world.step(1.0 / 60 / steps);
        EXPECT_NEAR(energy(world).residual, 0, 1e-8);  // of 45 kJ
        return world;
    };
    const World one = struck(1), many = struck(100);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(one.velocities()[i].y, many.velocities()[i].y, 3 * 0.16) << i;
        EXPECT_NEAR(one.positions()[i].y, many.positions()[i].y, 0.01) << i;
    }
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
    EXPECT_NEAR(energy(world).residual, 0, 1e-6);
}
