#include "output/heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace carom {

std::vector<double> edges_of(const std::vector<double>& places, bool log) {
    if (places.empty()) return {};
    if (log) {
        std::vector<double> exponents;
        for (const double place : places) exponents.push_back(std::log10(place));
        std::vector<double> edges = edges_of(exponents, false);
        for (double& edge : edges) edge = std::pow(10.0, edge);
        return edges;
    }
    const double half = std::max(0.5, 1e-4 * std::abs(places[0]));  // of a cell that has no neighbour
    const std::size_t n = places.size();
    std::vector<double> edges{places[0] - (n > 1 ? 0.5 * (places[1] - places[0]) : half)};
    for (std::size_t i = 1; i < n; ++i) edges.push_back(places[i - 1] + 0.5 * (places[i] - places[i - 1]));
    edges.push_back(places[n - 1] + (n > 1 ? 0.5 * (places[n - 1] - places[n - 2]) : half));
    return edges;
}

Axis colour_axis(const HeatMap& map) {
    double low = INFINITY, high = -INFINITY;
    for (const double value : map.values)
        if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    if (!(low <= high)) return {0, 1};
    const Interval seen = with_room(low, high);
    return {seen.low, seen.high};
}

void check(const HeatMap& map, bool log_x, bool log_y) {
    if (map.values.size() != map.x.size() * map.y.size())
        throw Error(
            fmt::format("a heat map of {} x {} cells has {} values", map.x.size(), map.y.size(), map.values.size()));
    for (const auto* places : {&map.x, &map.y})
        if (std::adjacent_find(places->begin(), places->end(), std::greater_equal<>()) != places->end())
            throw Error("the columns and rows of a heat map must go from low to high");
    for (const auto& [log, places] : {std::pair{log_x, &map.x}, {log_y, &map.y}})
        if (log && !places->empty() && !(places->front() > 0))
            throw Error("the columns and rows of a heat map on a log axis must be positive");
}

// Viridis (Smith, van der Walt 2015): as bright as it is high, for the colour-blind and on paper without colours, too.
std::string palette_of_heat() {
    return "defined (0 '#440154', 1 '#482475', 2 '#414487', 3 '#355f8d', 4 '#2a788e', 5 '#21918c', 6 '#22a884', "
           "7 '#44bf70', 8 '#7ad151', 9 '#bddf26', 10 '#fde725')";
}

}  // namespace carom
