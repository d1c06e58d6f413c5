#pragma once
#include <cstdint>

namespace carom {

/// How a run is cut into steps. The last one is shortened to end on time; what rounding leaves over is no step, and
/// what it lacks is one.
struct Steps {
    /// An Error if the duration [s] is not ≥ 0, the step [s] not > 0, or the run longer than 1e15 steps.
    Steps(double duration, double step);
    std::uint64_t count() const { return whole + (rest > 0 ? 1 : 0); }

    std::uint64_t whole = 0;
    double rest = 0;  ///< the shorter last step, if there is one [s]
};

}  // namespace carom
