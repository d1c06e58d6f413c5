#pragma once
// Shapes with an inside as a whole, before they are cut into convex pieces.

#include "collision/convex.hpp"

namespace carom {

/// All points within the rounding of a simple polygon (counterclockwise), of a line (2 corners) or of a point.
struct Outline {
    std::vector<Vec2> corners;
    double rounding = 0;
};

/// An Error says what is wrong with the shape.
Outline outline_of(const Disc& disc);
Outline outline_of(const Capsule& capsule);
Outline outline_of(const Box& box);
Outline outline_of(const Polygon& polygon);
Outline outline_of(const Hull& hull);
Outline outline_of(const Segment& segment);

}  // namespace carom
