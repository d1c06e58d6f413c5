#pragma once
// What the stages of a mechanism's substep share.

#include <algorithm>
#include <array>
#include <span>

#include "math/small_turn.hpp"
#include "simd/prefetch.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/shared.hpp"

namespace carom {

/// Whether joints act as much before the drift as after it: then a half is what the one before lets expect.
inline bool gives_halves(const SoftScene& scene) { return scene.drift_share == 0.5; }

inline bool is_slow(const Mechanism::Part& p) { return p.slow[0] != 1 || p.slow[1] != 1; }
/// Drifts a body that was slowed down.
void drift_slowly(const Mechanism::Part&, const State& start, double h, State&, BodyMotion&);
/// Sees a mechanism's parts where they are after the drift, with the velocities of now.
void see_drifted(int threads, const State&, const BodyMotion&, Mechanism&);
/// After that: what springs still give, and what rigid rows are expected to.
void begin_relax(const Asked&, Mechanism&);
/// What a joint's gaps are compared with [m or rad].
inline double size_of(const Member& k, const JointLine& line) { return line.law->turns ? 1 : k.size; }
/// The same of a row of a joint, and 1 over it.
inline double size_of(const Member& k, std::uint32_t row, const JointLine& line) {
    return k.joins_points(row) ? k.size : size_of(k, line);
}
inline double per_size_of(const Member& k, std::uint32_t row, const JointLine& line) {
    return !k.joins_points(row) && line.law->turns ? 1 : k.per_size;
}
/// The part of a spring's impulse in a substep of h [s] that damps: of one that has a largest force, what it gives
/// beside that which its stretch has stored.
double damping_of(const JointLine* of_joint, std::uint32_t row, double h);
/// What its springs have stored where the substep begins [J].
double stored_in_springs(const Mechanism&);
/// Twice what the drift gives to springs that change much in it: solutions may be turns away.
double given_to_springs(const Mechanism&);
/// A substep as it began, as forces alone propose it, and with its bodies where they are at its end.
struct Course {
    const State &start, &proposed, &end;
};
struct MeanVelocities;
/// Takes from a mechanism with springs what energy the method made in a substep in which it whirls or rings too fast;
/// and from one that touches nothing whatever it made, if energy is to be kept, or gives it what it lost.
void curb(const SoftScene&, double h, const Course&, std::vector<Mover>&, Mechanism&, MeanVelocities&);
/// Books what the joints did in a substep, keeps their forces, and makes ready for the next one what need not be put
/// right.
void end_substep(const SoftScene&, Mechanisms&, double h, const MeanVelocities&, const State&, Mechanism&, Flows&);
/// Makes the rows of a joint ready for a substep of h: as they were looked at, or those on which the one before
/// `ended`.
void prepare_rows(const Mechanisms&, double h, bool ended, const Member&, Mechanism&);
/// One side of a joint, or both. The compiler is to know which: these are the inner loops.
template <bool is_a, bool is_b>
struct Sides {
    static constexpr bool a = is_a, b = is_b;
};
using BothSides = Sides<true, true>;
/// The parts after all that.
void prepare_parts(int threads, double h, Mechanism&);
/// Sees of one that has loops whether rows say what others say, where the substep begins.
void note_redundancy(double h, Mechanism&);

constexpr double no_gap = 100 * tiny;  ///< of a row's size: substeps leave what is no more as it is
/// Whether a joint gapes by more than rounding.
inline bool gapes(const Mechanism& m, const Member& k, JointRow JointLine::*which) {
    const JointLine* const lines = &m.lines[k.line];
    std::uint32_t r = 0;
    for (; r < 2 && k.is_hinge; ++r)
        if (std::abs((lines[r].*which).error) > no_gap * k.size) return true;
    for (; r < k.lines; ++r)
        if (std::abs(out_of(*lines[r].law, (lines[r].*which).error)) > no_gap * size_of(k, lines[r])) return true;
    return false;
}

/// Has memory brought near that is about to be needed.
template <class List>
void fetch(const List& list) {
    constexpr std::size_t line = 64;
    const char* const bytes = reinterpret_cast<const char*>(list.data());
    for (std::size_t i = 0; i < list.size() * sizeof list[0]; i += line) prefetch(bytes + i);
}
/// The same of a mechanism that fits beside others: where there are thousands, theirs is scattered. Another thread may
/// be at work on it: only what stays as it was made is looked at.
inline void fetch(const Mechanism& m) {
    constexpr std::size_t large = 50;
    if (m.members.size() > large) return;
    fetch(m.parts), fetch(m.members), fetch(m.lines);
}

/// So many mechanisms are handed on at a time.
inline constexpr std::size_t few = 8;
/// Threads share the mechanisms that are awake and wanted: no two of them move the same body. They are handed on a few
/// at a time. What they book is added in an order that does not depend on threads.
template <class Wanted, class Act>
void each_awake_some(const SoftScene& scene, Mechanisms& mechanisms, Flows& account, Wanted wanted, Act act) {
    const std::size_t count = mechanisms.all.size(), blocks = (count + few - 1) / few;
    Scratch<Flows> booked(blocks);
    parallel_ranges(scene.threads, blocks, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t block = first; block < last; ++block) {
            Mechanism* some[few];
            std::size_t taken = 0;
            for (std::size_t i = few * block; i < std::min(count, few * (block + 1)); ++i)
                if (Mechanism& m = mechanisms.all[i]; !m.is_asleep && wanted(m)) some[taken++] = &m;
            if (taken > 0) act(std::span<Mechanism* const>(some, taken), booked[block]);
        }
    });
    for (const Flows& some_of_it : booked) account += some_of_it;
}
/// One after the other, while those are fetched that come a few later: there is time for it until then.
template <class Act>
void for_each_fetched(const Mechanisms& mechanisms, std::span<Mechanism* const> some, Act act) {
    const Mechanism* const end = mechanisms.all.data() + mechanisms.all.size();
    for (Mechanism* m : some) {
        if (end - m > static_cast<std::ptrdiff_t>(few)) fetch(m[few]);
        if (end - m > static_cast<std::ptrdiff_t>(2 * few)) fetch(std::span<const Mechanism>(m + 2 * few, 1));
        act(*m);
    }
}
template <class Wanted, class Act>
void each_awake(const SoftScene& scene, Mechanisms& mechanisms, Flows& account, Wanted wanted, Act act) {
    each_awake_some(scene, mechanisms, account, wanted, [&](std::span<Mechanism* const> some, Flows& own) {
        for_each_fetched(mechanisms, some, [&](Mechanism& m) { act(m, own); });
    });
}
template <class Wanted, class Act>
void each_awake(const SoftScene& scene, Mechanisms& mechanisms, Wanted wanted, Act act) {
    Flows none;
    each_awake(scene, mechanisms, none, wanted, [&](Mechanism& m, Flows&) { act(m); });
}

/// Threads share what is to be done within a mechanism where there are few of them.
inline int threads_within(const SoftScene& scene) { return scene.mechanisms.all.size() <= few ? scene.threads : 1; }
/// Calls act(part) for all of them. Here and below loops have copies of what they call, which nothing else can change:
/// what those have captured stays in registers.
template <class Act>
void each_part(int threads, Mechanism& m, const Act& act) {
    for_each_rows(threads, m.parts.size(), [&](std::size_t first, std::size_t last) {
        const Act own = act;
        for (Mechanism::Part *p = &m.parts[0] + first, *end = &m.parts[0] + last; p != end; ++p) own(*p);
    });
}
/// Calls act(joint, sum) for all of them, and add(joint, sides), which adds to the bodies at these sides what follows
/// from it: for a joint at a time, or where threads share it for a body at a time, in the same order for each.
template <class Sum, class Act, class Add>
void each_joint(int threads, Mechanism& m, Sum& total, const Act& act, const Add& add) {
    const bool is_shared = threads > 1 && m.members.size() > rows_at_once;
    add_over_rows(threads, m.members.size(), total, [&](std::size_t first, std::size_t last, Sum& sum) {
        const Act own_act = act;
        const Add own_add = add;
        for (const Member *k = &m.members[0] + first, *end = &m.members[0] + last; k != end; ++k) {
            own_act(*k, sum);
            if (!is_shared) own_add(*k, BothSides());
        }
    });
    if (!is_shared) return;
    for_each_rows(threads, m.parts.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = m.shape->first_holder[first]; i < m.shape->first_holder[last]; ++i) {
            const auto& holder = m.shape->holders[i];
            const Member& k = m.members[holder.joint];
            holder.is_b ? add(k, Sides<false, true>()) : add(k, Sides<true, false>());
        }
    });
}
template <class Act, class Add>
void each_joint(int threads, Mechanism& m, const Act& act, const Add& add) {
    struct Nothing {
        void operator+=(Nothing) {}
    } nothing;
    each_joint(
        threads, m, nothing, [act](const Member& k, Nothing&) { act(k); }, add);
}

inline void turn_on(End& end, double angle) {
    if (std::abs(angle) > small_turn_most) {
        const auto turn = portable::sincos(end.angle + angle);
        end.cosine = turn.cos, end.sine = turn.sin;
    } else {
        const auto [s, v] = small_turn(angle);
        const double c = end.cosine, d = end.sine;
        end.cosine = c - (v * c + s * d), end.sine = d - (v * d - s * c);
    }
    end.angle += angle;
}

/// Gives momentum along a joint's row, which `feel` turns into velocity; along those of a hinge by a short way.
template <class On = BothSides>
void push(Mechanism& m, const Member& k, std::uint32_t row, const JointRow& j, double impulse, On sides = {}) {
    const auto add = [&](double* given, const double* along, double sign) {
        if (!k.is_hinge)
            for (int i = 0; i < 2; ++i) given[i] += along[i] * impulse;
        else if (row < 2)
            given[row] += sign * impulse;
        given[2] += along[2] * impulse;
    };
    if (sides.a) add(m.parts[k.a].given, j.a, -1);
    if (sides.b) add(m.parts[k.b].given, j.b, 1);
}
/// The same along both rows in which a hinge's points are one.
template <class On>
void push_points(Mechanism& m, const Member& k, const JointRow& x, const JointRow& y, Vec2 impulse, On sides) {
    const auto add = [&](double* given, double along_x, double along_y, double sign) {
        given[0] += sign * impulse.x, given[1] += sign * impulse.y;
        given[2] = (given[2] + along_x * impulse.x) + along_y * impulse.y;
    };
    if (sides.a) add(m.parts[k.a].given, x.a[2], y.a[2], -1);
    if (sides.b) add(m.parts[k.b].given, x.b[2], y.b[2], 1);
}
/// The same along all rows of a joint.
template <class On, class ImpulseOf>
void push_all(Mechanism& m, const Member& k, JointRow JointLine::*which, On sides, ImpulseOf impulse_of) {
    const JointLine* const lines = &m.lines[k.line];
    std::uint32_t r = 0;
    if (k.is_hinge) {
        push_points(m, k, lines[0].*which, lines[1].*which, {impulse_of(0), impulse_of(1)}, sides);
        r = 2;
    }
    for (; r < k.lines; ++r)
        if (const double impulse = impulse_of(r); impulse != 0) push(m, k, r, lines[r].*which, impulse, sides);
}
/// J v of a joint's row, for the velocities of its two bodies.
inline double speed(const Member& k, std::uint32_t row, const JointRow& j, const double* a, const double* b) {
    if (!k.is_hinge)
        return (j.a[0] * a[0] + j.a[1] * a[1] + j.a[2] * a[2]) + (j.b[0] * b[0] + j.b[1] * b[1] + j.b[2] * b[2]);
    if (row < 2) return (j.a[2] * a[2] - a[row]) + (j.b[2] * b[2] + b[row]);
    return b[2] - a[2];
}
/// The same along both rows in which a hinge's points are one.
inline Vec2 speed_of_points(const JointRow& x, const JointRow& y, const double* a, const double* b) {
    return {(x.a[2] * a[2] - a[0]) + (x.b[2] * b[2] + b[0]), (y.a[2] * a[2] - a[1]) + (y.b[2] * b[2] + b[1])};
}
inline double speed(const Mechanism& m, const Member& k, std::uint32_t row, const JointRow& j) {
    return speed(k, row, j, m.parts[k.a].v, m.parts[k.b].v);
}
/// The mean velocities of a mechanism's parts in a substep, from what they began with and have now.
struct MeanVelocities {
    Scratch<std::array<double, 3>> all;

    MeanVelocities(int threads, const Mechanism& m, const Motion& before, const std::vector<Mover>& movers)
        : all(m.parts.size()) {
        take(threads, m, before, movers);
    }
    void take(int threads, const Mechanism& m, const Motion& before, const std::vector<Mover>& movers) {
        for_each_rows(threads, all.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t row = m.parts[i].row;
                if (row >= before.size()) continue;  // the ground
                const Mover& last = movers[row];
                const Vec2 first = before.linear[row];
                all[i] = {0.5 * (first.x + last.vx), 0.5 * (first.y + last.vy), 0.5 * (before.angular[row] + last.w)};
            }
        });
    }
    double along(const Member& k, std::uint32_t row, const JointRow& j) const {
        return speed(k, row, j, all[k.a].data(), all[k.b].data());
    }
    /// Along both rows in which a hinge's points are one.
    Vec2 along_points(const Member& k, const JointRow& x, const JointRow& y) const {
        return speed_of_points(x, y, all[k.a].data(), all[k.b].data());
    }
};
/// Its velocity with all that it was given.
inline double felt(const Mechanism::Part& p, std::size_t i) { return p.v[i] + p.ease[i] * (p.given[i] - p.known[i]); }
inline void feel(Mechanism::Part& p) {
    for (std::size_t i = 0; i < 3; ++i) p.v[i] = felt(p, i), p.known[i] = p.given[i];
}
inline void feel(int threads, Mechanism& m) {
    each_part(threads, m, [](Mechanism::Part& p) { feel(p); });
}

inline bool is_in(Step step) { return step == Step::held || step == Step::lower || step == Step::upper; }

/// Of a hinge: from the centres to its points, and from one of these to the other.
struct Levers {
    Vec2 a, b, between;
    Levers(const Member& k, const End& first, const End& second)
        : a(first.turn(k.anchor_a)),
          b(second.turn(k.anchor_b)),
          between((second.position - first.position) + (b - a)) {}
};
/// Rows of a hinge, which have the directions that they were made with.
template <bool whole>
void look_at_hinge(const Mechanism& m, const Member& k, JointRow JointLine::*to, JointLine* lines) {
    const End &a = m.parts[k.a].now, &b = m.parts[k.b].now;
    const Levers levers(k, a, b);
    const Vec2 lever_a = levers.a, lever_b = levers.b, between = levers.between;
    JointRow &first = lines[0].*to, &second = lines[1].*to;
    first.error = between.x, second.error = between.y;
    if (whole) {
        first.a[2] = lever_a.y, first.b[2] = -lever_b.y;
        second.a[2] = -lever_a.x, second.b[2] = lever_b.x;
    }
    const double angle = b.angle - a.angle - k.rest;
    for (std::uint32_t i = 2; i < k.lines; ++i) (lines[i].*to).error = angle;
}
/// A joint's row as another one of it: of hinges all but levers and gaps stays as it was made.
inline void take_row(const Member& k, const JointRow& from, JointRow& to) {
    if (!k.is_hinge)
        to = from;
    else
        to.a[2] = from.a[2], to.b[2] = from.b[2], to.error = from.error;
}
/// A body where the state is, or the ground.
inline End end_of(std::uint32_t row, const State& state, const std::vector<Frame>& frames) {
    if (row >= state.size()) return {};
    const Frame& from = frames[row];
    return {from.position, from.cosine, from.sine, state.x.angular[row]};
}
/// Sees a part there.
inline void see(Mechanism::Part& p, const State& state, const std::vector<Frame>& frames) {
    p.now = end_of(p.row, state, frames);
}
/// Rows of a joint for its bodies where they are.
inline void rows_of(const Member& k, const std::vector<Joint>& joints, const End& a, const End& b, JointRow* rows) {
    rows_of(joints[k.joint], Ends(k.anchor_a, k.anchor_b, a, b), rows);
    rows[0].error -= k.longer;
}
/// Rows of a joint for its parts as they are now, of each line in `to`; of a hinge, if so wanted, only the gaps.
template <bool whole = true>
void look(Mechanism& m, const Member& k, const std::vector<Joint>& joints, JointRow JointLine::*to) {
    JointLine* const lines = &m.lines[k.line];
    if (k.is_hinge) {
        look_at_hinge<whole>(m, k, to, lines);
        return;
    }
    JointRow rows[most_rows];
    rows_of(k, joints, m.parts[k.a].now, m.parts[k.b].now, rows);
    for (std::uint32_t i = 0; i < k.lines; ++i) lines[i].*to = rows[i];
}
inline void look(int threads, Mechanism& m, const std::vector<Joint>& joints, JointRow JointLine::*to) {
    each_joint(
        threads, m, [&](const Member& k) { look(m, k, joints, to); }, [](const Member&, auto) {});
}

/// How the joints' forces resist that the parts turn, and rods' that they move: what levers and rods turn into the
/// force.
template <class On, class Force>
void add_stiffness(Mechanism& m, const std::vector<Joint>& joints, const Member& k, On sides, Force force_of) {
    const JointLine* const lines = &m.lines[k.line];
    Mechanism::Part &a = m.parts[k.a], &b = m.parts[k.b];
    if (k.is_hinge) {
        const double x = force_of(0), y = force_of(1);
        if (sides.a) a.stiffness[1] += x * lines[1].first.a[2] - y * lines[0].first.a[2];
        if (sides.b) b.stiffness[1] += x * lines[1].first.b[2] - y * lines[0].first.b[2];
        return;
    }
    Vec2 force{};
    for (std::uint32_t r = 0; r < k.lines; ++r) {
        if (lines[r].law->kind == Law::Kind::spring) continue;  // those may ring, and are stable
        force += force_of(r) * Vec2{lines[r].first.b[0], lines[r].first.b[1]};
    }
    const Ends ends(k.anchor_a, k.anchor_b, a.now, b.now);
    if (sides.a) a.stiffness[1] -= dot(force, ends.lever_a);
    if (sides.b) b.stiffness[1] += dot(force, ends.lever_b);
    const double apart = length(ends.between);
    if (!std::holds_alternative<DistanceJoint>(joints[k.joint].type) || apart == 0) return;
    const double tension = -dot(force, ends.between) / (apart * apart);
    if (sides.a) a.stiffness[0] += 2 * tension;
    if (sides.b) b.stiffness[0] += 2 * tension;
}
/// That of the forces which the joints had.
template <class On>
void stiffen(const Mechanisms& all, const Member& k, On sides, Mechanism& m) {
    const JointMemory& memory = all.memory[k.joint];
    add_stiffness(m, all.joints, k, sides, [&](std::uint32_t row) { return memory.mean[row]; });
}
inline void forget_stiffness(int threads, Mechanism& m) {
    each_part(threads, m, [](Mechanism::Part& p) { p.stiffness[0] = p.stiffness[1] = 0; });
}

inline void take_velocity(Mechanism::Part& p, const std::vector<Mover>& movers) {
    const Mover& from = movers[p.row];
    p.v[0] = p.slow[0] * from.vx, p.v[1] = p.slow[0] * from.vy, p.v[2] = p.slow[1] * from.w;
}
inline void take_velocities(int threads, Mechanism& m, const std::vector<Mover>& movers) {
    each_part(threads, m, [&](Mechanism::Part& p) { take_velocity(p, movers); });
}
inline void give_velocity(const Mechanism::Part& p, std::vector<Mover>& movers) {
    if (p.inverse_mass == 0) return;
    Mover& to = movers[p.row];
    if (is_slow(p))
        to.vx = p.v[0] / p.slow[0], to.vy = p.v[1] / p.slow[0], to.w = p.v[2] / p.slow[1];
    else
        to.vx = p.v[0], to.vy = p.v[1], to.w = p.v[2];
}
inline void give_velocities(int threads, Mechanism& m, std::vector<Mover>& movers) {
    each_part(threads, m, [&](const Mechanism::Part& p) { give_velocity(p, movers); });
}
/// What joints give where contacts act too is no contact's: to be noted with −1 before, and with 1 after.
inline void note_velocity(const Mover& mover, double sign, Twist& given) {
    given.velocity += sign * Vec2{mover.vx, mover.vy};
    given.angular_velocity += sign * mover.w;
}
inline void note_touched_velocities(const Mechanism& m, double sign, BodyMotion& motion) {
    if (!m.is_touched) return;
    for (const Mechanism::Part& p : m.parts)
        if (p.inverse_mass != 0) note_velocity(motion.movers[p.row], sign, motion.by_joints[p.row]);
}
inline void set_ease(Mechanism::Part& p) {
    p.ease[0] = p.ease[1] = p.slow[0] * p.inverse_mass, p.ease[2] = p.slow[1] * p.inverse_inertia;
}
inline void set_ease(Mechanism& m) {
    for (Mechanism::Part& p : m.parts) set_ease(p);
}

}  // namespace carom
