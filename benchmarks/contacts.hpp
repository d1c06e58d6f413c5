#pragma once
// What the tests of the quality of contact are made of.

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace contacts {

using namespace carom;

constexpr double frame = 1.0 / 60, g = 10, turn = 6.283185307179586;
constexpr double solid = 0.6;  ///< friction

inline World soft_world(Vec2 gravity = {0, -g}, bool statics = true) {
    return World({.gravity = gravity, .solver = SoftStep{.statics = statics}});
}
inline World on_floor(double friction = solid, bool statics = true) {
    World world = soft_world({0, -g}, statics);
    world.add(HalfPlane{.side = {1, friction}});
    return world;
}
inline Body box(Vec2 at, double width, double height, double density = 1, double friction = solid) {
    return {.position = at,
            .shapes = {{.geometry = Box{width, height}, .density = density}},
            .restitution = 0,
            .friction = friction};
}
inline Body disc(Vec2 at, double radius, double density = 1, double restitution = 0, double friction = solid) {
    return {.position = at,
            .shapes = {{.geometry = Disc{{}, radius}, .density = density}},
            .restitution = restitution,
            .friction = friction};
}
inline double kinetic(const World& world) { return energy(world).kinetic + energy(world).rotational; }
/// By how much the deepest of discs of a radius are inside one another, or outside a room from -side to side.
inline double deepest(const World& world, double radius, double side = 1e9) {
    double depth = 0;
    const auto places = world.positions();
    for (std::size_t i = 0; i < places.size(); ++i) {
        depth = std::max({depth, std::abs(places[i].x) + radius - side, std::abs(places[i].y) + radius - side});
        for (std::size_t j = 0; j < i; ++j) depth = std::max(depth, 2 * radius - length(places[i] - places[j]));
    }
    return depth;
}
inline double fastest(const World& world) {
    double most = 0;
    for (const Vec2 v : world.velocities()) most = std::max(most, length(v));
    return most;
}
inline std::string text(const char* format, auto... numbers) {
    char line[200];
    std::snprintf(line, sizeof line, format, numbers...);
    return line;
}

/// A row of the table: what is exact, what Box2D makes of it by the study, and what Carom does.
struct Row {
    const char *test, *exact, *box2d;
    std::function<std::string()> carom;
};

std::vector<Row> piles();
std::vector<Row> structures();
std::vector<Row> impacts_and_motion();

}  // namespace contacts
