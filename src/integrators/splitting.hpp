#pragma once
// What the symplectic methods are made of: drifts at constant velocity and kicks at constant position.

#include "forces/dynamics.hpp"
#include "forces/gains.hpp"
#include "state/memory.hpp"

namespace carom {

// Each says whether all that it moved are numbers.

inline bool drift(const Dynamics& dynamics, State& state, double h) {
    const bool finite = dynamics.drift(h, state);
    state.time += h;
    dynamics.place_driven(state);
    return finite && !dynamics.places();
}

/// Changes the velocities by h times the accelerations, and books it.
inline bool add(const Dynamics& dynamics, State& state, double h, const Rates& rates) {
    const Dynamics::Kicked kicked = dynamics.kick(rates.acceleration, h, state);
    state.account += kicked.gained;
    state.account.add(h, rates.flow);
    return kicked.finite;
}

/// The same, and then drifts.
inline bool add_and_drift(const Dynamics& dynamics, State& state, double h, double drift_time, const Rates& rates) {
    const Dynamics::Kicked kicked = dynamics.kick_and_drift(rates.acceleration, h, drift_time, state);
    state.account += kicked.gained;
    state.account.add(h, rates.flow);
    state.time += drift_time;
    dynamics.place_driven(state);
    return kicked.finite && !dynamics.places();
}

/// Evaluates and adds, at once where that can be.
inline bool evaluate_and_add(const Dynamics& dynamics, State& state, double h, Rates& rates, Dynamics::Keep keep) {
    const Dynamics::Kicked kicked = dynamics.evaluate_and_kick(h, state, rates, keep);
    state.account += kicked.gained;
    state.account.add(h, rates.flow);
    return kicked.finite;
}

/// memory.rates become those at the state, if its velocity had been changed for a time h by memory.rates as they were.
void evaluate_ahead(const Dynamics& dynamics, const State& state, double h, Memory& memory);

/// The same for the middle of a kick, h from its start. What may turn velocities is asked until the velocity there is
/// the one that it leads to: foretold but once, it would make them faster, by (Ωh)⁴/32 in a step of Verlet's h that
/// turns them by Ωh.
void evaluate_midway(const Dynamics& dynamics, const State& state, double h, Memory& memory);

/// Solves dv/dt = a(x, v) for a time h with x and the forces' time held, to `order` 1 or 4: exactly, if a does not
/// depend on v. The flows are integrated alike.
bool kick(const Dynamics& dynamics, State& state, double h, int order, Memory& memory);

}  // namespace carom
