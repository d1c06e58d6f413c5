#pragma once
// The solver 'events'.

#include "solvers/events/blocks.hpp"

namespace carom {

template <class Queue>
struct GasOf {
    GasData data;
    GasPart<Queue> whole;
    GasBlocks blocks;
};
using EventGas = GasOf<Calendar>;

/// Moves the state by h [s], from event to event.
template <class Queue>
void advance(const GasScene& scene, State& state, double h, GasOf<Queue>& gas);

}  // namespace carom
