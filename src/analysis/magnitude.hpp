#pragma once
#include "analysis/recording.hpp"

namespace carom {

/// How large each number may be in this world, in its own unit: how much it differs if every body is anywhere within
/// what is seen, as fast as any may be. What rounding makes of a number that is zero is a small part of that. Of what
/// no place nor speed changes, such as an account of energy: the energies at play [J]. `raw`: a run's state, unscaled.
std::vector<double> magnitudes(const World& start, const Track& raw, const std::vector<Probe>& probes);
/// By how much each number would change if the bodies moved by as much as the one that moves farthest, and were as fast
/// as the fastest: the scale of the motion, in the number's unit. 0 of what no place nor speed changes.
std::vector<double> scales(const World& start, const Track& raw, const std::vector<Probe>& probes);

}  // namespace carom
