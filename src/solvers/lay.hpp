#pragma once
// How a mechanism is laid on the desk for its solve (solvers/desk_rows.hpp), and taken up again.

#include "solvers/factor.hpp"

namespace carom {

/// So many doubles side by side: what lanes are to those that do not compute with them.
template <int L>
struct alignas(8 * L) Many {
    double at[L];
};
inline double& lane_of(double& a, int) { return a; }
template <int L>
double& lane_of(Many<L>& a, int lane) {
    return a.at[lane];
}

/// A solve as it is asked for.
struct Asked {
    const Mechanisms& all;
    double h, share;
    bool drifts, exact;

    JointRow Line::*which() const { return drifts ? &Line::first : &Line::last; }
    double Line::*impulse() const { return drifts ? &Line::before : &Line::after; }
};

/// What a row that is not rigid is to be at.
inline DeskBound<double> wanted(const Mechanism& m, const Asked& asked, const Line& line, double size) {
    const Law& law = line.law;
    const double h = asked.h;
    DeskBound<double> w{0, 0, -HUGE_VAL, HUGE_VAL, 0, 0, law.most, tiny * size / h};
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
        w.speed = std::clamp(law.straight ? error : law.speed, w.low, w.high);
        const double so_far = asked.drifts ? 0 : line.before, most = (asked.drifts ? asked.share : 1) * h * law.most;
        w.most = most - so_far, w.least = -most - so_far;
    }
    return w;
}

/// Memory in which mechanisms of a shape lie side by side.
template <class V, int N>
class Layout {
  public:
    explicit Layout(const DeskShape& s, std::size_t most_below, bool has_matrix) {
        const std::size_t blocks = has_matrix ? 1 : 0;
        const auto carve = [this]<class T>(T*& to, std::size_t count) {
            to = reinterpret_cast<T*>(bytes_);  // an offset until there is memory
            bytes_ += count * sizeof(T);
        };
        const auto carve_all = [&] {
            carve(parts, s.parts), carve(anchors, s.joints), carve(lines, s.lines), carve(bounds, s.bounds);
            carve(unknowns, N * s.joints), carve(diagonal, blocks * s.joints), carve(below, blocks * s.blocks);
            carve(new_diagonal, blocks * s.joints), carve(new_below, blocks * s.blocks);
            carve(scaled, blocks * most_below);
        };
        carve_all();
        size_ = bytes_ + alignof(V);
        taken_ = take_scratch(size_);
        const auto address = reinterpret_cast<std::uintptr_t>(taken_);
        bytes_ = (address + alignof(V) - 1) / alignof(V) * alignof(V);
        carve_all();
    }
    Layout(const Layout&) = delete;
    Layout& operator=(const Layout&) = delete;
    ~Layout() { give_back_scratch(taken_, size_); }

    DeskMemory memory() const {
        return {parts, anchors, lines, bounds, unknowns, diagonal, below, new_diagonal, new_below, scaled};
    }

    DeskPart<V>* parts;
    DeskAnchors<V>* anchors;
    DeskLine<V>* lines;
    DeskBound<V>* bounds;
    V* unknowns;
    BlockOf<V, N>*diagonal, *below, *new_diagonal, *new_below, *scaled;

  private:
    std::uintptr_t bytes_ = 0;
    std::size_t size_;
    void* taken_;
};

/// Lays a mechanism down in a lane.
template <class V, int N>
void lay_bounds(const Mechanism& m, const Asked& asked, int lane, Layout<V, N>& to) {
    for (std::size_t i = 0; i < m.shape.bounds.size(); ++i) {
        const BoundShape& b = m.shape.bounds[i];
        const Line& line = m.lines[b.line];
        const DeskBound<double> w = wanted(m, asked, line, size_of(m.members[b.joint], line));
        DeskBound<V>& bound = to.bounds[i];
        lane_of(bound.speed, lane) = w.speed, lane_of(bound.softness, lane) = w.softness;
        lane_of(bound.low, lane) = w.low, lane_of(bound.high, lane) = w.high;
        lane_of(bound.least, lane) = w.least, lane_of(bound.most, lane) = w.most;
        lane_of(bound.motor, lane) = w.motor, lane_of(bound.hair, lane) = w.hair;
    }
}
template <class V, int N>
void lay_part(const Mechanism::Part& p, int lane, DeskPart<V>& to) {
    for (int i = 0; i < 3; ++i) {
        lane_of(to.v[i], lane) = lane_of(to.first_v[i], lane) = p.v[i];
        lane_of(to.given[i], lane) = lane_of(to.first_given[i], lane) = p.given[i];
        lane_of(to.known[i], lane) = p.known[i], lane_of(to.ease[i], lane) = p.ease[i];
    }
    lane_of(to.x, lane) = p.start.position.x, lane_of(to.y, lane) = p.start.position.y;
    lane_of(to.cosine, lane) = p.start.cosine, lane_of(to.sine, lane) = p.start.sine;
    lane_of(to.angle, lane) = p.start.angle;
}
template <class V, int N>
void lay(const Mechanism& m, const Asked& asked, int lane, Layout<V, N>& to) {
    for (std::size_t p = 0; p < m.parts.size(); ++p) lay_part<V, N>(m.parts[p], lane, to.parts[p]);
    const JointRow Line::*which = asked.which();
    const double Line::*impulse = asked.impulse();
    for (std::size_t i = 0; i < m.members.size(); ++i) {
        const Member& k = m.members[i];
        DeskAnchors<V>& at = to.anchors[i];
        lane_of(at.a[0], lane) = k.anchor_a.x, lane_of(at.a[1], lane) = k.anchor_a.y;
        lane_of(at.b[0], lane) = k.anchor_b.x, lane_of(at.b[1], lane) = k.anchor_b.y;
        lane_of(at.rest, lane) = k.rest;
        const JointMemory& memory = asked.all.memory[k.joint];
        for (std::uint32_t r = 0; r < k.lines; ++r) {
            const Line& line = m.lines[k.line + r];
            const JointRow& row = line.*which;
            DeskLine<V>& l = to.lines[k.line + r];
            for (int d = 0; d < 3; ++d) lane_of(l.a[d], lane) = row.a[d], lane_of(l.b[d], lane) = row.b[d];
            lane_of(l.first_error, lane) = line.first.error, lane_of(l.last_error, lane) = line.last.error;
            lane_of(l.aim, lane) = line.aim, lane_of(l.per_size, lane) = line.law.turns ? 1 : k.per_size;
            lane_of(l.impulse, lane) = lane_of(l.first_impulse, lane) = line.*impulse;
            lane_of(l.expected, lane) = line.law.kind == Law::Kind::stop ? 0 : asked.h * memory.half[r];
            lane_of(l.step, lane) = lane_of(l.first_step, lane) = number_of(line.step);
        }
    }
    lay_bounds(m, asked, lane, to);
}

/// Where the drift ends.
template <class V, int N>
void note_ends(const Layout<V, N>& from, int lane, Mechanism& m) {
    for (std::size_t i = 0; i < m.lines.size(); ++i) m.lines[i].last.error = lane_of(from.lines[i].last_error, lane);
}
/// Takes a mechanism up as the solve left it.
template <class V, int N>
void take_up(const Layout<V, N>& from, int lane, double Line::*impulse, Mechanism& m) {
    for (std::size_t p = 0; p < m.parts.size(); ++p)
        for (int i = 0; i < 3; ++i) {
            m.parts[p].v[i] = lane_of(from.parts[p].v[i], lane);
            m.parts[p].given[i] = lane_of(from.parts[p].given[i], lane);
            m.parts[p].known[i] = lane_of(from.parts[p].known[i], lane);
        }
    for (std::size_t i = 0; i < m.lines.size(); ++i) {
        m.lines[i].*impulse = lane_of(from.lines[i].impulse, lane);
        m.lines[i].step = static_cast<Step>(lane_of(from.lines[i].step, lane));
    }
}
/// Twice the kinetic energy, of the velocities before they were slowed down.
template <class V, int N>
double energy_of(const Mechanism& m, const Layout<V, N>& from, int lane) {
    double sum = 0;
    for (std::size_t p = 0; p < m.parts.size(); ++p)
        for (std::size_t i = 0; i < 3; ++i) {
            const Mechanism::Part& part = m.parts[p];
            const double inverse = i < 2 ? part.inverse_mass : part.inverse_inertia,
                         v = lane_of(from.parts[p].v[i], lane) / part.slow[i / 2];
            if (inverse > 0) sum += v * v / inverse;
        }
    return sum;
}

}  // namespace carom
