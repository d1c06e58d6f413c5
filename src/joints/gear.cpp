// C = q_a + ratio q_b − (what it was).  q is an angle, or for a rack e·x with e a direction of the world.

#include "joints/rows.hpp"

namespace carom {

namespace {

double coordinate(const End& body, const std::optional<Vec2>& axis) {
    return axis ? dot(direction(*axis), body.position) : body.angle;
}
void slope(const std::optional<Vec2>& axis, double by, double* to) {
    const Vec2 e = axis ? direction(*axis) : Vec2{};
    to[0] = by * e.x, to[1] = by * e.y, to[2] = axis ? 0 : by;
}

}  // namespace

std::size_t laws_of(const GearJoint& j, Law* law) {
    *law = rigid(!j.axis_a && !j.axis_b);
    return 1;
}

double rows_of(const GearJoint& j, const Ends& ends, JointRow* row) {
    const double q = coordinate(ends.a, j.axis_a) + j.ratio * coordinate(ends.b, j.axis_b);
    slope(j.axis_a, 1, row->a), slope(j.axis_b, j.ratio, row->b);
    row->error = q - j.sum.value_or(0);
    return q;
}

}  // namespace carom
