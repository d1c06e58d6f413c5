// Who comes down on a chain of short pieces flies over the end of one before he touches. The next one, in whose plane
// or below it he was not yet, had a contact only with who flew a quarter of his thickness in a substep; others sank in
// by what was left of it: discs by 0.4 of their radius into a flat floor of 3000 pieces, and by 0.18 into the far side
// of a divided valley, where they stayed for seconds.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

using namespace carom;

namespace {

constexpr double radius = 0.08;
/// Who is sought is told by velocities at the start of a substep of h = 1/240 s: what is left is a way of g h² or two,
/// 1.7e-4 m.
constexpr double tolerated = 5e-3 * radius;

/// A chain from −2 m to 2 m over heights, of so many pieces.
template <class Height>
World floor_of(int pieces, const Height& height) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    std::vector<Vec2> points;
    for (int i = 0; i <= pieces; ++i) {
        const double x = -2 + 4.0 * i / pieces;
        points.push_back({x, height(x)});
    }
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Chain{.points = points}}}, .restitution = 0});
    return world;
}
double deepest_in(World& world, double time) {
    double deepest = 0;
    run(world, time, 1.0 / 60, [&](const World& w) {
        for (const Overlap& o : w.overlaps()) deepest = std::max(deepest, o.depth);
    });
    return deepest;
}

template <class Height>
void expect_to_land(const Height& height) {
    for (const int pieces : {40, 1000, 3000})
        for (int k = 0; k < 10; ++k) {
            World world = floor_of(pieces, height);
            world.add(Body{.position = {-0.5 + 0.037 * k, 0.3},
                           .velocity = {4 - 0.31 * k, -1 - 0.23 * k},
                           .radius = radius,
                           .restitution = 0});
            EXPECT_LE(deepest_in(world, 0.3), tolerated) << pieces << " pieces, " << k;
        }
}

}  // namespace

TEST(LandingBeyondASeamSank, DiscsOnAFlatFloor) {
    expect_to_land([](double) { return 0.0; });
}
TEST(LandingBeyondASeamSank, DiscsOnAHill) {
    expect_to_land([](double x) { return -0.2 * x * x; });
}
TEST(LandingBeyondASeamSank, DiscsThatRollDownAValley) {
    for (const int pieces : {200, 1000})
        for (int k = 0; k < 8; ++k) {
            const double slope = 0.2 + 0.1 * k, x = 0.5 + 0.11 * k, r = 0.04 + 0.005 * k;
            World world = floor_of(pieces, [slope](double at) { return slope * std::abs(at); });
            const Vec2 up = Vec2{-slope, 1} / std::hypot(slope, 1);
            world.add(Body{.position = Vec2{x, slope * x} + r * up, .radius = r, .restitution = 0, .friction = 0.5});
            EXPECT_LE(deepest_in(world, 1.5), tolerated) << pieces << " pieces, " << k;
        }
}
