#pragma once
// What the tests of joints are made of.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

#include "frame.hpp"
#include "restored.hpp"
#include "throughput.hpp"

namespace carom::test {

inline constexpr double gravity = 9.81;
using std::numbers::pi;

inline World mechanism_world(SoftStep solver = {}, Vec2 g = {0, -gravity}) {
    return World({.gravity = g, .solver = solver});
}

/// A uniform rod of 1 kg and so long, lying in x, its middle there.
inline Body rod(Vec2 position, double length, double mass = 1) {
    return {.position = position, .mass = mass, .moment_of_inertia = mass * length * length / 12};
}

/// A chain of rods that are pinned to one another, from an origin on in x; with a load at its end.
inline std::vector<BodyId> add_chain(World& world, int rods, double length, double load = 0) {
    std::vector<BodyId> made;
    std::optional<BodyId> last;
    for (int i = 0; i < rods; ++i) {
        const BodyId next = world.add(rod({(i + 0.5) * length, 0}, length));
        world.add(Joint{.a = last, .b = next, .at = Vec2{i * length, 0}, .type = RevoluteJoint{}});
        made.push_back(next), last = next;
    }
    if (load > 0) {
        made.push_back(world.add(Body{.position = {rods * length, 0}, .mass = load, .moment_of_inertia = 0.1 * load}));
        world.add(Joint{.a = last, .b = made.back(), .at = Vec2{rods * length, 0}, .type = RevoluteJoint{}});
    }
    return made;
}

/// Joins a wheel at the origin by a connecting rod, whose ends are r and r + l from there in x, to a piston that slides
/// along x.
inline void add_engine_joints(World& world, BodyId wheel, BodyId connecting, BodyId piston, double r, double l) {
    world.add(Joint{.b = wheel, .at = Vec2{}, .type = RevoluteJoint{}});
    world.add(Joint{.a = wheel, .b = connecting, .at = Vec2{r, 0}, .type = RevoluteJoint{}});
    world.add(Joint{.a = connecting, .b = piston, .at = Vec2{r + l, 0}, .type = RevoluteJoint{}});
    world.add(Joint{.b = piston, .at = Vec2{r + l, 0}, .type = PrismaticJoint{.axis = {1, 0}}});
}

inline double total(const World& world) { return energy(world).total(); }

/// The gaps of all joints together [m].
inline double gaps(const World& world) {
    double sum = 0;
    for (const JointId id : world.joint_ids()) sum += world.reaction(id).gap;
    return sum;
}

inline double largest_gap(const World& world) {
    double worst = 0;
    for (const JointId id : world.joint_ids()) worst = std::max(worst, world.reaction(id).gap);
    return worst;
}

/// Adds n × n bodies, column by column from the top, as `body` makes them for a number; `join` is told which two are
/// neighbours, and where the point between them is, as the second one of a flat lattice sees it.
template <class MakeBody, class Join>
void add_lattice(World& world, int n, MakeBody body, Join join) {
    std::vector<BodyId> made;
    for (int i = 0; i < n * n; ++i) {
        made.push_back(world.add(body(i)));
        if (i % n > 0) join(made[static_cast<std::size_t>(i - 1)], made.back(), Vec2{0, 0.5});
        if (i >= n) join(made[static_cast<std::size_t>(i - n)], made.back(), Vec2{-0.5, 0});
    }
}
/// A disc of a flat lattice that turns with w [rad/s] about the first one, or is held.
inline Body lattice_disc(int n, int i, bool is_held, double w) {
    const Vec2 at{double(i / n), -double(i % n)};
    return {.kind = is_held ? Kind::fixed : Kind::dynamic,
            .position = at,
            .velocity = cross(is_held ? 0 : w, at),
            .angular_velocity = is_held ? 0 : w,
            .radius = 0.4};
}

/// A sheet of n × n discs, hinged to their neighbours, that is held by some of its top row, column by column, and turns
/// about its first disc with w [rad/s]. With a fold every second disc has turned by it [rad]: the one way in which what
/// is held by a corner can move.
template <class IsHeld>
World hinged_sheet(int n, IsHeld is_held, double w = 0, Vec2 g = {0, -gravity}, double fold = 0) {
    World world = mechanism_world({.sleep = false, .statics = false}, g);
    const auto disc = [&](int i) {
        Body body = lattice_disc(n, i, i % n == 0 && is_held(i / n), w);
        const Vec2 flat = body.position, half = 0.5 * Vec2{1 + std::cos(fold), std::sin(fold)};
        body.position = {half.x * flat.x - half.y * flat.y, half.y * flat.x + half.x * flat.y};
        if ((i / n + i % n) % 2 == 1) body.angle = fold;
        return body;
    };
    add_lattice(world, n, disc, [&](BodyId a, BodyId b, Vec2 anchor) {
        if (world.body(a).kind == Kind::fixed && world.body(b).kind == Kind::fixed) return;
        world.add(Joint{.a = a, .b = b, .anchor_a = -anchor, .anchor_b = anchor, .type = RevoluteJoint{}});
    });
    return world;
}

/// Steps on, and looks after every step whether the ledger closes.
template <class Look>
void watch(World& world, double seconds, Look look, double step = frame) {
    Throughput through(world);
    for (int i = 0; i < static_cast<int>(std::round(seconds / step)); ++i) {
        world.step(step);
        through.add(world);
        look();
    }
    expect_closed(world, through);
}

}  // namespace carom::test
