// A rod, a strut, or a rope.  C = |p_b − p_a| − L.  With n = (p_b − p_a) / |p_b − p_a|, dC/dt = n·(dp_b/dt − dp_a/dt).

#include "joints/rows.hpp"

namespace carom {

namespace {
bool is_rod(const DistanceJoint& j) { return !j.spring && !is_stop(j.limits, {}); }
}  // namespace

std::size_t laws_of(const DistanceJoint& j, Law* law) {
    const Law* const first = law;
    if (is_rod(j)) *law++ = rigid();
    if (j.spring) *law++ = sprung(*j.spring);
    if (is_stop(j.limits, {})) *law++ = stop(j.limits, {});
    return static_cast<std::size_t>(law - first);
}

double rows_of(const DistanceJoint& j, const Ends& ends, JointRow* row) {
    const Vec2 n = direction(ends.between);
    const double q = length(ends.between);
    if (is_rod(j) || j.spring) *row++ = along(n, ends, q - j.length.value_or(0));
    if (is_stop(j.limits, {})) *row++ = along(n, ends, q);
    return q;
}

}  // namespace carom
