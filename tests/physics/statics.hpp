#pragma once
// What the tests of statics are made of: piles that are put down at rest, and how far they moved.

#include <algorithm>
#include <span>
#include <vector>

#include "contacts.hpp"

namespace carom::test {

inline World statics_world(double friction, SoftStep solver = {}, Vec2 gravity = {0, -g}) {
    World world({.gravity = gravity, .solver = solver});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = friction}});
    return world;
}

/// Rows of boxes, each on two of the row below it, so far apart.
inline void add_pyramid(World& world, int rows, double pitch, double friction = 0.6) {
    for (int i = 0; i < rows; ++i)
        for (int j = i; j < rows; ++j) world.add(box({pitch * (0.5 * i + (j - i)), 0.5 + i}, 1, 1, friction));
}

inline std::vector<Vec2> copy_of(std::span<const Vec2> places) { return {places.begin(), places.end()}; }

inline double fastest(const World& world) {
    double most = 0;
    for (const Vec2 v : world.velocities()) most = std::max(most, length(v));
    return most;
}

/// How far bodies of a world are from where they were [m].
inline double moved(const World& world, const std::vector<Vec2>& before) {
    double most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) most = std::max(most, length(world.positions()[i] - before[i]));
    return most;
}

}  // namespace carom::test
