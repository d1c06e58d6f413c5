// How long a substep may be, for loads that press deep; and a part of one, for what turns fast on its joints, and for
// what strikes while it hangs on them.

#include <algorithm>
#include <cmath>

#include "solvers/islands.hpp"
#include "solvers/parts.hpp"
#include "solvers/shared.hpp"

namespace carom {

namespace {

/// Where a joint's anchors are, and how they move.
struct Anchors {
    Vec2 at[2], v[2];

    Anchors(const Mechanism& m, const Member& k, const State& state) : at{k.anchor_a, k.anchor_b}, v{} {
        for (const bool is_b : {false, true}) {
            const std::uint32_t row = m.parts[is_b ? k.b : k.a].row;
            if (row >= state.size()) continue;
            const Vec2 place = state.x.linear[row], lever = frame_at(place, state.x.angular[row]).turn(at[is_b]);
            at[is_b] = place + lever, v[is_b] = velocity_at(state, row, lever);
        }
    }
    Vec2 between() const { return at[1] - at[0]; }
};

/// How fast rows of a joint turn that keep it [rad/s]: with the levers on which they act, or along a line or an axis.
double turning(const Mechanism& m, const Member& k, const JointType& type, const State& state) {
    constexpr double short_lever = 0.01;  // part of what its body gives way by, for the lever to count
    const bool is_distance = std::holds_alternative<DistanceJoint>(type);
    if (k.rigid == 0 && !is_distance) return 0;  // a rope keeps its length by a limit
    const bool carries_axis = std::holds_alternative<PrismaticJoint>(type) || std::holds_alternative<WheelJoint>(type);
    double fastest = 0;
    for (const bool is_b : {false, true}) {
        const Mechanism::Part& p = m.parts[is_b ? k.b : k.a];
        if (p.row >= state.size()) continue;
        const Vec2 anchor = is_b ? k.anchor_b : k.anchor_a;
        const double spin = std::abs(state.v.angular[p.row]), yields = p.inverse_inertia * dot(anchor, anchor);
        const bool has_axis = !is_b && carries_axis;
        if (has_axis || yields > short_lever * p.inverse_mass) fastest = std::max(fastest, spin);
    }
    if (k.is_hinge) return fastest;
    const Anchors ends(m, k, state);
    const auto add = [&](Vec2 line, Vec2 rate) {
        const double square = dot(line, line);
        if (square > short_lever * k.size * k.size) fastest = std::max(fastest, std::abs(cross(line, rate)) / square);
    };
    if (is_distance) add(ends.between(), ends.v[1] - ends.v[0]);
    if (const auto* pulley = std::get_if<PulleyJoint>(&type))
        add(ends.at[0] - pulley->ground_a, ends.v[0]), add(ends.at[1] - pulley->ground_b, ends.v[1]);
    return fastest;
}

/// What bears a joint's points, in the mean of late [N].
double tension_of(const Mechanism& m, const Member& k, const JointMemory& memory) {
    double square = 0;
    for (std::uint32_t r = 0; r < k.lines; ++r) {
        const Law& law = *m.lines[k.line + r].law;
        if (law.kind != Law::Kind::spring && !law.turns) square += memory.mean[r] * memory.mean[r];
    }
    return std::sqrt(square);
}

constexpr double little_turn = 0.1;  ///< turn in a substep [rad]

/// At most so fast a mechanism zig-zags between its joints [rad/s] where they turn by more than a little in h [s]:
/// their forces, which last, on levers turn bodies, and rods move what they hold. What hangs taut and hardly turns is
/// slowed down in place of being cut.
double zig_zag(const Mechanisms& all, const Mechanism& m, const State& state, double h) {
    const auto is_moved = [](const Mechanism::Part& p) { return p.inverse_mass > 0; };
    if (std::count_if(m.parts.begin(), m.parts.end(), is_moved) < 2) return 0;  // a pendulum swings
    struct Held {
        double linear = 0, angular = 0;  ///< stiffness [N/m], [N m]
        bool turns = false;
    };
    Scratch<Held> held(m.parts.size());
    for (const Member& k : m.members) {
        const JointType& type = all.joints[k.joint].type;
        const double pull = tension_of(m, k, all.memory[k.joint]);
        const bool turns = turning(m, k, type, state) * h > little_turn;
        const double apart = std::holds_alternative<DistanceJoint>(type) ? length(Anchors(m, k, state).between()) : 0;
        for (const bool is_b : {false, true}) {
            Held& end = held[is_b ? k.b : k.a];
            end.angular += pull * length(is_b ? k.anchor_b : k.anchor_a);
            if (apart > 0) end.linear += 2 * pull / apart;
            end.turns = end.turns || turns;
        }
    }
    double fastest = 0;
    for (std::size_t i = 0; i < m.parts.size(); ++i) {
        const Mechanism::Part& p = m.parts[i];
        const double square = std::max(held[i].linear * p.inverse_mass, held[i].angular * p.inverse_inertia);
        if (held[i].turns) fastest = std::max(fastest, std::sqrt(square));
    }
    return fastest;
}

/// Of its bodies [rad/s].
double fastest_spin(const Mechanism& m, const State& state) {
    double spin = 0;
    for (const Mechanism::Part& p : m.parts)
        if (p.row < state.size()) spin = std::max(spin, std::abs(state.v.angular[p.row]));
    return spin;
}

/// In how many parts a second has to be cut.
double parts_a_second(const SoftScene& scene, const State& state, double h, bool asks_for_zig_zags) {
    constexpr double far = 0.3, too_far = 0.75;  // [rad] for springs and ropes, and rigid rows
    constexpr double stable = 0.25;  // rad of a zig-zag: what is freed and caught in other phases keeps its energy then
    double rigid = 0, soft = 0, zig = 0;
    for (const Mechanism& m : scene.mechanisms.all) {
        if (m.is_asleep) continue;
        const double most = m.is_hinged ? fastest_spin(m, state) * h : HUGE_VAL;  // hinges turn with their bodies
        if (asks_for_zig_zags && most > little_turn) zig = std::max(zig, zig_zag(scene.mechanisms, m, state, h));
        if (most <= too_far) continue;
        for (const Member& k : m.members) {
            double& fastest = k.rigid > 0 ? rigid : soft;
            fastest = std::max(fastest, turning(m, k, scene.mechanisms.joints[k.joint].type, state));
        }
    }
    const bool turn_far = rigid * h > too_far || soft * h > far;
    return std::max(turn_far ? std::max(rigid, soft) / far : 0, zig / stable);
}

/// The velocity that a mechanism has as a whole, if nothing holds it.
Vec2 drift_of(const Mechanism& m, const Bodies& bodies, const State& state) {
    if (std::any_of(m.members.begin(), m.members.end(), [](const Member& k) { return k.outside; })) return {};
    Vec2 momentum{};
    double mass = 0;
    for (const Mechanism::Part& p : m.parts)
        momentum += bodies.mass[p.row] * state.v.linear[p.row], mass += bodies.mass[p.row];
    return (1 / mass) * momentum;
}

/// Whether joints hold one of the two.
bool is_limb(const SoftScene& scene, const SoftContact& c) {
    const auto hangs = [&](std::uint32_t row) { return row < scene.bodies.size() && scene.mechanisms.holds[row]; };
    return !scene.mechanisms.empty() && (hangs(c.a) || hangs(c.b));
}

/// As much as joints may bend the way of a body's points [m/s²], by row: where one of a mechanism turns, all are held
/// off the ways on which they would fly.
Scratch<double> bending(const SoftScene& scene, const State& state, const SoftContacts& contacts) {
    Scratch<double> bends(state.size() + 1);
    for (const Mechanism& m : scene.mechanisms.all) {
        const Vec2 drift = drift_of(m, scene.bodies, state);
        double most = 0;
        for (const Mechanism::Part& p : m.parts) {
            if (p.row >= state.size()) continue;
            const double spin = std::abs(state.v.angular[p.row]);
            most =
                std::max(most, spin * (length(state.v.linear[p.row] - drift) + spin * contacts.pieces.extent[p.row]));
        }
        for (const Mechanism::Part& p : m.parts) bends[p.row] = most;
    }
    return bends;
}

}  // namespace

double cut_by_turns(const SoftScene& scene, const State& state, double left, double h) {
    constexpr double most = 8;                // parts of a substep as it was asked for
    constexpr double forgotten = 1;           // s
    constexpr std::size_t most_joints = 200;  // of a world that can afford it
    Mechanisms& all = scene.mechanisms;
    if (all.empty()) return left;
    const bool are_few = all.joints.size() <= most_joints;
    const double wanted = parts_a_second(scene, state, h, are_few);
    all.cuts = are_few ? std::max(all.cuts, wanted) : wanted;
    // Where stiff forces have the step cut, the shorter substeps count among the parts: they are the world's, and many.
    const double allowed = most / scene.cuts;
    const double part = left / std::ceil(std::clamp(all.cuts * left, 1.0, std::max(1.0, allowed * left / h)));
    all.cuts /= 1 + part / forgotten;
    return part;
}

namespace {

/// What forces press two bodies together with [m/s²].
class Pressing {
  public:
    Pressing(const SoftScene& scene, State& state, SoftContacts& contacts)
        : scene_(scene), state_(state), rates_(contacts.motion.rates) {}

    double operator()(const SoftContact& c, Vec2 normal) {
        const Dynamics& dynamics = scene_.flight.dynamics;
        if (!is_evaluated_ && !dynamics.is_free_flight()) dynamics.evaluate(state_, rates_);
        is_evaluated_ = true;
        const auto acceleration = [&](std::uint32_t row) {
            if (!moves(scene_, row)) return Vec2{};
            return dynamics.is_free_flight() ? dynamics.gravity() : rates_.acceleration.linear[row];
        };
        return std::max(0.0, dot(acceleration(c.a) - acceleration(c.b), normal));
    }

  private:
    const SoftScene& scene_;
    State& state_;
    Rates& rates_;
    bool is_evaluated_ = false;  ///< once somebody asks
};

}  // namespace

double until_strike(const SoftScene& scene, State& state, SoftContacts& contacts, double h) {
    constexpr double at_once = 1e-3, anywhere = 1e300;  // of h
    constexpr double slow = 1e-3;      // of the pieces' size in a substep: slower ones may come to rest, or hang
    constexpr double just = 1 - 1e-3;  // before it: at its end the velocities of the flight are not along the joints
    constexpr int most_strikes = 3;    // of more that strike in a substep not each can have a part of it
    // Forces that look at velocities are those of a flight without a bounce: there the strike is alone in its part.
    const bool all = scene.flight.dynamics.sees_velocity();
    if (scene.mechanisms.empty() && !all) return h;
    // What is deep in one another is parted, in short substeps as fast as in long ones: for slow strikes none is cut.
    const bool cuts_slow = all && std::none_of(contacts.all.begin(), contacts.all.end(), [=](const SoftContact& c) {
                               return least_gap(c.manifold) < -slow * c.size;
                           });
    Scratch<double> bends;  // once somebody asks
    Pressing pull(scene, state, contacts);
    double hung = h, free = h;
    int strikes = 0;
    for (const std::uint32_t i : contacts.lists.strikers) {  // who bounces and is not in a crowd is one until it rests
        const SoftContact& c = contacts.all[i];
        const bool is_hung = is_limb(scene, c);
        if (c.restitution == 0 || c.rests || c.crowded || !(all || is_hung)) continue;
        const Frame &a = contacts.motion.frames[c.a], &b = contacts.motion.frames[c.b];
        const Manifold m = look(scene, c.candidate(), a, b, anywhere);
        double first = h;
        for (int k = 0; k < m.count; ++k) {
            const auto lever = levers(c, m, k, b.position - a.position);
            const Vec2 of_a = velocity_at(state, c.a, lever[0]), of_b = velocity_at(state, c.b, lever[1]);
            const double closing = -dot(of_b - of_a, m.normal), gap = m.point[k].gap;
            if (!(closing > 0)) continue;
            const bool is_slow = closing * h <= slow * c.size;
            if (is_slow && (!cuts_slow || closing <= least_bounce * h * pull(c, m.normal))) continue;
            if (gap <= at_once * h * closing) {
                first = std::min(first, 2 * at_once * h);
                continue;
            }
            const double falling =
                (int{moves(scene, c.a)} - int{moves(scene, c.b)}) * dot(scene.flight.dynamics.gravity(), m.normal);
            if (is_hung && bends.empty()) bends = bending(scene, state, contacts);
            const double bent = is_hung ? bends[c.a] + bends[c.b] : 0;
            const double root = std::sqrt(std::max(0.0, closing * closing + 2 * gap * (falling + bent)));
            first = std::min(first, std::max(just * 2 * gap / (closing + root), at_once * h));
        }
        if (first < h && all && ++strikes > most_strikes && scene.mechanisms.empty()) return h;
        double& least = is_hung ? hung : free;
        least = std::min(least, first);
    }
    return strikes > most_strikes ? hung : std::min(hung, free);
}

namespace {

/// What some contacts ask for.
struct Askers {
    int times = 1;  ///< the substeps: what one has asked for the others need not ask again
    std::size_t pressed = 0, asking = 0, stirred = 0;

    void operator+=(const Askers& other) {
        times = std::max(times, other.times);
        pressed += other.pressed, asking += other.asking, stirred += other.stirred;
    }
};

/// What all contacts ask for.
struct Wanted {
    Askers crowds{}, limbs{}, others{};  ///< limbs of those outside crowds
    std::size_t crushed = 0;
    bool is_even = true;

    void operator+=(const Wanted& other) {
        crowds += other.crowds, limbs += other.limbs, others += other.others;
        crushed += other.crushed, is_even = is_even && other.is_even;
    }
};

}  // namespace

int more_substeps(const SoftScene& scene, const State& state, double h, const PreciseIslands& islands,
                  const SoftContacts& contacts) {
    constexpr double much = 2e-3, more = 1e-2, very_much = 2e-2;  // of the size
    constexpr std::size_t many = 4;                               // of so many contacts one
    // Of its like: more than much only of what is small.
    const double under_few = 5 * overlap_under_weight(scene, h * contacts.pace.softer);
    const bool falls = scene.flight.dynamics.gravity() != Vec2{};
    const auto ask = [&](const SoftContact& c, Wanted& wanted) {
        wanted.is_even = wanted.is_even && !c.is_hard;
        if (islands.hold(c)) return;
        const bool in_crowd = falls && is_in_crowd(c, contacts);
        const double size = std::min(c.size, c.thickness / thin);
        const double way = std::clamp(under_few, much * size, more * size);
        const int times = c.thickness < thin * c.size ? 4 : 2;
        wanted.crushed += c.load.presses_deep(very_much * c.size, 2);
        const bool hangs = is_limb(scene, c);
        if (in_crowd && hangs) return;  // of many some always would
        Askers& of = in_crowd ? wanted.crowds : hangs ? wanted.limbs : wanted.others;
        while (of.times < times && c.load.presses_deep(way, of.times)) of.times *= 2;
        if (&of == &wanted.others || !c.pressed()) return;
        ++of.pressed, of.asking += c.load.presses_deep(way);
        of.stirred += in_crowd && is_stirred(scene, state, c, contacts);
    };
    const auto& all = contacts.all;
    const Wanted wanted =
        sum_over_rows<Wanted>(scene.threads, all.size(), [&](std::size_t first, std::size_t last, Wanted& part) {
            for (std::size_t i = first; i < last; ++i) ask(all[i], part);
        });
    if (wanted.is_even && many * wanted.crushed > all.size()) return 4;
    const Askers &crowds = wanted.crowds, &limbs = wanted.limbs;
    const bool are_stirred = 2 * crowds.stirred >= crowds.pressed;
    const bool are_few = limbs.pressed > crowd && 2 * limbs.asking < limbs.pressed;
    return std::max({are_stirred ? 1 : crowds.times, are_few ? 1 : limbs.times, wanted.others.times});
}

}  // namespace carom
