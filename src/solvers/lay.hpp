#pragma once
// How a mechanism is laid on the desk for its solve (solvers/desk_rows.hpp), and taken up again.

#include <bit>

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

    /// In how many substeps up to now it had to be projected.
    std::uint32_t projections(const Mechanism& m) const { return all.memory[m.members[0].joint].projections; }
    /// Whether it is projected at once: what has just failed is tried again after twice as many substeps.
    bool tries_nothing(const Mechanism& m) const {
        return is_exact() && projections(m) > 0 && !std::has_single_bit(projections(m));
    }
};

/// What a row that is not rigid is to be at.
inline DeskBound<double> wanted(const Mechanism& m, const Asked& asked, const JointLine& line, double size) {
    const Law& law = *line.law;
    const double h = asked.h;
    DeskBound<double> w{0, 0, -HUGE_VAL, HUGE_VAL, 0, 0, 0, law.most, tiny * size / h};
    const double error = line.first.error, at = line.last.error;
    if (law.kind == Law::Kind::spring) {
        const double part = m.is_projected ? 1 : 0.5;
        const double stiffness = part * h * law.stiffness + law.damping;
        w.softness = 1 / (part * h * stiffness), w.speed = -law.stiffness * error / stiffness;
        w.most = part * h * law.most, w.least = -w.most;
    } else {
        if (asked.drifts) {
            w.low = std::min(0.0, (law.lower - error) / h), w.high = std::max(0.0, (law.upper - error) / h);
        } else {
            if (at <= law.lower + 1e3 * tiny * size) w.low = 0;
            if (at >= law.upper - 1e3 * tiny * size) w.high = 0;
        }
        w.speed = std::clamp(is_of_speed(law) ? error : law.speed, w.low, w.high);
        const double whole = h * law.most, first = asked.share * whole, most = asked.drifts ? first : whole;
        // Where no drift was found a motor may have given more: that is not taken back at once.
        const double so_far = asked.drifts ? 0 : std::clamp(line.before, -first, first);
        w.most = most - so_far, w.least = -most - so_far;
    }
    w.push = w.most;
    return w;
}
/// The impulse with which one of two rows that have one bound is pushed: against the slip, and after the drift as
/// before it; of a spring as it pulls.
inline double push_of_pair(const Mechanism& m, const BoundShape& b, const Asked& asked, double size) {
    const Member& k = m.members[b.joint];
    const JointLine* const lines = &m.lines[k.line];
    double along[2], middle = 0, most = 0;
    for (std::uint32_t r = 0; r < 2; ++r) {
        const DeskBound<double> w = wanted(m, asked, lines[r], size);
        const bool goes_on = !b.is_spring && !asked.drifts && (lines[0].before != 0 || lines[1].before != 0);
        along[r] = goes_on ? lines[r].before : w.speed - speed(m, k, r, lines[r].*asked.which());
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
            carve(new_diagonal, blocks * s.joints), carve(new_below, blocks * s.blocks);
            carve(scaled, blocks * most_below), carve(factored, blocks);
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

    DeskMemory memory() const {
        return {parts, anchors, lines, bounds, unknowns, diagonal, below, new_diagonal, new_below, scaled, factored};
    }

    DeskPart<V>* parts;
    DeskAnchors<V>* anchors;
    DeskLine<V>* lines;
    DeskBound<V>* bounds;
    V* unknowns;
    BlockOf<V, N>*diagonal, *below, *new_diagonal, *new_below, *scaled;
    unsigned* factored;

  private:
    std::uintptr_t bytes_ = 0;
    std::size_t size_;
    void* taken_;
};

template <class V>
void lay_part(const Mechanism::Part& p, int lane, DeskPart<V>& to) {
    for (int i = 0; i < 3; ++i) {
        lane_of(to.v[i], lane) = p.v[i], lane_of(to.given[i], lane) = p.given[i];
        lane_of(to.ease[i], lane) = p.ease[i];
    }
}
/// Where the substep began, for solves that look where it ends.
template <class V>
void lay_start(const Mechanism::Part& p, int lane, DeskPart<V>& to) {
    lane_of(to.x, lane) = p.start.position.x, lane_of(to.y, lane) = p.start.position.y;
    lane_of(to.cosine, lane) = p.start.cosine, lane_of(to.sine, lane) = p.start.sine;
    lane_of(to.angle, lane) = p.start.angle;
}
template <class V>
void lay_anchors(const Member& k, int lane, DeskAnchors<V>& to) {
    lane_of(to.a[0], lane) = k.anchor_a.x, lane_of(to.a[1], lane) = k.anchor_a.y;
    lane_of(to.b[0], lane) = k.anchor_b.x, lane_of(to.b[1], lane) = k.anchor_b.y;
    lane_of(to.rest, lane) = k.rest;
}
template <class V>
void lay_line(const Member& k, std::uint32_t row, const JointLine& line, const Asked& asked, int lane,
              DeskLine<V>& to) {
    const JointRow& j = line.*asked.which();
    if (!k.is_hinge)
        for (int d = 0; d < 3; ++d) lane_of(to.a[d], lane) = j.a[d], lane_of(to.b[d], lane) = j.b[d];
    else if (row < 2)
        lane_of(to.a[2], lane) = j.a[2], lane_of(to.b[2], lane) = j.b[2];
    lane_of(to.per_size, lane) = per_size_of(k, row, line);
    lane_of(to.impulse, lane) = line.*asked.impulse();
    if (asked.drifts) lane_of(to.first_error, lane) = line.first.error, lane_of(to.aim, lane) = line.aim;
}
template <class V>
void lay_bound(const Mechanism& m, const BoundShape& b, const Asked& asked, int lane, DeskBound<V>& to) {
    const JointLine& line = m.lines[b.line];
    const double size = size_of(m.members[b.joint], line);
    DeskBound<double> w = wanted(m, asked, line, size);
    if (b.is_paired) w.push = push_of_pair(m, b, asked, size);
    lane_of(to.speed, lane) = w.speed, lane_of(to.softness, lane) = w.softness;
    lane_of(to.low, lane) = w.low, lane_of(to.high, lane) = w.high;
    lane_of(to.least, lane) = w.least, lane_of(to.most, lane) = w.most;
    lane_of(to.push, lane) = w.push;
    lane_of(to.motor, lane) = w.motor, lane_of(to.hair, lane) = w.hair;
}
template <int N>
void lay_bounds(const Mechanism& m, const Asked& asked, DeskLayout<double, N>& to) {
    for (std::size_t i = 0; i < m.shape->bounds.size(); ++i) lay_bound(m, m.shape->bounds[i], asked, 0, to.bounds[i]);
}
/// Lays mechanisms that are alike side by side; `of` says which one a lane has.
template <class V, int N, class Of>
void lay(Of of, int lanes, const Asked& asked, DeskLayout<V, N>& to) {
    const Mechanism& one = of(0);
    const auto each = [&](std::size_t count, auto act) {
        for (std::size_t i = 0; i < count; ++i)
            for (int lane = 0; lane < lanes; ++lane) act(of(lane), i, lane);
    };
    each(one.parts.size(),
         [&](const Mechanism& m, std::size_t i, int lane) { lay_part(m.parts[i], lane, to.parts[i]); });
    for (std::size_t i = 0; i < one.members.size(); ++i)
        for (int lane = 0; lane < lanes; ++lane) {
            const Mechanism& m = of(lane);
            const Member& k = m.members[i];
            const bool foresees = asked.foresees(m);
            for (std::uint32_t r = 0; r < k.lines; ++r) {
                const JointLine& line = m.lines[k.line + r];
                DeskLine<V>& l = to.lines[k.line + r];
                lay_line(k, r, line, asked, lane, l);
                if (!foresees) continue;
                const bool stops = !k.joins_points(r) && line.law->kind == Law::Kind::stop && !m.is_touched;
                lane_of(l.expected, lane) = stops ? 0 : asked.expected(line);
            }
        }
    each(one.shape->bounds.size(), [&](const Mechanism& m, std::size_t i, int lane) {
        const BoundShape& b = m.shape->bounds[i];
        lane_of(to.lines[b.line].step, lane) = number_of(m.lines[b.line].step);
        lay_bound(m, b, asked, lane, to.bounds[i]);
    });
}

/// What a solve needs besides that looks where the drift ends.
template <class V, int N, class Of>
void lay_ahead(Of of, int lanes, DeskLayout<V, N>& to) {
    const Mechanism& one = of(0);
    for (std::size_t p = 0; p < one.parts.size(); ++p)
        for (int lane = 0; lane < lanes; ++lane) lay_start(of(lane).parts[p], lane, to.parts[p]);
    for (std::size_t i = 0; i < one.members.size(); ++i)
        for (int lane = 0; lane < lanes; ++lane) lay_anchors(of(lane).members[i], lane, to.anchors[i]);
}

/// The gaps of springs where the drift ends.
template <class V, int N>
void note_ends(const DeskLayout<V, N>& from, int lane, Mechanism& m) {
    for (const BoundShape& b : m.shape->bounds)
        if (b.is_spring) m.lines[b.line].last.error = lane_of(from.lines[b.line].last_error, lane);
}
/// Takes mechanisms up as the solve left them, or as it found them: those in the lanes that are wanted.
template <bool as_found = false, class V, int N, class Of>
void take_up(const DeskLayout<V, N>& from, const Asked& asked, int lanes, unsigned wanted, Of of) {
    const Mechanism& one = of(0);
    for (std::size_t p = 0; p < one.parts.size(); ++p)
        for (int lane = 0; lane < lanes; ++lane) {
            if ((wanted >> lane & 1U) == 0) continue;
            Mechanism::Part& part = of(lane).parts[p];
            for (int i = 0; i < 3; ++i) {
                const DeskPart<V>& own = from.parts[p];
                part.v[i] = lane_of(as_found ? own.first_v[i] : own.v[i], lane);
                part.given[i] = part.known[i] = lane_of(as_found ? own.first_given[i] : own.given[i], lane);
            }
        }
    for (std::size_t i = 0; i < one.lines.size(); ++i)
        for (int lane = 0; lane < lanes; ++lane) {
            if ((wanted >> lane & 1U) == 0) continue;
            const DeskLine<V>& own = from.lines[i];
            of(lane).lines[i].*asked.impulse() = lane_of(as_found ? own.first_impulse : own.impulse, lane);
        }
    for (const BoundShape& b : one.shape->bounds)
        for (int lane = 0; lane < lanes; ++lane)
            if ((wanted >> lane & 1U) != 0) {
                const DeskLine<V>& own = from.lines[b.line];
                of(lane).lines[b.line].step = static_cast<Step>(lane_of(as_found ? own.first_step : own.step, lane));
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
    return {asked.h, asked.drifts, asked.round == Round::last, asked.foresees(m), m.is_touched, begins, turn};
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
/// Whether a solution is one that forces could have led to: a drift does not make much energy.
template <class V, int N>
bool is_sound(const Asked& asked, const DeskLayout<V, N>& on, int lane, Mechanism& m) {
    if (!asked.drifts) return true;
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
