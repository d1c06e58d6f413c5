#pragma once
// What a body does between the two halves of a substep: it drifts, and gets the rest of its kick.

#include "solvers/soft_step.hpp"

namespace carom {

/// Gives a body what all its contacts gave it in the substep before, or a share of that: their normals and levers are
/// those that they were, and so the impulses are.
inline void give_again(SoftContacts& contacts, std::size_t i, double share) {
    if (!contacts.given_fits) return;
    Mover& m = contacts.movers[i];
    const Twist& given = contacts.given[i];
    m.vx += share * given.velocity.x, m.vy += share * given.velocity.y, m.w += share * given.angular_velocity;
}

/// Moves it on by what the solver changed its velocity; as it is, it is where the integrator put it.
inline void drift_on(double h, std::size_t i, State& state, SoftContacts& contacts) {
    const Mover &m = contacts.movers[i], &before = contacts.before[i];
    state.x.linear[i] += h * Vec2{m.vx - before.vx, m.vy - before.vy};
    state.x.angular[i] += h * (m.w - before.w);
    contacts.frames[i] = frame_at(state.x.linear[i], state.x.angular[i]);
}

/// The rest of the kick: the velocity at the end, with what the solver changed. That of a free body stays as it is.
inline void kick_on(double drift_share, std::size_t i, const State& state, SoftContacts& contacts) {
    Mover &m = contacts.movers[i], &before = contacts.before[i];
    const Vec2 v = state.v.linear[i], proposed = contacts.proposed.v.linear[i];
    m.vx = v.x + (m.vx - before.vx), m.vy = v.y + (m.vy - before.vy);
    m.w = state.v.angular[i] + (m.w - before.w);
    before.vx = proposed.x, before.vy = proposed.y, before.w = contacts.proposed.v.angular[i];
    give_again(contacts, i, 1 - drift_share);
}

}  // namespace carom
