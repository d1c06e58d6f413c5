#pragma once
#include <algorithm>
#include <cmath>

namespace carom {

/// A place in a periodic box, along one of its sides.
struct PlaceInBox {
    double place;  ///< low ≤ place < high [m]
    double boxes;  ///< to the box that it was in
};
/// Rounding can carry a place below the box to its upper edge, which is the lower one.
inline PlaceInBox place_in_box(double x, double low, double high) {
    const double size = high - low, boxes = std::floor((x - low) / size), place = x - size * boxes;
    return place < high ? PlaceInBox{std::max(place, low), boxes} : PlaceInBox{low, boxes + 1};
}

}  // namespace carom
