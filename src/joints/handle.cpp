// A spring between the anchors, as two rows that turn with a: C = n·(p_b − p_a). What damps it acts at b's anchor on
// both, and so makes no spin. The largest force bounds them as a whole.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const DragHandle& j, Law* law) {
    *law = sprung(j.spring.value_or(JointSpring{}), false, j.maximum.value_or(HUGE_VAL));
    law->paired = true;
    law[1] = *law;
    return 2;
}

double rows_of(const DragHandle&, const Ends& ends, JointRow* row) {
    *row++ = along_own(ends.a.turn({1, 0}), ends);
    *row++ = along_own(ends.a.turn({0, 1}), ends);
    return length(ends.between);
}

}  // namespace carom
