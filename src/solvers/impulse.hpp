#pragma once
#include <carom/solver.hpp>

#include "collision/grid.hpp"
#include "forces/flight.hpp"
#include "solvers/impact.hpp"

namespace carom {

/// What the contact solver keeps: how many impacts there were, and storage that it reuses.
struct Contacts {
    std::uint64_t collisions = 0;
    Grid grid;
    std::vector<std::uint32_t> candidates;
};

/// Whether anything can touch anything: discs one another, or bodies walls.
bool anything_collides(const Impulse&, const Bodies&, const Walls&);

/// Moves the state by h [s]: the integrator's flight with the bounces that come in its way.
void advance(const Impulse&, const Flight&, const Walls&, const Bodies&, State&, double h, Contacts&);

/// The textbook's collisions at the end of a step: bodies beyond walls are put back and bounce, discs that overlap are
/// pushed apart and exchange their normal velocities, in index order.
void collide_overlapping(const Impulse&, const Walls&, const Bodies&, Vec2 gravity, State&, Contacts&);

}  // namespace carom
