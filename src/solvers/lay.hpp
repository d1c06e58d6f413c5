#pragma once
// How a mechanism is laid on the desk for its solve (solvers/desk_rows.hpp), and taken up again.

#include <bit>
#include <cstddef>
#include <cstring>

#include "simd/isa.hpp"
#include "solvers/factor.hpp"

namespace carom {

/// So many doubles side by side: what lanes are to those that do not compute with them.
template <int L>
struct alignas(8 * L) Many {
    double at[L];
};
inline double& lane_of(double& a, int) { return a; }
inline double lane_of(const double& a, int) { return a; }
template <int L>
double& lane_of(Many<L>& a, int lane) {
    return a.at[lane];
}
template <int L>
double lane_of(const Many<L>& a, int lane) {
    return a.at[lane];
}

inline const DeskKernel& desk_kernel() {
    return kernel_in_use<baseline_desk_kernel, avx2_desk_kernel, avx512_desk_kernel>();
}

/// A solve as it is asked for.
struct Asked {
    const Mechanisms& all;
    double h, share;
    bool drifts;
    Round round;
    int threads;  ///< that share what is done within a mechanism

    /// Whether rows are kept where the drift ends.
    bool is_exact() const { return drifts && round == Round::last; }
    JointRow JointLine::*which() const { return drifts ? &JointLine::first : &JointLine::last; }
    double JointLine::*impulse() const { return drifts ? &JointLine::before : &JointLine::after; }
    /// Whether rows begin with what the substep before lets expect; after the drift they have it already.
    bool foresees(const Mechanism& m) const { return m.is_touched ? drifts && round == Round::first : is_exact(); }
    double expected(const JointLine& line) const { return h * line.half; }
    /// Whether joints act as much before the drift as after it; and how long, as far as that is expected of a
    /// mechanism, the force of the substep before goes on after it.
    bool gives_halves() const { return share == 0.5; }
    double half_expected(const Mechanism& m) const { return gives_halves() && !m.is_least ? h : 0; }

    /// Which rows of mechanisms side by side there are to hold.
    const Mechanism::Rows& rows(const Mechanism& m) const { return drifts ? *m.shape : m.shape->after_drift; }

    /// In how many substeps up to now it had to be projected.
    std::uint32_t projections(const Mechanism& m) const { return all.memory[m.members[0].joint].projections; }
    /// Whether it is projected at once: what has just failed is tried again after twice as many substeps.
    bool tries_nothing(const Mechanism& m) const {
        return is_exact() && projections(m) > 0 && !std::has_single_bit(projections(m));
    }
};

/// What a row of a bound is to be at.
inline DeskBound<double> wanted(const Mechanism& m, const DeskTask& task, const BoundShape& b, const JointLine& line) {
    const Law& law = *line.law;
    const DeskLaw<double> numbers{law.stiffness, law.damping, law.lower, law.upper, law.speed, law.most};
    const double size = size_of(m.members[b.joint], line);
    return wanted(task, b, numbers, line.first.error, line.last.error, line.before, size);
}
/// The impulse with which one of two rows that have one bound is pushed: against the slip, and after the drift as
/// before it; of a spring as it pulls.
inline double push_of_pair(const Mechanism& m, const BoundShape& b, const DeskTask& task, JointRow JointLine::*which) {
    const Member& k = m.members[b.joint];
    const JointLine* const lines = &m.lines[k.line];
    double along[2], middle = 0, most = 0;
    for (std::uint32_t r = 0; r < 2; ++r) {
        const DeskBound<double> w = wanted(m, task, b, lines[r]);
        const bool goes_on = !b.is_spring && !task.drifts && (lines[0].before != 0 || lines[1].before != 0);
        along[r] = goes_on ? lines[r].before : w.speed - speed(m, k, r, lines[r].*which);
        if (r == b.row) middle = 0.5 * (w.least + w.most), most = 0.5 * (w.most - w.least);
    }
    const double whole = length(Vec2{along[0], along[1]});
    return whole > 0 && most < HUGE_VAL ? middle + most * along[b.row] / whole : 0;
}

/// Memory in which mechanisms of a shape lie side by side.
template <class V, int N>
class DeskLayout {
  public:
    explicit DeskLayout(const DeskShape& s, std::size_t most_below, bool has_matrix) {
        const std::size_t blocks = has_matrix ? 1 : 0;
        const auto carve = [this]<class T>(T*& to, std::size_t count) {
            to = reinterpret_cast<T*>(bytes_);  // an offset until there is memory
            bytes_ += count * sizeof(T);
        };
        const auto carve_all = [&] {
            carve(parts, s.parts), carve(anchors, s.joints), carve(lines, s.lines), carve(bounds, s.bounds);
            carve(unknowns, N * s.joints), carve(diagonal, blocks * s.joints), carve(below, blocks * s.blocks);
            carve(scaled, blocks * most_below), carve(is_factored, blocks);
        };
        carve_all();
        size_ = bytes_ + alignof(V);
        taken_ = take_scratch(size_);
        const auto address = reinterpret_cast<std::uintptr_t>(taken_);
        bytes_ = (address + alignof(V) - 1) / alignof(V) * alignof(V);
        carve_all();
    }
    DeskLayout(const DeskLayout&) = delete;
    DeskLayout& operator=(const DeskLayout&) = delete;
    ~DeskLayout() { give_back_scratch(taken_, size_); }

    /// Has all of it brought near at once: a solve asks for it bit by bit.
    void fetch() const { carom::fetch(std::span(static_cast<const char*>(taken_), size_)); }

    DeskMemory memory() const {
        return {parts, anchors, lines, bounds, unknowns, diagonal, below, scaled, is_factored};
    }

    DeskPart<V>* parts;
    DeskAnchors<V>* anchors;
    DeskLine<V>* lines;
    DeskBound<V>* bounds;
    V* unknowns;
    BlockOf<V, N>*diagonal, *below, *scaled;
    bool* is_factored;

  private:
    std::uintptr_t bytes_ = 0;
    std::size_t size_;
    void* taken_;
};

template <int N>
void lay_bounds(const Mechanism& m, const Asked& asked, const DeskTask& task, DeskLayout<double, N>& to) {
    for (std::size_t i = 0; i < m.shape->bounds.size(); ++i) {
        const BoundShape& b = m.shape->bounds[i];
        to.bounds[i] = wanted(m, task, b, m.lines[b.line]);
        if (b.is_paired) to.bounds[i].push = push_of_pair(m, b, task, asked.which());
    }
}
/// So many numbers as they follow one another.
template <std::size_t count>
void copy_numbers(const void* from, void* to) {
    std::memcpy(to, from, count * sizeof(double));
}
/// What a mechanism's numbers have in common with those on the desk, as DeskSource has it: of where the drift begins
/// nobody asks after it.
template <bool drifts, int N>
void lay_numbers(const Mechanism& m, DeskLayout<double, N>& to) {
    const auto at = [](const auto& of, std::size_t offset) { return reinterpret_cast<const char*>(&of) + offset; };
    for (std::size_t p = 0; p < m.parts.size(); ++p)
        copy_numbers<laid_of_part[drifts]>(at(m.parts[p], offsetof(Mechanism::Part, ease)), &to.parts[p]);
    for (std::size_t i = 0; i < m.members.size(); ++i)
        copy_numbers<laid_of_anchors>(&m.members[i].size, &to.anchors[i]);
    for (std::size_t i = 0; i < m.lines.size(); ++i)
        copy_numbers<laid_of_row[drifts]>(
            at(m.lines[i], drifts ? offsetof(JointLine, first) : offsetof(JointLine, last)), &to.lines[i]);
}
/// Lays one mechanism, alone.
template <int N>
void lay(const Mechanism& m, const Asked& asked, const DeskTask& task, DeskLayout<double, N>& to) {
    asked.drifts ? lay_numbers<true>(m, to) : lay_numbers<false>(m, to);
    for (const Member& k : m.members)
        for (std::uint32_t r = 0; r < k.lines && !k.is_hinge; ++r)
            to.lines[k.line + r].per_size = per_size_of(k, r, m.lines[k.line + r]);
    for (const BoundShape& b : m.shape->bounds) to.lines[b.line].step = number_of(m.lines[b.line].step);
    lay_bounds(m, asked, task, to);
}

/// Where the numbers of mechanisms lie that are to be laid side by side; `of` says which one a lane has.
template <class Of>
DeskSource source_of(Of of, int lanes, const Asked& asked) {
    const auto numbers = [](std::size_t bytes) { return bytes / sizeof(double); };
    static_assert(sizeof(Mechanism::Part) % 8 == 0 && sizeof(Member) % 8 == 0 && sizeof(JointLine) % 8 == 0);
    static_assert(offsetof(Mechanism::Part, start) == offsetof(Mechanism::Part, ease) + 12 * sizeof(double));
    static_assert(offsetof(Mechanism::Part, now) == offsetof(Mechanism::Part, start) + 5 * sizeof(double));
    static_assert(offsetof(JointLine, half) == offsetof(JointLine, first) + 9 * sizeof(double));
    static_assert(offsetof(JointLine, after) == offsetof(JointLine, last) + 8 * sizeof(double));
    static_assert(offsetof(Law, most) == offsetof(Law, stiffness) + 5 * sizeof(double));
    DeskSource source{};
    source.part = numbers(sizeof(Mechanism::Part)), source.joint = numbers(sizeof(Member));
    source.law = numbers(sizeof(Law)), source.line = numbers(sizeof(JointLine));
    for (int lane = 0; lane < lanes; ++lane) {
        const Mechanism& m = of(lane);
        source.parts[lane] = m.parts[0].ease, source.joints[lane] = &m.members[0].size;
        source.laws[lane] = &(*m.laws)[0].stiffness;
        source.lines[lane] = (m.lines[0].*asked.which()).a, source.starts[lane] = &m.lines[0].first.error;
        source.expected[lane] = asked.half_expected(m), source.of_springs[lane] = m.is_projected ? 0 : 1;
    }
    return source;
}

/// The gaps of springs where the drift ends.
template <class V, int N>
void note_ends(const DeskLayout<V, N>& from, int lane, Mechanism& m) {
    for (const BoundShape& b : m.shape->bounds)
        if (b.is_spring) m.lines[b.line].last.error = lane_of(from.lines[b.line].last_error, lane);
}
/// Takes mechanisms up as the solve left them, or as it found them: those in the lanes that are wanted.
template <bool as_found = false, class V, int N, class Of>
void take_up(const DeskShape& shape, const DeskLayout<V, N>& from, const Asked& asked, int lanes, unsigned wanted,
             Of of) {
    // One that is alone has all of its lines on the desk.
    const auto line_of = [&](std::size_t line) { return sizeof(V) == sizeof(double) ? line : shape.line_of[line]; };
    for (int lane = 0; lane < lanes; ++lane) {
        if ((wanted >> lane & 1U) == 0) continue;
        Mechanism& m = of(lane);
        for (std::size_t p = 0; p < m.parts.size(); ++p) {
            Mechanism::Part& part = m.parts[p];
            const DeskPart<V>& own = from.parts[p];
            for (int i = 0; i < 3; ++i) {
                part.v[i] = lane_of(as_found ? own.first_v[i] : own.v[i], lane);
                part.given[i] = part.known[i] = lane_of(as_found ? own.first_given[i] : own.given[i], lane);
            }
        }
        const auto impulse = asked.impulse();
        for (std::size_t i = 0; i < shape.lines; ++i) {
            const DeskLine<V>& own = from.lines[i];
            m.lines[line_of(i)].*impulse = lane_of(as_found ? own.first_impulse : own.impulse, lane);
        }
        for (std::size_t i = 0; i < shape.bounds; ++i) {
            const std::uint32_t line = shape.bound[i].line;
            const DeskLine<V>& own = from.lines[line];
            m.lines[line_of(line)].step = static_cast<Step>(lane_of(as_found ? own.first_step : own.step, lane));
        }
    }
}
/// Takes up the rows where their bodies are, which the kernel has looked at: they are hinges'. Springs give what is
/// left of their impulse at once.
template <class V, int N>
void take_up_rows(const DeskShape& shape, const DeskLayout<V, N>& from, int lane, Mechanism& m) {
    for (std::size_t i = 0; i < shape.joints; ++i) {
        const JointShape& k = shape.joint[i];
        for (std::uint32_t r = 0; r < k.lines; ++r) {
            const DeskLine<V>& own = from.lines[k.line + r];
            JointRow& row = m.lines[shape.line_of[k.line + r]].last;
            row.error = lane_of(own.error, lane);
            if (r < 2) row.a[2] = lane_of(own.a[2], lane), row.b[2] = lane_of(own.b[2], lane);
        }
        if (shape.spring_of[i] == no_bound) continue;
        JointLine& spring = m.lines[shape.spring_of[i]];
        spring.last.error = m.parts[k.b].now.angle - m.parts[k.a].now.angle - m.members[i].rest;
        spring.after = m.is_projected ? 0 : spring.before, spring.step = Step::free;
    }
}
/// Twice the kinetic energy of a part, of its velocities before they were slowed down.
template <class VelocityOf>
double energy_of(const Mechanism::Part& p, VelocityOf velocity_of) {
    const double x = velocity_of(0), y = velocity_of(1), w = velocity_of(2);
    const double m = p.inverse_mass * p.slow[0] * p.slow[0], i = p.inverse_inertia * p.slow[1] * p.slow[1];
    return (m > 0 ? (x * x + y * y) / m : 0) + (i > 0 ? w * w / i : 0);
}
template <class VelocityOf>
double energy_of(const Mechanism& m, VelocityOf velocity_of) {
    double sum = 0;
    for (std::size_t p = 0; p < m.parts.size(); ++p)
        sum += energy_of(m.parts[p], [&](std::size_t i) { return velocity_of(p, i); });
    return sum;
}

inline DeskTask task_of(const Mechanism& m, const Asked& asked, bool begins) {
    const auto turn = [](double angle, double* cosine, double* sine) {
        const auto turned = portable::sincos(angle);
        *cosine = turned.cos, *sine = turned.sin;
    };
    return {asked.h,           asked.share,  m.is_projected, asked.drifts, asked.round == Round::last,
            asked.foresees(m), m.is_touched, begins,         turn};
}

/// Whether something outside moves it, or a motor does.
inline bool is_powered(const Mechanism& m) {
    const auto drives = [](const JointLine& l) {
        if (l.law->kind == Law::Kind::spring) return false;
        return is_of_speed(*l.law) ? l.first.error != 0 : l.law->speed != 0;
    };
    const auto is_moved = [](const Mechanism::Part& p) {
        return p.inverse_mass == 0 && (p.v[0] != 0 || p.v[1] != 0 || p.v[2] != 0);
    };
    return std::any_of(m.lines.begin(), m.lines.end(), drives) || std::any_of(m.parts.begin(), m.parts.end(), is_moved);
}
/// Twice what it may have without having moved: what its springs have stored where the substep begins, and the energy
/// of velocities that are rounding.
inline double at_hand(const Mechanism& m, double h) {
    const double hair = 1e3 * tiny * m.size / h;
    double sum = 2 * stored_in_springs(m);
    for (const Mechanism::Part& p : m.parts)
        if (p.inverse_mass > 0) sum += hair * hair / p.inverse_mass;
    return sum;
}
/// Bodies that were slowed down for a force that is no more get so much energy, and others as rows turn.
constexpr double most_made = 2;
/// Whether a solution is one that forces could have led to: a drift does not make much energy. `is_calm`: it is known
/// that it does not, if none of its parts is slowed down.
template <class V, int N>
bool is_sound(const Asked& asked, const DeskLayout<V, N>& on, int lane, Mechanism& m, bool is_calm = false) {
    if (!asked.drifts) return true;
    if (is_calm && !m.is_slow) {
        if (!asked.is_exact() || m.is_simple) return true;
        note_ends(on, lane, m);
        if (given_to_springs(m) <= 0) return true;
    }
    const double most =
        most_made * energy_of(m, [&](std::size_t p, std::size_t i) { return lane_of(on.parts[p].first_v[i], lane); });
    const double now = energy_of(m, [&](std::size_t p, std::size_t i) { return lane_of(on.parts[p].v[i], lane); });
    const auto has_source = [&] { return now <= most + most_made * at_hand(m, asked.h) || is_powered(m); };
    if (!(now <= most) && (m.is_slow || !has_source())) return false;
    if (!asked.is_exact() || m.is_simple) return true;
    note_ends(on, lane, m);
    const double given = given_to_springs(m);
    return given <= 0 || given <= most || is_powered(m);
}

/// Whether one whose rows are all rigid keeps them with what the substep before lets expect, if need be with one round
/// more: then it has that.
bool hold_as_foreseen(Mechanism&, const Asked&);
/// The solve of one that is alone. `is_tried`: there is no solution that begins with the steps as they are.
void hold_alone(Mechanism&, const Asked&, bool is_tried);
/// The solves of a half of one that is alone and touches something.
Desks::Solve hold_between_contacts(Mechanism&, const Asked&);

}  // namespace carom
