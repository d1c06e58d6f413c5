#pragma once
#include <carom/force.hpp>
#include <vector>

#include "forces/loads.hpp"

namespace carom {

struct DragRow {
    Row first, last;  ///< the bodies that feel it: rows first to last - 1
    double linear, quadratic, angular;
    Vec2 wind;
};
using Drags = std::vector<DragRow>;

void add_loads(const Drags& drags, std::span<const double> inverse_mass, const State& state, Loads& loads);

}  // namespace carom
