#pragma once
// What a joint asks of the two bodies it holds: rows of the constraint, and the law of each.

#include <carom/joint.hpp>
#include <cmath>

namespace carom {

/// A body as a joint sees it; the ground is at the origin and does not move.
struct End {
    Vec2 position{};
    double cosine = 1, sine = 0, angle = 0;

    Vec2 turn(Vec2 p) const { return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y}; }
};

/// A joint's bodies and anchors at some instant.
struct Ends {
    End a, b;
    Vec2 lever_a{}, lever_b{};  ///< from the centres to the anchors, in the world's frame
    Vec2 between{};             ///< from anchor a to anchor b

    Ends(Vec2 anchor_a, Vec2 anchor_b, const End& first, const End& second)
        : a(first),
          b(second),
          lever_a(a.turn(anchor_a)),
          lever_b(b.turn(anchor_b)),
          between((b.position - a.position) + (lever_b - lever_a)) {}
    Ends(const Joint& joint, const End& first, const End& second)
        : Ends(joint.anchor_a, joint.anchor_b, first, second) {}
    double angle() const { return b.angle - a.angle; }
};

/// A row: C, and dC/dt = a·(v_a, ω_a) + b·(v_b, ω_b).
struct JointRow {
    double a[3], b[3];
    double error;  ///< C [m or rad]; of dry friction in a plane the speed that is held
};

/// What keeps the row. A force F > 0 along it pushes b the way in which C grows.
struct Law {
    enum class Kind : std::uint8_t {
        rigid,   ///< C = 0
        spring,  ///< F = −k C − c dC/dt, and at most `most`
        stop     ///< lower ≤ C ≤ upper by any force, and a motor that holds a speed by `most` at most
    };
    Kind kind = Kind::rigid;
    bool turns = false;   ///< C is an angle
    bool paired = false;  ///< the forces of this row and the one beside it, in x and y, have one bound
    double stiffness = 0, damping = 0;
    double lower = -HUGE_VAL, upper = HUGE_VAL;
    double speed = 0, most = 0;
    bool operator==(const Law&) const = default;
};

/// What a spring takes up on the way from one C to another [J]: beyond its largest force it gives that at any C.
double taken_up(const Law&, double from, double to);

constexpr std::size_t most_rows = 4;

/// The laws of a joint's rows; returns how many there are.
std::size_t laws_of(const Joint&, Law*);
/// Its rows for bodies that are there; returns its coordinate q.
double rows_of(const Joint&, const Ends&, JointRow*);

// One file a type. Filters have no rows.

std::size_t laws_of(const DistanceJoint&, Law*);
std::size_t laws_of(const RevoluteJoint&, Law*);
std::size_t laws_of(const PrismaticJoint&, Law*);
std::size_t laws_of(const WeldJoint&, Law*);
std::size_t laws_of(const WheelJoint&, Law*);
std::size_t laws_of(const MotorJoint&, Law*);
std::size_t laws_of(const GearJoint&, Law*);
std::size_t laws_of(const PulleyJoint&, Law*);
std::size_t laws_of(const FrictionJoint&, Law*);
std::size_t laws_of(const DragHandle&, Law*);
double rows_of(const DistanceJoint&, const Ends&, JointRow*);
double rows_of(const RevoluteJoint&, const Ends&, JointRow*);
double rows_of(const PrismaticJoint&, const Ends&, JointRow*);
double rows_of(const WeldJoint&, const Ends&, JointRow*);
double rows_of(const WheelJoint&, const Ends&, JointRow*);
double rows_of(const MotorJoint&, const Ends&, JointRow*);
double rows_of(const GearJoint&, const Ends&, JointRow*);
double rows_of(const PulleyJoint&, const Ends&, JointRow*);
double rows_of(const FrictionJoint&, const Ends&, JointRow*);
double rows_of(const DragHandle&, const Ends&, JointRow*);

// What several of them share.

inline Law rigid(bool turns = false) { return {.kind = Law::Kind::rigid, .turns = turns}; }
inline Law sprung(const JointSpring& spring, bool turns = false, double most = HUGE_VAL) {
    return {.kind = Law::Kind::spring,
            .turns = turns,
            .stiffness = spring.stiffness,
            .damping = spring.damping,
            .most = most};
}
inline bool is_stop(const JointLimits& limits, const std::optional<JointMotor>& motor) {
    return limits.lower || limits.upper || motor;
}
inline Law stop(const JointLimits& limits, const std::optional<JointMotor>& motor, bool turns = false) {
    return {.kind = Law::Kind::stop,
            .turns = turns,
            .lower = limits.lower.value_or(-HUGE_VAL),
            .upper = limits.upper.value_or(HUGE_VAL),
            .speed = motor ? motor->speed : 0,
            .most = motor ? motor->maximum.value_or(HUGE_VAL) : 0};
}
/// Dry friction: in a plane, or against turning.
inline Law rubbed(double speed, double most, bool turns = false) {
    return {.kind = Law::Kind::stop, .turns = turns, .paired = !turns, .speed = speed, .most = most};
}
/// Whether C is no coordinate, and `error` the speed that is held.
inline bool is_of_speed(const Law& law) { return law.paired && law.kind == Law::Kind::stop; }

/// By how much what a law does not allow is missed.
inline double out_of(const Law& law, double c) {
    if (law.kind == Law::Kind::rigid) return c;
    if (law.kind == Law::Kind::spring || is_of_speed(law)) return 0;
    return c < law.lower ? c - law.lower : c > law.upper ? c - law.upper : 0;
}

/// C = n·(p_b − p_a) − offset with n a unit vector that does not turn, or that turns so that its own change does not
/// count: dC/dt = n·(v_b + ω_b × r_b − v_a − ω_a × r_a).
inline JointRow along(Vec2 n, const Ends& ends, double error) {
    return {{-n.x, -n.y, -cross(ends.lever_a, n)}, {n.x, n.y, cross(ends.lever_b, n)}, error};
}
/// The same against the point of a where b's anchor is.
inline JointRow along_at_b(Vec2 n, const Ends& ends, double error) {
    return {{-n.x, -n.y, -cross(ends.lever_a + ends.between, n)}, {n.x, n.y, cross(ends.lever_b, n)}, error};
}
/// C = n·(p_b − p_a) with n fixed in a: it turns with ω_a, which adds ω_a × n · (p_b − p_a).
inline JointRow along_own(Vec2 n, const Ends& ends) { return along_at_b(n, ends, dot(n, ends.between)); }
/// C = θ_b − θ_a − rest
inline JointRow turning(const Ends& ends, double rest) { return {{0, 0, -1}, {0, 0, 1}, ends.angle() - rest}; }
/// p_b = p_a: two rows.
inline JointRow* pinned(const Ends& ends, JointRow* row) {
    *row++ = along({1, 0}, ends, ends.between.x);
    *row++ = along({0, 1}, ends, ends.between.y);
    return row;
}
/// A direction along which something pulls; any if there is none.
inline Vec2 direction(Vec2 d) {
    const double size = length(d);
    return size > 1e-300 ? d / size : Vec2{1, 0};
}

}  // namespace carom
