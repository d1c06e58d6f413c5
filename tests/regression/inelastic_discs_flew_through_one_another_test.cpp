// Discs of e = 0 that had come to rest on one another were not looked at again in that step, even if one of them was
// struck hard in it: of three in a row, the first of which caught the second before that struck the third, the first
// flew through the second; a light one between two heavy ones was sunk into; and columns that fell on a floor at 20 m/s
// or more changed their order.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

/// With a drag that is as good as none the other way through a step is taken.
World world_with(bool forces) {
    World world;
    if (forces) world.add(Drag{.linear = 1e-12});
    return world;
}

BodyId add_disc(World& world, Vec2 at, Vec2 velocity, double mass = 1, double radius = 0.1) {
    return world.add(Body{.position = at, .velocity = velocity, .mass = mass, .radius = radius, .restitution = 0});
}

double deepest(const World& world) {
    double overlap = 0;
    for (std::size_t i = 0; i < world.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            overlap = std::max(
                overlap, world.radii()[i] + world.radii()[j] - length(world.positions()[i] - world.positions()[j]));
    return overlap;
}

// Rest is what moves a billionth of the size in a step: 1e-9 · 0.2 m · 60 /s = 1.2e-8 m/s.
TEST(InelasticDiscsAtRest, OfARowGoOnTogether) {
    for (const bool forces : {false, true}) {
        World world = world_with(forces);
        add_disc(world, {-0.6, 0}, {45, 0}), add_disc(world, {-0.35, 0}, {30, 0}), add_disc(world, {0, 0}, {});
        for (int k = 0; k < 6; ++k) world.step(1.0 / 60);
        for (const Vec2 v : world.velocities()) EXPECT_NEAR(v.x, 25, 1e-7) << forces;
        EXPECT_LT(deepest(world), 1e-9) << forces;
        EXPECT_LT(world.positions()[0].x, world.positions()[1].x) << forces;
        EXPECT_NEAR(energy(world).heat.impact, 525, 1e-6) << forces;
    }
}

TEST(InelasticDiscsAtRest, KeepTheirOrderOnAFloor) {
    for (const bool forces : {false, true})
        for (std::uint64_t seed = 0; seed < (forces ? 10 : 50); ++seed) {
            Random random(seed);
            World world = world_with(forces);
            world.add(Rectangle{{0, 0}, {1, 6}});
            double y = 1;
            for (int i = 0; i < 4; ++i) {
                y += random.uniform(0.21, 0.5);
                add_disc(world, {0.5, y}, {0, -80 * random.uniform(0.5, 1.5)});
            }
            for (int k = 0; k < 10; ++k) {
                world.step(1.0 / 60);
                EXPECT_LT(deepest(world), 1e-9) << forces << ' ' << seed;
            }
            const auto& x = world.positions();
            EXPECT_TRUE(std::is_sorted(x.begin(), x.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; }))
                << forces << ' ' << seed;
        }
}

// Each blow on the light one takes a hundredth of 2 m/s, up to some 550 in a step; what is left of them goes on for no
// longer than the step: 2 m/s · exp(-5.5) / 60 /s.
TEST(InelasticDiscsAtRest, AreNotSunkIntoByHeavyOnes) {
    World world;
    add_disc(world, {-1.5, 0}, {1, 0}, 100, 0.5), add_disc(world, {0, 0}, {}, 1, 0.3);
    add_disc(world, {1.5, 0}, {-1, 0}, 100, 0.5);
    for (int k = 0; k < 180; ++k) {
        world.step(1.0 / 60);
        EXPECT_LT(deepest(world), 1.4e-4) << k;
    }
}

}  // namespace
}  // namespace carom
