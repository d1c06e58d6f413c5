#pragma once
#include <carom/output.hpp>

namespace carom {

/// A shape as it is seen: a line of points around it or along it, in its body's frame.
struct Rim {
    std::vector<Vec2> points;
    bool closed;  ///< and has an inside
};
Rim rim_of(const Geometry& geometry);
/// Of the room inside.
Rim rim_of(const Stadium& walls);

/// The points where a body puts them.
std::vector<Vec2> placed(std::vector<Vec2> points, Vec2 position, double angle);

}  // namespace carom
