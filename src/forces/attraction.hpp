#pragma once
#include <carom/force.hpp>
#include <vector>

#include "forces/loads.hpp"

namespace carom {

struct AttractionRows {
    double strength;  ///< positive attracts
    DistanceLaw law;
    double squared_softening;
    std::vector<double> coupling;  ///< mass or charge, one row a body
    std::vector<char> moves;       ///< pairs that both stand still are left out
};
using Attractions = std::vector<AttractionRows>;

void add_loads(const Attractions& attractions, int threads, const State& state, Loads& loads);
double potential(const Attractions& attractions, const State& state);

}  // namespace carom
