#pragma once
// Polygons by their corners: convex hulls, and the parts of concave ones.

#include <carom/vec2.hpp>
#include <span>
#include <string>
#include <vector>

namespace carom {

using Corners = std::vector<Vec2>;

/// Twice the area, positive if the corners run counterclockwise.
double doubled_area(std::span<const Vec2> corners);
bool is_convex(std::span<const Vec2> corners);

/// The corners of the convex hull, counterclockwise, without those that lie within an edge.
Corners convex_hull(Corners points);

/// The corners of a simple polygon, counterclockwise; an Error that says what is wrong with it otherwise.
Corners simple_polygon(const Corners& points, const std::string& name);

/// A convex polygon cut into polygons of so many corners at most.
std::vector<Corners> pieces_of_convex(const Corners& corners, std::size_t most_corners);

/// A simple polygon, counterclockwise, cut into convex ones of so many corners at most.
std::vector<Corners> convex_parts(const Corners& corners, std::size_t most_corners);

}  // namespace carom
