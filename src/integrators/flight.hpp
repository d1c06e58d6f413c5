#pragma once
#include "integrators/propose.hpp"

namespace carom {

/// The chosen integrator with the forces it works on and what it remembers: all that a solver needs to move bodies.
struct Flight {
    const Integrator& method;
    const Dynamics& dynamics;
    Memory& memory;
};

inline void propose(const Flight& flight, State& state, double h) {
    propose(flight.method, flight.dynamics, state, h, flight.memory);
}

}  // namespace carom
