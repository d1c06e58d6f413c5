// A fill asked the radii of bodies, which are 0 where a body has shapes, and no wall: of 100 discs 45 lay in a box of 6
// m, and 51 behind a half-plane.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <string>

namespace carom {
namespace {

const Fill hundred{.low = {0, 0}, .high = {10, 10}, .count = 100, .smallest_radius = 0.1, .largest_radius = 0.3};

TEST(Regression, FillOverlappedShapes) {
    World world;
    world.add(Body{.kind = Kind::fixed, .position = {3, 3}, .angle = 0.3, .shapes = {{.geometry = Box{6, 6}}}});
    world.add(Body{.position = {8, 8}, .shapes = {{.geometry = Capsule{{-1, 0}, {1, 1}, 0.2}}}});
    world.add(
        Body{.kind = Kind::fixed, .position = {5, 5}, .shapes = {{.geometry = Disc{.radius = 50}, .sensor = true}}});
    build(world, hundred);
    EXPECT_EQ(world.size(), 103u);
    EXPECT_TRUE(world.overlaps().empty());
}

TEST(Regression, FillOverlappedWalls) {
    World world;
    world.add(HalfPlane{.point = {0, 3}, .normal = {1, 2}});
    world.add(Rectangle{.low = {1, -5}, .high = {10, 10}});
    build(world, hundred);
    EXPECT_TRUE(world.overlaps().empty());
}

TEST(Regression, FillLeftAStadium) {
    World world;
    world.add(Stadium{.a = {4, 5}, .b = {6, 5}, .radius = 4});
    build(world, hundred);
    for (std::size_t i = 0; i < world.size(); ++i) {
        const Vec2 x = world.positions()[i];
        const double off = std::hypot(x.x - std::clamp(x.x, 4., 6.), x.y - 5);
        EXPECT_LE(off + world.radii()[i], 4 + 1e-11);  // what the fill takes for rounding is 1e-12 of its place
    }
}

TEST(Regression, FillSeesShapesAcrossAPeriodicBox) {
    World world({.solver = Events{}});
    world.add(Periodic{{0, 0}, {10, 10}});
    world.add(Body{.kind = Kind::fixed, .position = {9.5, 5}, .shapes = {{.geometry = Box{3, 3, {}, 0, 0.1}}}});
    build(world, hundred);
    for (std::size_t i = 1; i < world.size(); ++i) {
        const Vec2 d = world.positions()[i] - Vec2{9.5, 5};
        const double x = std::abs(d.x - 10 * std::round(d.x / 10)), y = std::abs(d.y - 10 * std::round(d.y / 10));
        // The box's core is 2.8 m wide, its rim 0.1 m.
        EXPECT_GE(std::hypot(std::max(x - 1.4, 0.), std::max(y - 1.4, 0.)), world.radii()[i] + 0.1 - 1e-12);
    }
}

// Where all that is left is a wall's own width, rounding of a place is no overlap.
TEST(Regression, FillFindsTheOnlyPlaceBetweenWalls) {
    World world;
    world.add(Rectangle{.low = {0.1, 0.1}, .high = {0.7, 0.7}});
    build(world,
          Fill{.low = {0.1, 0.1}, .high = {0.7, 0.7}, .count = 1, .smallest_radius = 0.3, .largest_radius = 0.3});
    EXPECT_EQ(world.size(), 1u);
}

}  // namespace
}  // namespace carom
