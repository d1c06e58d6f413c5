// A spring between the anchors, as two rows: C = p_b − p_a. The largest force bounds them as a whole.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const DragHandle& j, Law* law) {
    *law = sprung(j.spring.value_or(JointSpring{}), false, j.maximum.value_or(HUGE_VAL));
    law->paired = true;
    law[1] = *law;
    return 2;
}

double rows_of(const DragHandle&, const Ends& ends, JointRow* row) {
    pinned(ends, row);
    return length(ends.between);
}

}  // namespace carom
