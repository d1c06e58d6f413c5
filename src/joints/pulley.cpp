// C = |p_a − g_a| + ratio |p_b − g_b| − L.  With n the directions from the ground's points, dC/dt = n_a·dp_a/dt +
// ratio n_b·dp_b/dt.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const PulleyJoint&, Law* law) {
    *law = rigid();
    return 1;
}

double rows_of(const PulleyJoint& j, const Ends& ends, JointRow* row) {
    const Vec2 to_a = ends.a.position + ends.lever_a - j.ground_a, to_b = ends.b.position + ends.lever_b - j.ground_b;
    const Vec2 n = direction(to_a), m = j.ratio * direction(to_b);
    const double q = length(to_a) + j.ratio * length(to_b);
    *row = {{n.x, n.y, cross(ends.lever_a, n)}, {m.x, m.y, cross(ends.lever_b, m)}, q - j.length.value_or(0)};
    return q;
}

}  // namespace carom
