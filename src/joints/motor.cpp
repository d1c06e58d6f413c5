// Motors and dry friction between two bodies.  dC/dt = e·(dp_b/dt − dp_a/dt) for two directions e, and ω_b − ω_a: each
// is held at a speed by a bounded force.  The first e is that in which b's anchor moves against what is wanted of it,
// so that the bound holds for the force as a whole.

#include "joints/rows.hpp"

namespace carom {

namespace {

/// Rows for a force that would bring the anchors' velocity to the one that is wanted.
JointRow* holding(const Ends& ends, Vec2 wanted, JointRow* row) {
    const auto at = [](const End& body, Vec2 lever) { return body.velocity + cross(body.angular_velocity, lever); };
    const Vec2 e = direction(at(ends.b, ends.lever_b) - at(ends.a, ends.lever_a) - wanted), f = perpendicular(e);
    *row++ = along(e, ends, dot(e, wanted));
    *row++ = along(f, ends, dot(f, wanted));
    return row;
}

}  // namespace

std::size_t laws_of(const MotorJoint& j, Law* law) {
    const Law* const first = law;
    const double force = j.maximum_force.value_or(HUGE_VAL), torque = j.maximum_torque.value_or(HUGE_VAL);
    if (force > 0) *law++ = rubbed(0, force), *law++ = rubbed(0, force);
    if (torque > 0) *law++ = rubbed(j.angular_velocity, torque, true);
    return static_cast<std::size_t>(law - first);
}

double rows_of(const MotorJoint& j, const Ends& ends, JointRow* row) {
    if (j.maximum_force != 0) row = holding(ends, j.velocity, row);
    if (j.maximum_torque != 0) *row++ = turning(ends, 0);
    return ends.angle();
}

std::size_t laws_of(const FrictionJoint& j, Law* law) {
    const Law* const first = law;
    if (j.maximum_force > 0) *law++ = rubbed(0, j.maximum_force), *law++ = rubbed(0, j.maximum_force);
    if (j.maximum_torque > 0) *law++ = rubbed(0, j.maximum_torque, true);
    return static_cast<std::size_t>(law - first);
}

double rows_of(const FrictionJoint& j, const Ends& ends, JointRow* row) {
    if (j.maximum_force > 0) row = holding(ends, {}, row);
    if (j.maximum_torque > 0) *row++ = turning(ends, 0);
    return ends.angle();
}

}  // namespace carom
