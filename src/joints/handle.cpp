// A spring between the anchors, as two rows: C = n·(p_b − p_a). What damps it acts at b's anchor on both, by axes that
// turn with a, and so makes no spin; nor does its bound, which is one for both rows. A spring alone pulls along the
// line between the anchors by any axes: by those that stay its energy is 13 times as exact.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const DragHandle& j, Law* law) {
    *law = sprung(j.spring.value_or(JointSpring{}), false, j.maximum.value_or(HUGE_VAL));
    law->paired = true;
    law[1] = *law;
    return 2;
}

double rows_of(const DragHandle& j, const Ends& ends, JointRow* row) {
    const JointSpring spring = j.spring.value_or(JointSpring{});
    // Which mass a frequency is for does not depend on whether it is damped.
    if (!spring.frequency && spring.damping == 0 && !j.maximum) {
        pinned(ends, row);
    } else {
        *row++ = along_own(ends.a.turn({1, 0}), ends);
        *row++ = along_own(ends.a.turn({0, 1}), ends);
    }
    return length(ends.between);
}

}  // namespace carom
