#pragma once
#include <carom/force.hpp>
#include <vector>

#include "forces/loads.hpp"

namespace carom {

/// A spring with rows in place of ids, and without what most springs do not have: its anchors, kept aside.
struct SpringRow {
    Row a, b;
    double stiffness, rest_length, damping;
    DampingLaw damping_law;
    Vec2 anchor_a, anchor_b;
};
using Springs = std::vector<SpringRow>;

struct TorsionRow {
    Row a, b;
    double stiffness, rest_angle, damping;
};
using TorsionSprings = std::vector<TorsionRow>;

/// Where a spring's ends are and how fast they part, at a state.
struct Stretch {
    Vec2 arm_a, arm_b;  ///< from each centre to its end
    Vec2 direction;     ///< from a's end to b's, a unit vector
    double length;
    Vec2 velocity;  ///< of b's end, seen from a's
};
Stretch stretch(const SpringRow& spring, const State& state);

void add_loads(const Springs& springs, const State& state, Loads& loads);
void add_loads(const TorsionSprings& springs, const State& state, Loads& loads);
double potential(const Springs& springs, const State& state);
double potential(const TorsionSprings& springs, const State& state);

}  // namespace carom
