#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>

// What bounces a little, and overlapped by a hair, bounced in every substep, never out of the overlap, and sank by what
// gravity or a joint did meanwhile: 7 mm a second, or 10 cm into a floor along which a crate was dragged. And where
// bodies slide in a crowd that is solved precisely, what they were to part with was off by a hundredth of the fastest:
// balls sank through walls of 2 mm.

namespace carom {
namespace {

World with_floor(double restitution, double friction) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.restitution = restitution, .friction = friction}});
    return world;
}

TEST(Regression, WhatBouncesAndOverlapsAFloorIsPushedOut) {
    for (const double restitution : {0.0, 0.15, 0.3, 0.5, 0.85, 0.95}) {
        World world = with_floor(restitution, 0.3);
        const BodyId crate = world.add(Body{
            .position = {0, 0.499}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = restitution, .friction = 0.3});
        double lowest = 1;
        run(world, 5, 1.0 / 60, [&](const World& now) { lowest = std::min(lowest, now.position(crate).y); });
        EXPECT_GE(lowest, 0.499) << restitution;
        EXPECT_NEAR(world.position(crate).y, 0.5, 1e-5) << restitution;  // what a spring gives way under its weight
    }
}

TEST(Regression, WhoIsWalkedAgainstAWallDoesNotSinkIntoTheFloor) {
    World world = with_floor(0.5, 0.5);
    world.add(Body{.kind = Kind::fixed,
                   .position = {3, 2},
                   .shapes = {{.geometry = Box{1, 4}}},
                   .restitution = 0.5,
                   .friction = 0.5});
    const BodyId walker = world.add(Body{.position = {1.5, 0.7},
                                         .mass = 70,
                                         .fixed_rotation = true,
                                         .shapes = {{.geometry = Capsule{{0, -0.4}, {0, 0.4}, 0.3}}},
                                         .restitution = 0.5,
                                         .friction = 0.2});
    for (int i = 0; i < 600; ++i) {
        world.set_velocity(walker, {4, world.velocity(walker).y}, 0);
        world.step(1.0 / 60);
    }
    EXPECT_NEAR(world.position(walker).y, 0.7, 1e-4);
}

TEST(Regression, WhatBouncesAndIsDraggedAlongAFloorStaysOnIt) {
    for (const double restitution : {0.0, 0.1, 0.5, 0.9}) {
        World world = with_floor(restitution, 0.5);
        const BodyId crate = world.add(Body{.position = {0, 0.25},
                                            .mass = 1,
                                            .shapes = {{.geometry = Box{0.5, 0.5}}},
                                            .restitution = restitution,
                                            .friction = 0.3});
        const JointId hand = world.add(Joint{.b = crate, .at = Vec2{0.2, 0.4}, .type = DragHandle{}});
        double deepest = 0;
        for (int i = 0; i < 600; ++i) {
            Joint pulled = world.joint(hand);
            pulled.anchor_a = {3 * std::sin(0.02 * i), -0.2};
            world.set(hand, pulled), world.step(1.0 / 60);
            for (const Overlap& overlap : world.overlaps()) deepest = std::max(deepest, overlap.depth);
        }
        EXPECT_LE(deepest, 0.004) << restitution;  // 1 to 2 mm under the pull of a hand, whatever bounces
    }
}

TEST(Regression, BallsStayInARoomOfThinWallsWhenTheyHaveBecomeSlow) {
    constexpr double speed = 150;
    World world({.gravity = {0, -3}, .solver = SoftStep{}});
    constexpr double thickness = 0.002, radius = 0.0135;
    Body room{.kind = Kind::fixed, .restitution = 0.5, .friction = 0.1};
    for (const double y : {0.0, 2.0}) room.shapes.push_back({.geometry = Box{1 + thickness, thickness, {0.5, y}}});
    for (const double x : {0.0, 1.0}) room.shapes.push_back({.geometry = Box{thickness, 2 + thickness, {x, 1}}});
    world.add(room);
    for (int k = 0; k < 30; ++k)
        world.add(Body{.position = {0.1 + 0.2 * (k % 5), 0.2 + 0.32 * (k / 5)},
                       .velocity = speed * Vec2{std::cos(1.3 * k), std::sin(1.3 * k)},
                       .mass = 0.08,
                       .radius = radius,
                       .restitution = 0.5,
                       .friction = 0.1});
    run(world, 8, 1.0 / 60);
    const auto positions = world.positions();
    const auto is_outside = [](Vec2 x) { return !(x.x > 0 && x.x < 1 && x.y > 0 && x.y < 2); };
    EXPECT_EQ(std::count_if(positions.begin() + 1, positions.end(), is_outside), 0);
}

}  // namespace
}  // namespace carom
