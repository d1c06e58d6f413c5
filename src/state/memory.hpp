#pragma once
#include <vector>

#include "math/compensated.hpp"
#include "state/motion.hpp"

namespace carom {

/// What a method carries from step to step, and storage that it reuses. A value like the rest of the world: a copied
/// world goes on with the same bits.
struct Memory {
    bool continues = false;  ///< the state is the one that the last call left: what is remembered holds
    bool finite = false;     ///< the method found all places and velocities to be numbers; else it did not look
    Rates rates;             ///< Verlet: at that state, or the last ones looked at

    // Methods that choose their own step.
    double step = 0;    ///< the next one [s]
    double length = 0;  ///< the last one [s]

    // Adaptive: its steps end where they like, and the states in between are interpolated.
    State end;                 ///< where the last step went
    CompensatedSum ahead;      ///< by how much `end` is later than the state [s]
    std::vector<State> dense;  ///< coefficients of the interpolation over the last step
    double error = 1;          ///< that was estimated for the last step, in tolerances

    // Gauss-Radau.
    Motion low_x, low_v;       ///< what rounding to the state cut off: the place is x + low_x
    std::vector<Rates> nodes;  ///< of the last step

    std::vector<Rates> stages;       ///< storage; Adaptive: [0] holds the rates at `end`
    std::vector<Motion> velocities;  ///< storage: at the stages
    State trial, next, coarse;       ///< storage only
    Motion last;                     ///< storage only
};
/// Storage too: methods rely on its sizes.
auto members(Maybe_const<Memory> auto& m) {
    auto& [continues, finite, rates, step, length, end, ahead, dense, error, low_x, low_v, nodes, stages, velocities,
           trial, next, coarse, last] = m;
    return std::tie(continues, finite, rates, step, length, end, ahead, dense, error, low_x, low_v, nodes, stages,
                    velocities, trial, next, coarse, last);
}

}  // namespace carom
