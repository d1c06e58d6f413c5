#pragma once
#include <vector>

#include "state/motion.hpp"

namespace carom {

/// What a method carries from step to step, and storage that it reuses. A value like the rest of the world: a copied
/// world goes on with the same bits.
struct Memory {
    bool continues = false;  ///< the state is the one that the last call left: what is remembered holds
    Rates rates;             ///< at that state, by methods that evaluate there
    double step = 0;         ///< adaptive methods: the next internal step [s]
    double ahead = 0;        ///< adaptive methods: `end` is this much later than the state [s]
    State end;
    std::vector<Motion> coefficients;

    std::vector<Rates> stages;  ///< storage only
    State trial;                ///< storage only
};

}  // namespace carom
