// C = (p_b − p_a, θ_b − θ_a − θ₀), the angle by a spring if there is one.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const WeldJoint& j, Law* law) {
    *law++ = rigid(), *law++ = rigid();
    *law = j.spring ? sprung(*j.spring, true) : rigid(true);
    return 3;
}

double rows_of(const WeldJoint& j, const Ends& ends, JointRow* row) {
    row = pinned(ends, row);
    *row = turning(ends, j.rest_angle.value_or(0));
    return row->error;
}

}  // namespace carom
