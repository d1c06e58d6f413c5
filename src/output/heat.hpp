#pragma once
// Heat maps: where their cells end, and what their colours mean.

#include <carom/output.hpp>
#include <string>
#include <vector>

#include "output/axis.hpp"

namespace carom {

/// Around the cells of columns or rows at these places: one more than there are places, none of none. On a log axis
/// half-way is where it is seen to be.
std::vector<double> edges_of(const std::vector<double>& places, bool log);
/// From the lowest to the highest of the values.
Axis colour_axis(const HeatMap& map);
/// An Error if there are more or less values than cells, or places that are out of order or on no log axis.
void check(const HeatMap& map, bool log_x, bool log_y);
/// From dark to bright, for gnuplot.
std::string palette_of_heat();

}  // namespace carom
