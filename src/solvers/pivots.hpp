#pragma once
// Bodies that turn on what they lean on.

#include "solvers/soft_step.hpp"

namespace carom {

/// Whether the points of a contact turn by more than a hair in so much time [s] if its bodies spin so fast [rad/s].
bool turns_in(double time, const SoftContact&, double spin_a, double spin_b);
/// Notes which contacts are pivots.
void note_pivots(const SoftScene&, const State&, SoftContacts&);
/// Where a body will be in so much time [s] if it goes on as it does.
Frame frame_ahead(const State&, const BodyMotion&, std::uint32_t row, double time);
/// After the drift: by how much the points of pivots are faster than those that the block has for them.
void turn_levers(double h, SoftContacts&);

}  // namespace carom
