#pragma once
// Gases under the solver 'events', and how much of them the tests look at: a few seconds, or with CAROM_NIGHTLY set
// thirty times as much, at tolerances that are accordingly smaller.

#include <cstdlib>

#include "reference/gas.hpp"

namespace carom {

inline double much() { return std::getenv("CAROM_NIGHTLY") ? 30 : 1; }
inline double many() { return std::sqrt(much()); }

/// Discs of unit diameter and mass at kT = 1, on a triangular lattice in a periodic box that it fits; no momentum.
inline World lattice_gas(int columns, int rows, double eta, const Body& like = {}) {
    const double pitch = std::sqrt(M_PI / 4 / eta / std::sqrt(0.75));
    const Vec2 cell{pitch, pitch * std::sqrt(0.75)};
    World world({.solver = Events{}});
    world.add(Periodic{{0, 0}, {columns * cell.x, rows * cell.y}});
    const int n = columns * rows;
    Random random(3);
    std::vector<Vec2> v;
    Vec2 mean{};
    for (int k = 0; k < n; ++k) {
        const double x = random.normal();
        v.push_back({x, random.normal()});
        mean += v.back() / n;
    }
    double kinetic = 0;
    for (Vec2& each : v) each -= mean, kinetic += 0.5 * squared_length(each);
    for (int k = 0; k < n; ++k) {
        Body b = like;
        const int row = k / columns;
        b.position = {(k % columns + 0.25 + 0.5 * (row % 2)) * cell.x, (row + 0.5) * cell.y};
        b.velocity = std::sqrt((n - 1) / kinetic) * v[static_cast<std::size_t>(k)];
        b.radius = 0.5;
        world.add(b);
    }
    return world;
}

inline void collide(World& world, double each, double rate) { run(world, each / rate, each / rate / 4); }

/// Z = PA/(NkT) by the virial, with kT = K/(N − 1), the collisions of a disc in a unit of time, and their mean speed;
/// with standard errors from blocks.
struct Pressure {
    double z, error, rate, rate_error, speed;
};
inline Pressure pressure(World world, double expected_rate, double collisions_each) {
    collide(world, 30, expected_rate);
    const double n = static_cast<double>(world.size());
    constexpr int blocks = 16;
    const double time = collisions_each / expected_rate / blocks;
    double z = 0, z_squares = 0, rate = 0, rate_squares = 0, speed = 0;
    for (int k = 0; k < blocks; ++k) {
        const GasTally before = world.gas();
        world.step(time);
        const GasTally after = world.gas();
        const double one = (after.virial - before.virial) / (2 * time * n);
        const double hits = 2 * static_cast<double>(after.disc_collisions - before.disc_collisions) / (n * time);
        z += one / blocks, z_squares += one * one / blocks;
        rate += hits / blocks, rate_squares += hits * hits / blocks;
        for (const Vec2 v : world.velocities()) speed += length(v) / (n * blocks);
    }
    const auto error = [](double mean, double squares) { return std::sqrt((squares - mean * mean) / (blocks - 1)); };
    return {1 + z, error(z, z_squares), rate, error(rate, rate_squares), speed};
}

inline World exact_sinai(double radius, int points) {
    const World other = sinai_billiard(radius, points, 3);
    World world({.solver = Events{}});
    world.add(*other.periodic());
    for (const BodyId id : other.ids()) world.add(other.body(id));
    return world;
}

/// Lets everything go back the way it came.
inline void turn_back(World& world) {
    for (const BodyId id : world.ids()) world.set_velocity(id, -world.velocity(id), -world.angular_velocity(id));
}

}  // namespace carom
