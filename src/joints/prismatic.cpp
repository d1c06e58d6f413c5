// A slide.  With n the axis, which turns with a, and t across it: C = (t·(p_b − p_a), θ_b − θ_a − θ₀).  The way
// n·(p_b − p_a) has a spring, a motor and limits.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const PrismaticJoint& j, Law* law) {
    const Law* const first = law;
    *law++ = rigid(), *law++ = rigid(true);
    if (j.spring) *law++ = sprung(*j.spring);
    if (is_stop(j.limits, j.motor)) *law++ = stop(j.limits, j.motor);
    return static_cast<std::size_t>(law - first);
}

double rows_of(const PrismaticJoint& j, const Ends& ends, JointRow* row) {
    const Vec2 n = ends.a.turn(direction(j.axis));
    *row++ = along_own(perpendicular(n), ends);
    *row++ = turning(ends, j.rest_angle.value_or(0));
    const JointRow way = along_own(n, ends);
    if (j.spring) *row++ = way;
    if (is_stop(j.limits, j.motor)) *row++ = way;
    return way.error;
}

}  // namespace carom
