// A spring between the anchors, as two rows: C = e·(p_b − p_a), the first e along the pull, so that the largest force
// bounds it as a whole.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const DragHandle& j, Law* law) {
    *law = sprung(j.spring.value_or(JointSpring{}), false, j.maximum.value_or(HUGE_VAL));
    law->straight = true;
    law[1] = *law;
    return 2;
}

double rows_of(const DragHandle&, const Ends& ends, JointRow* row) {
    const Vec2 e = direction(ends.between);
    const double q = length(ends.between);
    *row++ = along(e, ends, q);
    *row = along(perpendicular(e), ends, 0);
    return q;
}

}  // namespace carom
