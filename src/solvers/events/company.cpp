#include "solvers/events/company.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "forces/gains.hpp"
#include "math/elementary.hpp"
#include "solvers/links.hpp"

namespace carom {

namespace {

Vec2 turned_back(double cosine, double sine, Vec2 p) { return {cosine * p.x + sine * p.y, cosine * p.y - sine * p.x}; }

}  // namespace

// ---- One body -------------------------------------------------------------------------------------------------------

void GasMover::move(double time) {
    const double t = time - clock;
    x += t * (v + 0.5 * t * a);
    v += t * a;
    clock = time;
    if (!turns()) return;
    angle += t * (w + 0.5 * t * alpha);
    w += t * alpha;
    face(angle);
}

void GasMover::face(double where) {
    const auto turn = portable::sincos(where);
    angle = where, cosine = turn.cos, sine = turn.sin;
}

GasFlight seen_from(const GasMover& m, const GasFlight& f) {
    const auto back = [&](Vec2 p) { return turned_back(m.cosine, m.sine, p); };
    return {back(f.x), back(f.v - cross(m.w, f.x)), back(f.g), f.radius};
}

Vec2 acceleration_seen_from(const GasMover& m, const GasFlight& f) {
    return f.g - cross(m.alpha, f.x) + m.w * m.w * f.x - 2 * cross(m.w, f.v - cross(m.w, f.x));
}

namespace {

/// The gap between a disc and a line that turns, how fast it grows, and how fast that does while the outline is as
/// straight as where it is nearest.
struct Gap {
    double size, rate, bend;
};
Gap gap_after(GasMover m, double after, const GasObstacle& o, const GasFlight& f, double t) {
    const double s = after + t;
    m.face(m.angle + s * (m.w + 0.5 * s * m.alpha));
    m.w += s * m.alpha;
    const GasFlight now{f.x + t * (f.v + 0.5 * t * f.g), f.v + t * f.g, f.g, f.radius};
    GasFlight seen = seen_from(m, now);
    seen.x -= o.a;
    const Vec2 normal = normal_at(o, seen), pull = acceleration_seen_from(m, now);
    return {gap_to(o, seen), dot(normal, seen.v), dot(normal, turned_back(m.cosine, m.sine, pull))};
}

/// For how long, of a time, what is no less than size + rate t + ½ bend t² - ⅙ jerk t³ is surely above zero: in a time
/// s the last part is no more than that of a parabola, ⅙ jerk s t². So each s tells of the time until it, and the more
/// the nearer it is to the root.
double safe_time(const Gap& gap, double jerk, double most) {
    const double size = std::max(gap.size, 0.0);
    const auto known = [&](double s) {
        const double bend = gap.bend - jerk * s / 3, inside = gap.rate * gap.rate - 2 * bend * size;
        if (inside < 0 || (gap.rate >= 0 && bend >= 0)) return s;
        const double root = std::sqrt(inside);
        return std::min(s, gap.rate < 0 ? 2 * size / (root - gap.rate) : -(gap.rate + root) / bend);
    };
    double safe = known(most);
    const double alike = 1.5 * std::abs(gap.bend);  // in so long, times the jerk, the bend stays what it is by half
    if (alike < jerk * most) safe = std::max(safe, known(alike / jerk));
    return std::max(safe, known(std::min(2 * safe, most)));
}

/// The outline is convex, and no nearer than the straight line along it where it is nearest now: the gap falls no
/// faster than that to the line, whose acceleration is known, and the greatest jerk of the disc, seen from the body,
/// make it. To go on for as long as that allows finds the instant of the hit at the third order, and never misses it. A
/// disc that rolls keeps its gap, and is not nearly as slow to look at as where its acceleration was only bounded.
double time_to_turning(const GasMover& m, double after, const GasObstacle& o, const GasFlight& f, double most) {
    const double g = length(f.g), speed = length(f.v) + most * g, farthest = length(f.x) + most * speed;
    const double alpha = std::abs(m.alpha), w = std::abs(m.w + after * m.alpha) + most * alpha;
    const double jerk = 3 * alpha * (speed + w * farthest) + w * (3 * g + w * (3 * speed + w * farthest));
    const double touching = 1e-14 * (farthest + m.reach);
    constexpr int rounds = 1000;
    double t = 0;
    for (int k = 0; k < rounds && t <= most; ++k) {
        const Gap gap = gap_after(m, after, o, f, t);
        if (gap.size <= touching && gap.rate < 0) return t;
        if (t == most) break;  // which may be no time at all
        t += std::max(safe_time(gap, jerk, most), 1e-15 * most);
    }
    return gas_never;
}

}  // namespace

bool may_strike(const GasMover& m, const GasFlight& f, double most, double faster) {
    const auto at_most = [](Vec2 p) { return std::abs(p.x) + std::abs(p.y); };
    const double near = m.reach + f.radius + most * (at_most(f.v) + faster + 0.5 * most * at_most(f.g));
    if (m.turns()) return squared_length(f.x) <= near * near * (1 + 1e-9);
    const double beyond = near - m.reach;
    const Vec2 x = turned_back(m.cosine, m.sine, f.x);
    return std::abs(x.x) <= (m.half.x + beyond) * (1 + 1e-9) && std::abs(x.y) <= (m.half.y + beyond) * (1 + 1e-9);
}

double time_to(const GasMover& m, double after, const GasObstacle& o, const GasFlight& f, double most) {
    if (m.turns() && !(o.a == o.b && o.a == Vec2{})) return time_to_turning(m, after, o, f, most);
    const auto back = [&](Vec2 p) { return turned_back(m.cosine, m.sine, p); };
    const double t = time_to(o, {back(f.x) - o.a, back(f.v), back(f.g), f.radius});
    return t <= most ? t : gas_never;
}

// ---- All of them ----------------------------------------------------------------------------------------------------

GasCompany::GasCompany(const std::vector<bool>& stepped, const Bodies& bodies, const std::vector<Piece>& pieces) {
    of_row_.assign(stepped.size(), GasMover::none);
    for (std::uint32_t row = 0; row < stepped.size(); ++row) {
        if (!stepped[row]) continue;
        of_row_[row] = static_cast<std::uint32_t>(mover.size());
        mover.push_back({.row = row,
                         .mass = bodies.mass[row],
                         .inertia = bodies.inertia[row],
                         .inverse_mass = bodies.inverse_mass[row],
                         .inverse_inertia = bodies.inverse_inertia[row]});
    }
    for (const Piece& piece : pieces) {
        if (!stepped[piece.row]) continue;
        GasMover& m = mover[of_row_[piece.row]];
        for (int k = 0; k < piece.outline.count; ++k) {
            const Vec2 corner = piece.outline.corner[k];
            const double r = piece.outline.radius;
            m.reach = std::max(m.reach, length(corner) + r);
            m.half = {std::max(m.half.x, std::abs(corner.x) + r), std::max(m.half.y, std::abs(corner.y) + r)};
        }
    }
    if (mover.empty()) of_row_.clear();
}

/// The rigid rows of the joints, which an impulse finds as the step began: springs and motors give way to it, and
/// limits that it does not press.
void GasCompany::link(const Mechanisms& mechanisms, const State& state) {
    mechanisms_ = &mechanisms;
    linked_ = mechanisms.all;
    for (GasMover& m : mover) m.mechanism = GasMover::none;
    for (std::uint32_t k = 0; k < linked_.size(); ++k) {
        Mechanism& m = linked_[k];
        keep_rigid_rows(m);
        for (std::uint32_t i = 0; i < m.parts.size(); ++i) {
            Mechanism::Part& p = m.parts[i];
            p.now = {};
            if (p.row >= of_row_.size()) continue;  // the ground
            if (const std::uint32_t own = of_row(p.row); own != GasMover::none) {
                mover[own].mechanism = k, mover[own].part = i;
                continue;
            }
            const auto turn = portable::sincos(state.x.angular[p.row]);
            p.now = {state.x.linear[p.row], turn.cos, turn.sin, state.x.angular[p.row]};
        }
    }
}

/// Between kinks each is on a parabola.
void GasCompany::set_out(const State& start, const State& end, const Mechanisms& mechanisms, GasWays ways) {
    link(mechanisms, start);
    ways_ = std::move(ways);
    const double h = ways_.h;
    for (GasMover& m : mover) {
        const std::uint32_t row = m.row;
        m.v = end.x.linear[row] - start.x.linear[row], m.a = end.v.linear[row] - start.v.linear[row];
        m.w = end.x.angular[row] - start.x.angular[row], m.alpha = end.v.angular[row] - start.v.angular[row];
        m.kinks = 0;
    }
    for (const GasKink& k : ways_.kinks) {
        GasMover& m = mover[k.mover];
        m.v -= (h - k.time) * k.v, m.w -= (h - k.time) * k.w;
        m.a -= k.v, m.alpha -= k.w;
        ++m.kinks;
    }
    for (GasMover& m : mover) {
        m.x = start.x.linear[m.row], m.face(start.x.angular[m.row]);
        m.v = m.v / h - 0.5 * m.a, m.w = m.w / h - 0.5 * m.alpha;
        m.a = m.a / h, m.alpha = m.alpha / h;
        m.begin_hits();
    }
    list_touches();
    next_ = 0;
    stopped = false;
}

/// Body by body.
void GasCompany::list_touches() {
    auto& touches = ways_.touches;
    std::stable_sort(touches.begin(), touches.end(),
                     [](const GasTouch& a, const GasTouch& b) { return a.mover < b.mover; });
    std::uint32_t next = 0;
    for (std::uint32_t k = 0; k < mover.size(); ++k) {
        mover[k].first_touch = next;
        while (next < touches.size() && touches[next].mover == k) ++next;
        mover[k].last_touch = next;
    }
}

void GasCompany::set_clock(double from, double end) {
    begin_ = from + ways_.ahead, until = end;
    for (GasMover& m : mover) m.clock = begin_;
    for (GasKink& k : ways_.kinks) k.time = std::clamp(begin_ + k.time, from, end);
}

void GasCompany::set_back(double by) {
    until -= by, begin_ -= by;
    for (GasMover& m : mover) m.clock -= by;
    for (GasKink& k : ways_.kinks) k.time -= by;
}

void GasCompany::kink() {
    for (const double time = smooth_until(); has_kinks() && smooth_until() <= time; ++next_) {
        const GasKink& k = ways_.kinks[next_];
        GasMover& m = mover[k.mover];
        m.move(time);
        m.v += k.v, m.w += k.w, m.kick += k.v;
        --m.kinks;
    }
}

void GasCompany::arrive(const Dynamics& dynamics, State& state, double moved) {
    Gains gains(dynamics);
    Flows& account = state.account;
    const double early = ways_.h - moved;
    for (GasMover& m : mover) {
        Vec2 &x = state.x.linear[m.row], &v = state.v.linear[m.row];
        double &angle = state.x.angular[m.row], &w = state.v.angular[m.row];
        if (m.hit) {
            const Vec2 pushed = m.pushed - early * m.gained;
            gains.add(m.row, x, v, w, pushed, m.gained, m.gained_spin);
            account[Giver::method].add(-m.given.force, -m.given.torque);
            x += pushed, v += m.gained, angle += m.pushed_turn - early * m.gained_spin, w += m.gained_spin;
        }
        m.planned = m.v + (until - m.clock) * m.a, m.planned_spin = m.w + (until - m.clock) * m.alpha;
        m.x = x, m.v = v, m.face(angle), m.w = w, m.clock = until;
        m.begin_hits();
    }
    gains.book(account);
    ways_.h = moved;
}

/// What differs by more has bounced or landed meanwhile.
void GasCompany::be_as_planned() {
    for (GasMover& m : mover)
        if (length(m.planned - m.v) + m.reach * std::abs(m.planned_spin - m.w) <= slow_for(m))
            m.v = m.planned, m.w = m.planned_spin;
}

void GasCompany::rest() {
    mechanisms_ = nullptr;
    until = gas_never;
}

void GasCompany::find_yields(std::uint32_t struck, double time, Vec2 lever, Vec2 direction,
                             std::vector<GasYield>& yields) {
    yields.clear();
    GasMover& self = mover[struck];
    self.move(time);
    const double torque = cross(lever, direction);
    if (self.mechanism == GasMover::none) {
        yields.push_back({struck, self.inverse_mass * direction, self.inverse_inertia * torque});
        return;
    }
    Mechanism& m = linked_[self.mechanism];
    for (Mechanism::Part& p : m.parts) {
        p.given[0] = p.given[1] = p.given[2] = 0;
        const std::uint32_t own = of_row(p.row);
        if (own == GasMover::none) continue;
        GasMover& body = mover[own];
        body.move(time);
        p.now = {body.x, body.cosine, body.sine, body.angle};
    }
    Mechanism::Part& part = m.parts[self.part];
    part.given[0] = direction.x, part.given[1] = direction.y, part.given[2] = torque;
    pass_on(m, mechanisms_->joints, true);
    const auto add = [&](const Mechanism::Part& p) {
        const std::uint32_t own = of_row(p.row);
        if (own != GasMover::none) yields.push_back({own, {p.v[0], p.v[1]}, p.v[2]});
    };
    add(part);
    for (const Mechanism::Part& p : m.parts)
        if (&p != &part) add(p);
}

bool GasCompany::hold_stops(std::uint32_t struck, double push) {
    if (mover[struck].mechanism == GasMover::none) return false;
    Mechanism& m = linked_[mover[struck].mechanism];
    const auto before = [&](std::uint32_t part) {
        const std::uint32_t own = of_row(m.parts[part].row);
        return own == GasMover::none ? Twist{} : Twist{mover[own].v, mover[own].w};
    };
    return carom::hold_stops(m, push, before);
}

void GasCompany::let_stops_go(std::uint32_t struck) { keep_rigid_rows(linked_[mover[struck].mechanism]); }

}  // namespace carom
