#pragma once
#include <functional>

#include "forces/dynamics.hpp"
#include "state/memory.hpp"

namespace carom {

/// How bodies move between impacts: all that a solver knows of an integrator.
struct Flight {
    const Dynamics& dynamics;
    Memory& memory;
    /// Moves a state by h [s] under the forces.
    std::function<void(State& state, double h)> propose;
};

}  // namespace carom
