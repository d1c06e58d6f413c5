#pragma once
// What the symplectic methods are made of: drifts at constant velocity and kicks at constant position.

#include "forces/dynamics.hpp"
#include "state/memory.hpp"

namespace carom {

inline void drift(const Dynamics& dynamics, State& state, double h) {
    each([h](double& x, double v) { x += h * v; }, state.x, state.v);
    state.time += h;
    dynamics.place_driven(state);
}

/// Solves dv/dt = a(x, v) for a time h with x and the forces' time held, to `order` 1, 2 or 4: exactly, if a does not
/// depend on v. The powers are integrated alike.
void kick(const Dynamics& dynamics, State& state, double h, int order, Memory& memory);
/// The same when memory.rates already holds the rates at the state.
void kick_on(const Dynamics& dynamics, State& state, double h, int order, Memory& memory);

}  // namespace carom
