#pragma once
#include "analysis/recording.hpp"

namespace carom {

/// The size of the change that starts a twin, relative to the speeds.
constexpr double perturbation = 1e-10;

/// The world with every speed of its bodies changed a little: each component by a random part of the largest it has in
/// the recording, so that what stays on a line does not leave it.
World perturbed(const World& start, const Track& state);

/// Whether the distance of two runs that started `perturbation` apart grows exponentially, and when rounding, grown
/// like that, reaches the tolerance. A pure number: the distance relative to the size of the motion.
std::optional<Growth> growth_of(const std::vector<double>& time, const std::vector<double>& distance, double tolerance);

}  // namespace carom
