// Motors and dry friction between two bodies. b's anchor moves with u = v_b + ω_b × r_b − v_a − ω_a × (p_b − x_a)
// against the point of a that is there, where the opposite force acts: u and ω_b − ω_a are held at what is wanted by
// bounded forces, that on u as a whole.

#include "joints/rows.hpp"

namespace carom {

namespace {

JointRow* holding(const Ends& ends, Vec2 wanted, JointRow* row) {
    *row++ = along_at_b({1, 0}, ends, wanted.x);
    *row++ = along_at_b({0, 1}, ends, wanted.y);
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
