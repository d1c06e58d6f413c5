// A hinge.  C = p_b − p_a, two rows.  The angle θ_b − θ_a − θ₀ has a spring, a motor and limits.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const RevoluteJoint& j, Law* law) {
    const Law* const first = law;
    *law++ = rigid(), *law++ = rigid();
    if (j.spring) *law++ = sprung(*j.spring, true);
    if (is_stop(j.limits, j.motor)) *law++ = stop(j.limits, j.motor, true);
    return static_cast<std::size_t>(law - first);
}

double rows_of(const RevoluteJoint& j, const Ends& ends, JointRow* row) {
    row = pinned(ends, row);
    const JointRow angle = turning(ends, j.rest_angle.value_or(0));
    if (j.spring) *row++ = angle;
    if (is_stop(j.limits, j.motor)) *row++ = angle;
    return angle.error;
}

}  // namespace carom
