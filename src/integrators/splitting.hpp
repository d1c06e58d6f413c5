#pragma once
// What the symplectic methods are made of: drifts at constant velocity and kicks at constant position.

#include "forces/dynamics.hpp"
#include "integrators/ledger.hpp"
#include "state/memory.hpp"

namespace carom {

inline void drift(const Dynamics& dynamics, State& state, double h) {
    each([h](double& x, double v) { x += h * v; }, state.x, state.v);
    state.time += h;
    dynamics.place_driven(state);
}

/// Changes the velocities by h times the accelerations, and books it.
inline void add(const Dynamics& dynamics, State& state, double h, const Rates& rates) {
    Gains gains(dynamics);
    for (std::size_t i = 0; i < state.size(); ++i) {
        Vec2& v = state.v.linear[i];
        double& w = state.v.angular[i];
        const Vec2 dv = h * rates.acceleration.linear[i];
        const double dw = h * rates.acceleration.angular[i];
        gains.add(i, state.x.linear[i], v, w, {}, dv, dw);
        v += dv;
        w += dw;
    }
    gains.book(state.account);
    state.account.add(h, rates.flow);
}

/// memory.rates become those at the state, if its velocity had been changed for a time h by memory.rates as they were.
void evaluate_ahead(const Dynamics& dynamics, const State& state, double h, Memory& memory);

/// Solves dv/dt = a(x, v) for a time h with x and the forces' time held, to `order` 1 or 4: exactly, if a does not
/// depend on v. The flows are integrated alike.
void kick(const Dynamics& dynamics, State& state, double h, int order, Memory& memory);

}  // namespace carom
