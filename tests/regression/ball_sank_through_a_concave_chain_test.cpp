// Which piece of a chain somebody touches was asked once a step. Who rolled over a concave corner in it had no contact
// behind it, went on along the tangent, and sank: of half a pipe a ball was through after some swings.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

using namespace carom;

namespace {

constexpr double pipe_radius = 2, ball_radius = 0.1;

/// Half a pipe of so many sides, and somebody at its left rim.
World half_pipe(int sides) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    std::vector<Vec2> points;
    for (int i = 0; i <= sides; ++i) {
        const double angle = std::numbers::pi * (double(i) / sides - 0.5);
        points.push_back({pipe_radius * std::sin(angle), -pipe_radius * std::cos(angle)});
    }
    world.add(
        Body{.kind = Kind::fixed, .shapes = {{.geometry = Chain{.points = points}}}, .restitution = 0, .friction = 1});
    return world;
}

/// How deep a ball sinks into half a pipe while it swings in it.
double deepest_in(World world) {
    const BodyId id = world.add(
        Body{.position = {ball_radius - pipe_radius, 0}, .radius = ball_radius, .restitution = 0, .friction = 1});
    double deepest = 0;
    run(world, 8, 1.0 / 60,
        [&](const World& w) { deepest = std::max(deepest, length(w.position(id)) + ball_radius - pipe_radius); });
    return deepest;
}

constexpr int several[] = {31, 63, 126, 314};  // sides
/// A side's middle lies nearer than its corners, and no place is deeper than 0: a thousandth of the way of 2 cm in a
/// substep.
constexpr double hair = 2e-5;

}  // namespace

TEST(ConcaveChain, CarriesABall) {
    for (const int sides : several) EXPECT_LT(deepest_in(half_pipe(sides)), hair) << sides << " sides";
}

// In a large world it gets its next side in the midst of a step without all others being looked for.
TEST(ConcaveChain, CarriesABallWhereManyOthersFall) {
    for (const int sides : several) {
        World world = half_pipe(sides);
        for (int i = 0; i < 200; ++i) world.add(Body{.position = {10.0 + i, 0}, .radius = ball_radius});
        EXPECT_LT(deepest_in(std::move(world)), hair) << sides << " sides";
    }
}
