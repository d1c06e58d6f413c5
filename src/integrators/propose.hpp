#pragma once
// (x, v) → (x*, v*) under the smooth forces. An integrator never hears of contacts.

#include <carom/integrator.hpp>

#include "forces/dynamics.hpp"
#include "state/memory.hpp"

namespace carom {

void propose(const Euler&, const Dynamics&, State&, double h, Memory&);
void propose(const SymplecticEuler&, const Dynamics&, State&, double h, Memory&);
void propose(const Verlet&, const Dynamics&, State&, double h, Memory&);
void propose(const Pefrl&, const Dynamics&, State&, double h, Memory&);
void propose(const Rk4&, const Dynamics&, State&, double h, Memory&);
void propose(const RungeKutta&, const Dynamics&, State&, double h, Memory&);
void propose(const Adaptive&, const Dynamics&, State&, double h, Memory&);
void propose(const Nystrom&, const Dynamics&, State&, double h, Memory&);
void propose(const GaussRadau&, const Dynamics&, State&, double h, Memory&);
void propose(const Implicit&, const Dynamics&, State&, double h, Memory&);

/// Moves the state by h [s] with the method chosen.
inline void propose(const Integrator& method, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    try {
        std::visit([&](const auto& chosen) { propose(chosen, dynamics, state, h, memory); }, method);
    } catch (...) {  // of a user's force: the state is not what is remembered
        memory.continues = false;
        throw;
    }
    memory.continues = true;
}

/// The largest ω h for which the method keeps an oscillator bounded; infinity for methods that choose their own step.
double stability_limit(const Integrator& method);
/// The longest step [s] that is stable for springs like these.
double longest_stable_step(const Stiffness& springs, double limit);

/// Which part of a step's kick is in its displacement already: x* − x = h (v + share h a) under a constant
/// acceleration.
double drift_share(const Integrator& method);
/// The same of an acceleration that grows by b in the step, of that growth: x* − x = h (v + share h a + ramp h b).
double ramp_share(const Integrator& method);

/// Whether a method moves rows one by one, and asks for no more than the rates of the rows that it moves.
inline bool takes_rows_apart(const Integrator& method) {
    return std::holds_alternative<Verlet>(method) || std::holds_alternative<SymplecticEuler>(method) ||
           std::holds_alternative<Pefrl>(method);
}

inline const char* name_of(const Integrator& method) {
    return std::visit([](const auto& chosen) { return chosen.name; }, method);
}

}  // namespace carom
