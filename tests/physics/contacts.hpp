#pragma once
// What the tests of contact are made of: bodies on a floor, under SoftStep at its default settings, 60 steps a second.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <string>

#include "frame.hpp"
#include "restored.hpp"

namespace carom::test {

inline constexpr double g = 9.81;

/// The floor is y = 0, and bounces as what falls on it does. What is put down here is for the solver to keep, and is
/// not left out because forces were found that hold it: that is for contacts_statics.cpp.
inline World floor_world(double friction, SoftStep solver = {}, Vec2 gravity = {0, -g}) {
    solver.statics = false;
    World world({.gravity = gravity, .solver = solver});
    world.add(HalfPlane{.side = {.restitution = 1, .friction = friction}});
    return world;
}

/// A ramp of that slope is a floor with gravity that leans: x runs down it.
inline World ramp_world(double slope, double friction, SoftStep solver = {}) {
    return floor_world(friction, solver, {g * std::sin(slope), -g * std::cos(slope)});
}

inline Body box(Vec2 position, double width, double height, double friction, double mass = 1) {
    return {.position = position,
            .mass = mass,
            .shapes = {{.geometry = Box{width, height}}},
            .restitution = 0,
            .friction = friction};
}

/// Boxes of a metre and a kilogram on one another, the lowest so high above the floor.
inline void add_stack(World& world, int boxes, double above = 0) {
    for (int i = 0; i < boxes; ++i) world.add(box({0, above + 0.5 + i}, 1, 1, 0.6));
}

inline Body disc(Vec2 position, double radius, double friction = 0, double restitution = 0) {
    return {.position = position, .radius = radius, .restitution = restitution, .friction = friction};
}

inline void pass(World& world, double seconds) { run(world, seconds, frame); }

inline double motion(const World& world) { return energy(world).kinetic + energy(world).rotational; }

}  // namespace carom::test
