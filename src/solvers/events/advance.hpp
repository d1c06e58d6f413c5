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

/// Takes a state that was edited, with an Error if it is none for a gas.
template <class Queue>
void make_ready(const GasScene& scene, State& state, GasOf<Queue>& gas);

/// Moves the state by h [s], from event to event. The company has set out on its ways before, and arrives after.
template <class Queue>
void advance(const GasScene& scene, State& state, double h, GasOf<Queue>& gas);

/// The hit before which that stopped the company, which has arrived there.
template <class Queue>
void make_hit(const GasScene& scene, State& state, GasOf<Queue>& gas);

}  // namespace carom
