// C = |p_a − g_a| + ratio |p_b − g_b| − L.  With n the directions from the ground's points, dC/dt = n_a·dp_a/dt +
// ratio n_b·dp_b/dt.  Neither end goes through its point of the ground, where n would leap: |p_a − g_a| and |p_b − g_b|
// stay above a hair of L, as by limits.

#include "joints/rows.hpp"

namespace carom {

std::size_t laws_of(const PulleyJoint& j, Law* law) {
    constexpr double hair = 1e-3;  // of the rope, once its length is known
    *law++ = rigid();
    for (int end = 0; end < 2; ++end) *law++ = stop({.lower = hair * j.length.value_or(0)}, {});
    return 3;
}

double rows_of(const PulleyJoint& j, const Ends& ends, JointRow* row) {
    const Vec2 to_a = ends.a.position + ends.lever_a - j.ground_a, to_b = ends.b.position + ends.lever_b - j.ground_b;
    const Vec2 n = direction(to_a), m = direction(to_b);
    const double turn_a = cross(ends.lever_a, n), turn_b = cross(ends.lever_b, m), k = j.ratio;
    const double q = length(to_a) + k * length(to_b);
    *row++ = {{n.x, n.y, turn_a}, {k * m.x, k * m.y, k * turn_b}, q - j.length.value_or(0)};
    *row++ = {{n.x, n.y, turn_a}, {}, length(to_a)};
    *row++ = {{}, {m.x, m.y, turn_b}, length(to_b)};
    return q;
}

}  // namespace carom
