#pragma once
// Bounces at the instant of impact.
//
// Under gravity alone every body flies on a parabola, which is known in advance: each one is moved from impact to
// impact on its own (free flight). With any other force the whole world is brought to the instant of the first impact
// by its integrator, bounces, and goes on from there (any flight): the rest of the step is spent, not dropped, and no
// force is frozen.
//
// A bounce whose flight would last less than 1/256 of the step comes to rest; the energy it still had (½ m v² with
// v < |a| h / 512) is booked as heat of impact. There is no other threshold.

#include "solvers/impulse.hpp"

namespace carom {

inline constexpr double shortest_bounce = 1.0 / 256;
/// More impacts of one body than this within a step are a jam: the pair loses its rebound, as heat, and stops colliding
/// until the step ends. Elastic impacts cannot go on for ever (a heavy block that presses a light one against a wall
/// makes thousands in a millisecond, and gets all its energy back), so that theirs is but a guard against rounding.
inline constexpr std::uint32_t most_impacts = 512, most_elastic_impacts = 1 << 20;

void advance_to_impacts(const Impulse&, const Flight&, const Walls&, const Bodies&, State&, double h, Contacts&);
void fly_freely(const Impulse&, const Flight&, const Walls&, const Bodies&, State&, double h, Contacts&);
void fly_under_forces(const Impulse&, const Flight&, const Walls&, const Bodies&, State&, double h, Contacts&);

/// Two bodies, or a body and a wall, that touch.
struct Contact {
    static constexpr std::uint32_t no_wall = 0xffffffff;
    std::uint32_t i, j;
    std::uint32_t wall = no_wall;
    bool operator==(const Contact&) const = default;
};
/// How a pair touches when its bodies are where the state says.
Touch touch_of(const Contact&, const Walls&, const Bodies&, const State&);
/// Lets the pair bounce.
void collide(const Contact&, const Touch&, const Bodies&, State&, Contacts&);
/// Pairs at rest that sank into one another in this step are put apart and stop approaching.
void settle_resting(const std::vector<Contact>&, const Walls&, const Bodies&, Vec2 gravity, State&, Contacts&);

}  // namespace carom
