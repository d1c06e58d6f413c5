// A ball that fell into a bucket of three welded planks, a little too narrow for it, was wedged by friction with forces
// of 1e6 to 1e9 N: nothing bounds what presses two welded bodies apart, the precise solve carried on what a blow had
// left of it from substep to substep, and it flew off with up to 3e5 times all energy there was.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <numbers>

namespace carom {
namespace {

constexpr double gravity = 9.81, plank_mass = 10, high = 2.5;

World bucket(double gap, double mass, double friction, Vec2 ball) {
    World world({.gravity = {0, -gravity}, .solver = SoftStep{}});
    world.add(HalfPlane{.normal = {0, 1}, .side = {.restitution = 0, .friction = 0.6}});
    const auto add = [&](Vec2 at, double angle, double body_mass, const Geometry& shape) {
        return world.add(Body{.position = at,
                              .angle = angle,
                              .mass = body_mass,
                              .shapes = {{.geometry = shape, .restitution = 0, .friction = friction}}});
    };
    const double side = 0.5 * gap + 0.1;
    const BodyId bottom = add({0, 0.1}, 0, plank_mass, Box{gap + 0.4, 0.2});
    for (const double x : {-side, side})
        world.add(Joint{.a = bottom,
                        .b = add({x, 1.1}, std::numbers::pi / 2, plank_mass, Box{1.8, 0.2}),
                        .at = Vec2{x, 0.2},
                        .type = WeldJoint{}});
    add(ball, 0, mass, Disc{{}, 0.5});
    return world;
}

TEST(WedgedBall, MakesNoEnergy) {
    for (const double ratio : {5.0, 10.0, 20.0})
        for (const double drop : {0.2, 3.0})
            for (const double x : {0.07, 0.15})
                for (const double gap : {0.9, 0.97}) {
                    World world = bucket(gap, ratio * plank_mass, 0.7, {x, high + drop});
                    const double start = energy(world).total();
                    double most = start;
                    run(world, 3, 1.0 / 60, [&](const World& w) { most = std::max(most, energy(w).total()); });
                    EXPECT_LE(most, start + 1e-2 * ratio * plank_mass * gravity * (1 + drop))
                        << ratio << ", " << drop << ", " << x << ", " << gap;
                }
}

}  // namespace
}  // namespace carom
