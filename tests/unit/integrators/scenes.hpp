#pragma once
// Small worlds whose exact motion is found by a fine step, and what tests ask of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "math/elementary.hpp"

namespace carom::test {

/// Everything that a step changes: bodies, and the accounts of heat and work.
inline std::vector<double> everything(const World& world) {
    std::vector<double> all;
    for (std::size_t i = 0; i < world.size(); ++i) {
        const Vec2 x = world.positions()[i], v = world.velocities()[i];
        all.insert(all.end(), {x.x, x.y, world.angles()[i], v.x, v.y, world.angular_velocities()[i]});
    }
    const Energy e = energy(world);
    all.insert(all.end(), {e.heat.damping, e.heat.drag, e.work.driven, e.work.wind, e.work.user});
    return all;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

/// A mass on a spring from the origin that swings and stretches: neither a circle nor a line.
inline World elastic_pendulum(const Integrator& method) {
    World world({.gravity = {0, -9.81}, .integrator = method});
    const BodyId origin = world.add(Body{.kind = Kind::fixed});
    const BodyId bob = world.add(Body{.position = {1.2, 0.3}, .velocity = {0.4, -0.2}, .mass = 1.5});
    world.add(Spring{.a = origin, .b = bob, .stiffness = 20, .rest_length = 1});
    return world;
}

/// The same where forces depend on velocity.
inline World damped_pendulum(const Integrator& method) {
    World world = elastic_pendulum(method);
    const BodyId origin = world.ids()[0], bob = world.ids()[1];
    world.add(Spring{.a = origin, .b = bob, .stiffness = 5, .rest_length = 0.5, .damping = 0.4});
    world.add(Drag{.body = bob, .linear = 0.3, .quadratic = 0.1, .wind = {1, 0.5}});
    return world;
}

/// A disc that hangs from a point off its centre, damped, with a torsion spring: places and angles in one.
inline World turning_disc(const Integrator& method) {
    World world({.gravity = {0, -9.81}, .integrator = method});
    const BodyId origin = world.add(Body{.kind = Kind::fixed});
    const BodyId disc = world.add(
        Body{.position = {0.9, 0.2}, .angle = 0.3, .velocity = {0, 0.5}, .angular_velocity = 2, .radius = 0.4});
    world.add(Spring{.a = origin,
                     .b = disc,
                     .anchor_a = {0.1, 0},
                     .anchor_b = {-0.25, 0.1},
                     .stiffness = 30,
                     .rest_length = 0.5,
                     .damping = 0.2,
                     .damping_law = DampingLaw::isotropic});
    world.add(TorsionSpring{.a = origin, .b = disc, .stiffness = 0.7, .rest_angle = 0.2, .damping = 0.05});
    return world;
}

/// A spring, and a force that changes with time.
inline World shaken(const Integrator& method) {
    World world = elastic_pendulum(method);
    world.add(ForceField{.name = "shaking", .body = world.ids()[1], .force = [](Vec2 x, Vec2, double m, double t) {
                             return m * Vec2{3 * portable::cos(4 * t), x.x / (1 + t * t)};
                         }});
    return world;
}

/// A body on a spring whose other end is driven along a curve.
inline World driven(const Integrator& method) {
    World world({.gravity = {0, -9.81}, .integrator = method});
    const BodyId hand = world.add(Body{.kind = Kind::driven});
    const BodyId bob = world.add(Body{.position = {0.8, 0.3}, .mass = 1.5});
    world.add(Spring{.a = hand, .b = bob, .stiffness = 20, .rest_length = 1, .damping = 0.1});
    world.drive(hand, [](double t) { return Pose{{0.5 * t * t, 0.6 * t - 0.2 * t * t * t}, t}; });
    return world;
}

/// GM = 1, a = 1, e = 0.6, from the apse near the mass: the period is 2π.
inline World kepler_orbit(const Integrator& method) {
    World world({.integrator = method});
    world.add(Body{.kind = Kind::fixed, .mass = 1});
    world.add(Body{.position = {0.4, 0}, .velocity = {0, 2}, .mass = 1});
    world.add(Attraction{.strength = 1});
    return world;
}

struct Scene {
    const char* name;
    World (*make)(const Integrator&);
};
inline const std::vector<Scene> scenes = {{"elastic_pendulum", elastic_pendulum},
                                          {"damped_pendulum", damped_pendulum},
                                          {"turning_disc", turning_disc},
                                          {"shaken", shaken},
                                          {"driven", driven}};

struct Named {
    std::string name;
    Integrator method;
};
inline const std::vector<Named> every_method = {
    {"euler", Euler{}},
    {"symplectic_euler", SymplecticEuler{}},
    {"verlet", Verlet{}},
    {"pefrl", Pefrl{}},
    {"rk4", Rk4{}},
    {"midpoint", RungeKutta{Tableau::midpoint}},
    {"heun", RungeKutta{Tableau::heun}},
    {"ralston", RungeKutta{Tableau::ralston}},
    {"kutta3", RungeKutta{Tableau::kutta3}},
    {"kutta38", RungeKutta{Tableau::kutta38}},
    {"dormand_prince5", RungeKutta{Tableau::dormand_prince5}},
    {"dormand_prince8", RungeKutta{Tableau::dormand_prince8}},
    {"adaptive54", Adaptive{Pair::dormand_prince54}},
    {"adaptive853", Adaptive{Pair::dormand_prince853}},
    {"gauss_radau", GaussRadau{}},
    {"implicit", Implicit{}},
};

/// Advances by `duration` in n equal steps.
inline World after(World world, double duration, int n) {
    for (int k = 0; k < n; ++k) world.step(duration / n);
    return world;
}

/// What a run that must go wrong complains of.
inline std::string complaint(World world, double duration) {
    try {
        run(world, duration, 1.0 / 60);
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Error::Cause::run);
        return error.what();
    }
    return "none";
}

}  // namespace carom::test
