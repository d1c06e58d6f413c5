#pragma once
#include <carom/body.hpp>
#include <variant>

// Joints: what holds bodies together without giving way. Under the solver SoftStep all joints of connected bodies are
// solved at once (docs/theory/joints.md).

namespace carom {

/// A joint's number in its world, never given twice; 0 is none.
struct JointId {
    std::uint32_t number = 0;
    auto operator<=>(const JointId&) const = default;
};
constexpr std::uint64_t key(JointId id) { return id.number; }

/// F = −k q − c dq/dt for a joint's coordinate q.   U = ½ k q²
struct JointSpring {
    double stiffness = 0;
    double damping = 0;
    std::optional<double> frequency{};
    double damping_ratio = 0;
};
constexpr std::string_view describe(const JointSpring*) {
    return "A spring along a joint's free coordinate, given by its stiffness and damping, or by the frequency and "
           "damping ratio of the joined bodies. Without damping it loses no energy.";
}
template <std::same_as<JointSpring> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("stiffness", &T::stiffness, "N/m or N m/rad", non_negative, "force per stretch, k"),
        field("damping", &T::damping, "N s/m or N m s/rad", non_negative, "force per rate of stretch, c"),
        field("frequency", &T::frequency, "Hz", positive,
              "instead of a stiffness: frequency of the free oscillation of the two bodies, held by this joint alone, "
              "as they are when it is made. So k is (2π frequency)² times their reduced mass, which is near the mass "
              "of the lighter one. A heavy chassis on light wheels oscillates more slowly than that: give stiffness = "
              "(2π frequency)² times the mass that the spring carries"),
        field("damping_ratio", &T::damping_ratio, "", non_negative,
              "with a frequency: at 0 it oscillates for ever, at 1 it comes to rest without overshooting")};
}

struct JointLimits {
    std::optional<double> lower{}, upper{};
};
constexpr std::string_view describe(const JointLimits*) {
    return "How far a joint can go. It does not bounce at its limits.";
}
template <std::same_as<JointLimits> T>
constexpr auto fields(const T*) {
    return std::tuple{field("lower", &T::lower, "m or rad", any, "smallest coordinate; if absent there is no limit"),
                      field("upper", &T::upper, "m or rad", any, "largest coordinate; if absent there is no limit")};
}

struct JointMotor {
    double speed = 0;
    std::optional<double> maximum{};
};
constexpr std::string_view describe(const JointMotor*) {
    return "What drives a joint, as strongly as it can. At a speed of 0 it is dry friction, or a brake.";
}
template <std::same_as<JointMotor> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("speed", &T::speed, "m/s or rad/s", any, "speed that it holds"),
        field("maximum", &T::maximum, "N or N m", non_negative, "its largest force; if absent whatever is needed")};
}

// The types of joints. Coordinates are those of b as seen from a.

/// q is the distance of the anchors.
struct DistanceJoint {
    std::optional<double> length{};
    std::optional<JointSpring> spring{};
    JointLimits limits{};
    static constexpr const char* name = "distance";
};
constexpr std::string_view describe(const DistanceJoint*) {
    return "A rod between two anchors; a strut if it has a spring, a rope if it has only limits.";
}
template <std::same_as<DistanceJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("length", &T::length, "m", positive,
              "of the rod, or of the spring at rest; if absent the distance of the anchors when the joint is made"),
        field("spring", &T::spring, "makes the rod a spring"),
        field("limits", &T::limits,
              "smallest and largest distance; without a spring the bodies move freely in between")};
}

/// q is the angle.
struct RevoluteJoint {
    std::optional<double> rest_angle{};
    std::optional<JointSpring> spring{};
    std::optional<JointMotor> motor{};
    JointLimits limits{};
    static constexpr const char* name = "revolute";
};
constexpr std::string_view describe(const RevoluteJoint*) {
    return "A hinge: the two anchors are at one point. A body that is a point does not turn: a hinge that would hold "
           "it still is refused.";
}
template <std::same_as<RevoluteJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{field("rest_angle", &T::rest_angle, "rad", any,
                            "θ_b − θ_a at which the joint's angle is 0; if absent the one when the joint is made"),
                      field("spring", &T::spring, "turns it back to angle 0"), field("motor", &T::motor, "turns it"),
                      field("limits", &T::limits, "of the angle")};
}

/// q is the displacement of b's anchor along the axis.
struct PrismaticJoint {
    Vec2 axis{1, 0};
    std::optional<double> rest_angle{};
    std::optional<JointSpring> spring{};
    std::optional<JointMotor> motor{};
    JointLimits limits{};
    static constexpr const char* name = "prismatic";
};
constexpr std::string_view describe(const PrismaticJoint*) {
    return "A slide: b moves along an axis of a and does not turn.";
}
template <std::same_as<PrismaticJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{field("axis", &T::axis, "", any, "direction through a's anchor, in a's own frame; any length"),
                      field("rest_angle", &T::rest_angle, "rad", any,
                            "θ_b − θ_a, which the joint keeps; if absent the one when it is made"),
                      field("spring", &T::spring, "pulls the anchors together"),
                      field("motor", &T::motor, "moves b along the axis"),
                      field("limits", &T::limits, "of the displacement")};
}

/// q is the angle.
struct WeldJoint {
    std::optional<double> rest_angle{};
    std::optional<JointSpring> spring{};
    static constexpr const char* name = "weld";
};
constexpr std::string_view describe(const WeldJoint*) {
    return "The two anchors are at one point and the angle stays as it is; with a spring the joint can bend.";
}
template <std::same_as<WeldJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{field("rest_angle", &T::rest_angle, "rad", any,
                            "θ_b − θ_a, which the joint keeps; if absent the one when it is made"),
                      field("spring", &T::spring, "against bending; if absent the joint is rigid")};
}

/// q is the displacement of b's anchor along the axis: spring and limits act on it. The motor turns b.
struct WheelJoint {
    Vec2 axis{0, 1};
    std::optional<JointSpring> spring{};
    std::optional<JointMotor> motor{};
    JointLimits limits{};
    static constexpr const char* name = "wheel";
};
constexpr std::string_view describe(const WheelJoint*) {
    return "A wheel b on a suspension of a: its anchor moves along an axis of a, and it turns.";
}
template <std::same_as<WheelJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("axis", &T::axis, "", any, "direction of the suspension through a's anchor, in a's own frame"),
        field("spring", &T::spring, "of the suspension; without it the wheel moves freely along it"),
        field("motor", &T::motor, "turns the wheel against a; its speed is in rad/s"),
        field("limits", &T::limits, "of the displacement along the axis [m]")};
}

struct MotorJoint {
    Vec2 velocity{};
    double angular_velocity = 0;
    std::optional<double> maximum_force{};
    std::optional<double> maximum_torque{};
    static constexpr const char* name = "motor";
};
constexpr std::string_view describe(const MotorJoint*) {
    return "Keeps b's anchor at a given velocity relative to the point of a that is there, as strongly as it can.";
}
template <std::same_as<MotorJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("velocity", &T::velocity, "m/s", any, "of b's anchor against that point, in the world's frame"),
        field("angular_velocity", &T::angular_velocity, "rad/s", any, "of b against a"),
        field("maximum_force", &T::maximum_force, "N", non_negative, "if absent whatever is needed"),
        field("maximum_torque", &T::maximum_torque, "N m", non_negative,
              "if absent whatever is needed; 0 lets b turn")};
}

struct GearJoint {
    double ratio = 1;
    std::optional<Vec2> axis_a{}, axis_b{};
    std::optional<double> sum{};
    static constexpr const char* name = "gear";
};
constexpr std::string_view describe(const GearJoint*) {
    return "q_a + ratio q_b stays constant, where q is a body's angle, or for a rack its displacement along an axis. "
           "The ground takes the reaction.";
}
template <std::same_as<GearJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("ratio", &T::ratio, "", any, "for meshing wheels r_b / r_a; negative: both turn the same way; not 0"),
        field("axis_a", &T::axis_a, "", any, "a is a rack that moves along this direction of the world"),
        field("axis_b", &T::axis_b, "", any, "the same for b"),
        field("sum", &T::sum, "rad or m", any, "q_a + ratio q_b; if absent the one when the joint is made")};
}

struct PulleyJoint {
    Vec2 ground_a{}, ground_b{};
    double ratio = 1;
    std::optional<double> length{};
    static constexpr const char* name = "pulley";
};
constexpr std::string_view describe(const PulleyJoint*) {
    return "A rope without mass over two points of the ground: |anchor_a − ground_a| + ratio |anchor_b − ground_b| is "
           "its length. It pushes as well as it pulls. Either end stops before its point, by a thousandth of the "
           "whole.";
}
template <std::same_as<PulleyJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("ground_a", &T::ground_a, "m", any, "where the rope to a leaves"),
        field("ground_b", &T::ground_b, "m", any, "where the rope to b leaves"),
        field("ratio", &T::ratio, "", positive, "falls of rope to b for one to a"),
        field("length", &T::length, "m", positive, "of the whole rope; if absent the one when the joint is made")};
}

struct FrictionJoint {
    double maximum_force = 0;
    double maximum_torque = 0;
    static constexpr const char* name = "friction";
};
constexpr std::string_view describe(const FrictionJoint*) {
    return "Dry friction of b's anchor against the point of a that is there: for things on a table seen from above.";
}
template <std::same_as<FrictionJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("maximum_force", &T::maximum_force, "N", non_negative, "against sliding, in every direction"),
        field("maximum_torque", &T::maximum_torque, "N m", non_negative, "against turning")};
}

/// The mouse joint of other engines.
struct DragHandle {
    std::optional<JointSpring> spring{};
    std::optional<double> maximum{};
    static constexpr const char* name = "handle";
};
constexpr std::string_view describe(const DragHandle*) {
    return "A hand that pulls b's anchor to a's by a spring: the mouse, where a is the ground.";
}
template <std::same_as<DragHandle> T>
constexpr auto fields(const T*) {
    return std::tuple{field("spring", &T::spring, "between the anchors; if absent of 5 Hz and damping ratio 1"),
                      field("maximum", &T::maximum, "N", positive, "largest force; if absent there is none")};
}

struct FilterJoint {
    static constexpr const char* name = "filter";
};
constexpr std::string_view describe(const FilterJoint*) { return "Holds nothing: the two bodies do not collide."; }
template <std::same_as<FilterJoint> T>
constexpr auto fields(const T*) {
    return std::tuple{};
}

using JointType = std::variant<DistanceJoint, RevoluteJoint, PrismaticJoint, WeldJoint, WheelJoint, MotorJoint,
                               GearJoint, PulleyJoint, FrictionJoint, DragHandle, FilterJoint>;

struct Joint {
    std::string name{};
    std::optional<BodyId> a{};
    BodyId b{};
    std::optional<Vec2> at{};
    Vec2 anchor_a{}, anchor_b{};
    JointType type{};
    bool collide = false;
    std::optional<double> break_force{}, break_torque{};
};
constexpr std::string_view describe(const Joint*) {
    return "Holds two bodies, or a body and the ground, together. Joints need the solver `softstep`, or bodies that "
           "`events` moves in steps.";
}
template <std::same_as<Joint> T>
constexpr auto fields(const T*) {
    return std::tuple{
        field("name", &T::name, "by which a scene's quantities refer to it; may be empty"),
        field("a", &T::a, "one body; if absent the ground, whose frame is the world's"),
        field("b", &T::b, "the other body"),
        field(
            "at", &T::at, "m", any,
            "instead of the two anchors: the point of the world at which both are; if absent the anchors are as given"),
        field("anchor_a", &T::anchor_a, "m", any, "point of a, seen from its centre in its own frame"),
        field("anchor_b", &T::anchor_b, "m", any, "point of b, seen from its centre in its own frame"),
        flat("type", &T::type, "what kind of joint it is"),
        field("collide", &T::collide, "whether the two joined bodies collide with one another"),
        field("break_force", &T::break_force, "N", positive,
              "the joint breaks if its force, as the mean over a substep, is larger; if absent it never does"),
        field("break_torque", &T::break_torque, "N m", positive, "likewise for the torque about its anchor")};
}

/// The force of a joint on b in the last substep, and its coordinate now.
struct Reaction {
    Vec2 force{};           ///< on b at its anchor; a gets the opposite [N]
    double torque = 0;      ///< on b about its anchor [N m]
    double coordinate = 0;  ///< q: a distance or displacement [m], or an angle [rad]
    double gap = 0;         ///< by how much the constraint is violated [m]
};

/// How fast a joint's bodies now move against what its rigid part allows.
struct Breach {
    double speed = 0;  ///< [m/s]
    double spin = 0;   ///< [rad/s]
};

}  // namespace carom
