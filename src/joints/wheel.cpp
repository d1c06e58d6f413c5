// A wheel on a suspension.  With n the axis, which turns with a, and t across it: C = t·(p_b − p_a).  The way
// n·(p_b − p_a) has a spring and limits, and the angle a motor.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const WheelJoint& j, Law* law) {
    const Law* const first = law;
    *law++ = rigid();
    if (j.spring) *law++ = sprung(*j.spring);
    if (is_stop(j.limits, {})) *law++ = stop(j.limits, {});
    if (j.motor) *law++ = stop({}, j.motor, true);
    return static_cast<std::size_t>(law - first);
}

double rows_of(const WheelJoint& j, const Ends& ends, JointRow* row) {
    const Vec2 n = ends.a.turn(direction(j.axis));
    *row++ = along_own(perpendicular(n), ends);
    const JointRow way = along_own(n, ends);
    if (j.spring) *row++ = way;
    if (is_stop(j.limits, {})) *row++ = way;
    if (j.motor) *row++ = turning(ends, 0);
    return way.error;
}

}  // namespace carom
