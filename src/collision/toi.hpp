#pragma once
// When two outlines that move come as near as a given gap.

#include <optional>

#include "collision/convex.hpp"

namespace carom {

/// How a body moves in a step: its position and its angle change evenly.
struct Sweeping {
    Vec2 displacement{};
    double angle = 0;  ///< at the start [rad]
    double turn = 0;   ///< [rad]
};

/// The first time, as a fraction of the step, at which the gap between a and b is the target [m] or less; 0 if it is
/// at the start, nothing if the step ends before. `between` is b's position less a's at the start.
///
/// Never late: of all times before it, none has a smaller gap. Early by a gap of 1e-9 of the smaller one's size at
/// most. A piece of a chain that b is behind at the start lets it pass.
std::optional<double> time_of_impact(const Convex& a, const Sweeping& motion_a, const Convex& b,
                                     const Sweeping& motion_b, Vec2 between, double target);

}  // namespace carom
