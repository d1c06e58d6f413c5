// A joint of any type, and how it is made: what the user left open follows from where the bodies are.

#include <fmt/format.h>

#include <algorithm>

#include "joints/joints.hpp"
#include "state/validate.hpp"

namespace carom {

std::size_t laws_of(const Joint& joint, Law* law) {
    return std::visit(
        [&]<class T>(const T& type) -> std::size_t {
            if constexpr (std::is_same_v<T, FilterJoint>)
                return 0;
            else
                return laws_of(type, law);
        },
        joint.type);
}

double rows_of(const Joint& joint, const Ends& ends, JointRow* row) {
    return std::visit(
        [&]<class T>(const T& type) -> double {
            if constexpr (std::is_same_v<T, FilterJoint>)
                return 0;
            else
                return rows_of(type, ends, row);
        },
        joint.type);
}

std::string called(const Joint& joint) {
    return joint.name.empty() ? std::string("Joint") : fmt::format("Joint '{}'", joint.name);
}

End end_of(const std::optional<BodyId>& id, const Bodies& bodies, const State& state) {
    if (!id) return {};
    const std::size_t i = bodies.row(*id);
    const auto turn = portable::sincos(state.x.angular[i]);
    return {state.x.linear[i], turn.cos, turn.sin, state.x.angular[i]};
}

namespace {

void check_limits(const JointLimits& limits, const std::string& where) {
    if (limits.lower && limits.upper && *limits.lower > *limits.upper)
        throw Error(
            fmt::format("{}.limits.upper must be at least lower, {}, got {}", where, *limits.lower, *limits.upper));
}
void check_axis(Vec2 axis, const char* name, const std::string& where) {
    if (axis == Vec2{}) throw Error(fmt::format("{}.{} must not be (0, 0)", where, name));
}

/// Checks and completes what is special to a type.
void complete(DistanceJoint& j, const Ends& ends, const std::string& where) {
    check_limits(j.limits, where);
    if (is_stop(j.limits, {}) && !j.spring) {
        if (j.length) throw Error(where + ".length is that of a rod or a spring: a rope has limits.upper alone");
        if (j.limits.upper && *j.limits.upper <= 0) throw Error(where + ".limits.upper must be a number > 0 in m");
        return;
    }
    if (!j.length) j.length = length(ends.between);
    if (!(*j.length > 0))
        throw Error(where + ".length must be > 0 m, and the anchors are in one point: use a revolute joint");
}
void complete(RevoluteJoint& j, const Ends& ends, const std::string& where) {
    check_limits(j.limits, where);
    if (!j.rest_angle) j.rest_angle = ends.angle();
}
void complete(PrismaticJoint& j, const Ends& ends, const std::string& where) {
    check_limits(j.limits, where);
    check_axis(j.axis, "axis", where);
    if (!j.rest_angle) j.rest_angle = ends.angle();
}
void complete(WeldJoint& j, const Ends& ends, const std::string&) {
    if (!j.rest_angle) j.rest_angle = ends.angle();
}
void complete(WheelJoint& j, const Ends&, const std::string& where) {
    check_limits(j.limits, where);
    check_axis(j.axis, "axis", where);
}
void complete(GearJoint& j, const Ends& ends, const std::string& where) {
    if (j.ratio == 0) throw Error(where + ".ratio must not be 0");
    if (j.axis_a) check_axis(*j.axis_a, "axis_a", where);
    if (j.axis_b) check_axis(*j.axis_b, "axis_b", where);
    JointRow row;
    if (!j.sum) j.sum = rows_of(j, ends, &row);
}
void complete(PulleyJoint& j, const Ends& ends, const std::string&) {
    JointRow rows[most_rows];
    if (!j.length) j.length = rows_of(j, ends, rows);
}
void complete(DragHandle& j, const Ends&, const std::string&) {
    if (!j.spring) j.spring = JointSpring{.frequency = 5, .damping_ratio = 1};
}
template <class T>
void complete(T&, const Ends&, const std::string&) {}

/// The mass or moment of inertia that the last of some rows has to move, where those before it are kept: the last pivot
/// of their J M⁻¹ Jᵀ.
double effective_mass(const JointRow* rows, std::size_t count, const Joint& joint, const Bodies& bodies) {
    constexpr double rounding = 1e-12;
    const auto gain = [&](const double* j, const double* l, std::size_t i) {
        return bodies.inverse_mass[i] * (j[0] * l[0] + j[1] * l[1]) + bodies.inverse_inertia[i] * j[2] * l[2];
    };
    double s[most_rows][most_rows] = {}, own = 0;
    for (std::size_t r = 0; r < count; ++r)
        for (std::size_t c = 0; c < count; ++c) {
            s[r][c] = gain(rows[r].b, rows[c].b, bodies.row(joint.b));
            if (joint.a) s[r][c] += gain(rows[r].a, rows[c].a, bodies.row(*joint.a));
            if (r == c) own = s[r][r];
        }
    for (std::size_t k = 0; k + 1 < count; ++k)
        for (std::size_t r = k + 1; r < count && s[k][k] > 0; ++r) {
            const double part = s[r][k] / s[k][k];
            for (std::size_t c = k; c < count; ++c) s[r][c] -= part * s[k][c];
        }
    const double left = s[count - 1][count - 1];
    return left > rounding * own ? 1 / left : HUGE_VAL;
}

JointSpring* spring_of(Joint& joint) {
    return std::visit(
        [](auto& type) -> JointSpring* {
            if constexpr (requires { type.spring; })
                return type.spring ? &*type.spring : nullptr;
            else
                return nullptr;
        },
        joint.type);
}

/// From frequency and damping ratio to stiffness and damping.
void tune(Joint& joint, const Ends& ends, const Bodies& bodies, const std::string& where) {
    JointSpring* spring = spring_of(joint);
    if (!spring) return;
    if (spring->frequency && (spring->stiffness != 0 || spring->damping != 0))
        throw Error(where + ".spring has either a stiffness and a damping, or a frequency and a damping ratio");
    if (!spring->frequency) {
        if (spring->damping_ratio != 0)
            throw Error(where + ".spring.damping_ratio needs a frequency beside it; damping goes with a stiffness");
        return;
    }
    Law laws[most_rows];
    JointRow rows[most_rows];
    const std::size_t count = laws_of(joint, laws);
    rows_of(joint, ends, rows);
    // What is rigid comes before the spring.
    const auto sprung = std::find_if(laws, laws + count, [](const Law& l) { return l.kind == Law::Kind::spring; });
    const auto mass_of = [&](const JointRow* first) {
        return effective_mass(first, static_cast<std::size_t>(sprung - laws) + 1, joint, bodies);
    };
    // A handle pulls any way: the mean over all ways of how fast an impulse makes what it holds is that of any two that
    // are square to one another.
    const double mass = laws[0].paired ? 2 / (1 / mass_of(rows) + 1 / mass_of(rows + 1)) : mass_of(rows);
    if (!(mass < HUGE_VAL))
        throw Error(where +
                    ".spring.frequency: neither body can turn, so that there is none; give a moment of inertia");
    const double omega = 2 * 3.14159265358979323846 * *spring->frequency;
    *spring = {.stiffness = mass * omega * omega, .damping = 2 * spring->damping_ratio * mass * omega};
}

}  // namespace

Joint completed(Joint joint, const Bodies& bodies, const State& state) {
    const std::string where = called(joint);
    validate(joint, where);
    if (joint.at && (joint.anchor_a != Vec2{} || joint.anchor_b != Vec2{}))
        throw Error(where +
                    ".at is the point of the world that both anchors are in: give either it, or anchor_a and "
                    "anchor_b");
    const std::size_t b = bodies.row(joint.b, where, "b");
    if (joint.a) bodies.row(*joint.a, where, "a");
    if (joint.a == joint.b) throw Error(where + ".b must be another body than a");
    const bool a_moves = joint.a && bodies.inverse_mass[bodies.row(*joint.a)] != 0;
    if (!a_moves && bodies.inverse_mass[b] == 0)
        throw Error(where +
                    " must hold a dynamic body: a and b are fixed or driven, and the joint would change nothing");
    const End first = end_of(joint.a, bodies, state), second = end_of(joint.b, bodies, state);
    if (joint.at) {
        const auto seen_from = [&](const End& body) {
            const Vec2 d = *joint.at - body.position;
            return Vec2{body.cosine * d.x + body.sine * d.y, body.cosine * d.y - body.sine * d.x};
        };
        joint.anchor_a = seen_from(first), joint.anchor_b = seen_from(second);
        joint.at.reset();
    }
    const Ends ends(joint, first, second);
    std::visit([&](auto& type) { complete(type, ends, where); }, joint.type);
    tune(joint, ends, bodies, where);
    return joint;
}

bool has_spring(const Joint& joint) {
    return std::visit(
        [](const auto& type) {
            if constexpr (requires { type.spring; })
                return type.spring.has_value();
            else
                return false;
        },
        joint.type);
}

double taken_up(const Law& law, double from, double to) {
    const auto gives_way = [&law](double c) { return law.stiffness * std::abs(c) > law.most; };
    if (!gives_way(from) && !gives_way(to)) return 0.5 * law.stiffness * (to - from) * (to + from);
    const auto stored = [&](double c) {
        const double within = gives_way(c) ? law.most / law.stiffness : std::abs(c);
        return 0.5 * law.stiffness * within * within + (gives_way(c) ? law.most * (std::abs(c) - within) : 0);
    };
    return stored(to) - stored(from);
}

double spring_energy(const Joint& joint, const Ends& ends) {
    Law laws[most_rows];
    JointRow rows[most_rows];
    const std::size_t count = laws_of(joint, laws);
    rows_of(joint, ends, rows);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (laws[i].kind == Law::Kind::spring && !laws[i].paired) sum += taken_up(laws[i], 0, rows[i].error);
    if (count > 1 && laws[0].kind == Law::Kind::spring && laws[0].paired)
        sum += taken_up(laws[0], 0, length(Vec2{rows[0].error, rows[1].error}));
    return sum;
}

}  // namespace carom
