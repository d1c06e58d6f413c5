#pragma once
// What three runs with ever finer steps, and perhaps a reference, say about the error of the first.

#include "analysis/recording.hpp"

namespace carom {

/// How finely the runs differ: a step by 2, a tolerance by 10.
struct Ladder {
    double ratio = 2;
    double rounding = 0;           ///< error of rounding, relative to the largest value
    std::vector<double> time;      ///< of the samples
    std::optional<double> impact;  ///< the first sample after an impact
    bool smooth_impacts = false;   ///< the solver finds the instant of impact: the order may survive it
};

/// Of values that there are.
double largest(const std::vector<double>& values);

/// The distance of two runs at every sample; infinite where one of them did not arrive. What is not defined in one of
/// them does not count, nor does what differs at a single sample alone.
std::vector<double> distances(const Track& a, const Track& b, double period = 0);

/// Finds size, error and order of a number or a state. `reference` may be null. `period` as in Probe.
/// For a state, whose size is 1, `size` is given; otherwise it is 0 and is found, and what rounding makes of
/// `magnitude` is as good as zero.
Followed follow(const std::array<const Track*, 3>& runs, const Track* reference, const Ladder& ladder, double size = 0,
                double period = 0, double magnitude = 0);

/// The error at every sample of the run `level` (0 or 1) as `follow` estimates it.
std::vector<double> errors_of(std::size_t level, const Followed& followed, const std::array<const Track*, 3>& runs,
                              const Track* reference, const Ladder& ladder, double period = 0);

}  // namespace carom
