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

}  // namespace

TEST(ConcaveChain, CarriesABall) {
    for (const int sides : {31, 63, 126, 314}) {
        World world = half_pipe(sides);
        const BodyId id = world.add(
            Body{.position = {ball_radius - pipe_radius, 0}, .radius = ball_radius, .restitution = 0, .friction = 1});
        double deepest = 0;
        run(world, 8, 1.0 / 60,
            [&](const World& w) { deepest = std::max(deepest, length(w.position(id)) + ball_radius - pipe_radius); });
        // A side's middle lies nearer than its corners, and no place is deeper than 0: 2e-5 is a thousandth of the way
        // of 2 cm in a substep.
        EXPECT_LT(deepest, 2e-5) << sides << " sides";
    }
}
