#pragma once
// The second half of GasRun: what will be.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "solvers/events/run.hpp"

namespace carom {

template <class Queue>
void GasRun<Queue>::foresee(Slot i) {
    GasMeeting next{gas_never, no_slot};
    look_around(i, next);
    look_for_obstacles(i, next);
    settle(i, next);
    if (scene_.company) note_near(i);
}

template <class Queue>
inline void GasRun<Queue>::settle(Slot i, const GasMeeting& next) {
    GasDisc& d = discs_.disc[i];
    GasEvent& event = discs_.event[i];
    d.partner = next.partner;
    event.hit = next.time;
    if (edge_) edge_->changed[i] = true;
    if (next.partner < first_obstacle) event.partner_hits = discs_.disc[next.partner].hits;
    part_.queue.change(discs_.event, i, std::min(next.time, exit_of(d).time));
}

template <class Queue>
void GasRun<Queue>::take_if_sooner(double time, std::uint32_t partner, GasMeeting& next) const {
    if (time > next.time || time == gas_never) return;
    if (time == next.time) {  // discs before obstacles, in the order of their rows
        if (next.partner == partner) return;
        if (partner >= first_obstacle && partner > next.partner) return;
        if (partner < first_obstacle && next.partner < first_obstacle &&
            discs_.event[partner].row > discs_.event[next.partner].row)
            return;
    }
    next = {time, partner};
}

/// All cells around, and its own.
template <class Queue>
void GasRun<Queue>::look_around(Slot i, GasMeeting& next) const {
    look_into([](std::size_t k) { return k; }, std::make_index_sequence<cells_around>(), i, next);
}

/// The three cells ahead of one that the disc came into.
template <class Queue>
void GasRun<Queue>::look_ahead(Slot i, const Exit& exit, GasMeeting& next) const {
    const std::size_t first = exit.x > 0 ? 2 : exit.y > 0 ? 6 : 0, step = exit.x != 0 ? 3 : 1;
    look_into([=](std::size_t k) { return first + k * step; }, std::make_index_sequence<3>(), i, next);
}

/// The discs of these cells, without a branch as long as no cell has many: how many a cell has is not to be guessed.
template <class Queue>
template <class CellOf, std::size_t... which>
void GasRun<Queue>::look_into(CellOf cell_of, std::index_sequence<which...>, Slot i, GasMeeting& next) const {
    GasCells::Rim rim;
    const GasCells::Around around = part_.cells.around(discs_.disc[i].cell, rim);
    GasOthers others;
    std::size_t count = 0;
    std::uint32_t counts = 0;
    const auto take = [&](std::size_t k) {
        const GasCrowd& here = around.at(k);
        std::memcpy(others.slot + count, &here, sizeof here);
        std::memset(others.cell + count, static_cast<int>(k), sizeof here / sizeof(Slot));
        count += std::min(here.count, GasCrowd::at_hand);
        counts |= here.count;
    };
    (take(cell_of(which)), ...);
    const auto take_rest = [&](std::size_t k) {
        if (around.at(k).count <= GasCrowd::at_hand) return;
        for (Slot j = discs_.disc[around.at(k).slot.back()].next_in_cell; j != no_slot;
             j = discs_.disc[j].next_in_cell) {
            if (count == GasOthers::most) {
                others.count = count;
                look_at(others, i, next);
                count = 0;
            }
            others.slot[count] = j;
            others.cell[count++] = static_cast<std::uint8_t>(k);
        }
    };
    if (counts > GasCrowd::at_hand) (take_rest(cell_of(which)), ...);
    others.count = count;
    look_at(others, i, next);
}

template <class Queue>
void GasRun<Queue>::look_at(GasOthers& others, Slot i, GasMeeting& next) const {
    std::fill_n(others.slot + others.count, 8, none_);
    std::memset(others.cell + others.count, 0, 8);
    const GasSoonest soonest = kernel_.soonest(view_, i, others, &offset_[0].x);
    if (soonest.time > next.time || soonest.time == gas_never) return;
    if (gas_.grid.rim == GasGrid::Rim::open) {
        for (std::size_t k = 0; k < others.count; ++k)
            if (others.time[k] <= next.time && gas_.grid.is_near(discs_.disc[i], discs_.disc[others.slot[k]]))
                take_if_sooner(others.time[k], others.slot[k], next);
        return;
    }
    for (std::uint64_t which = soonest.which; which != 0; which &= which - 1)
        take_if_sooner(soonest.time, others.slot[static_cast<std::size_t>(__builtin_ctzll(which))], next);
}

/// When a disc meets another whose cell is that far away, or never: with the kernel's bits.
template <class Queue>
double GasRun<Queue>::time_to_meet(Slot i, Slot j, Vec2 offset) const {
    const GasDisc &a = discs_.disc[i], &other = discs_.disc[j];
    const double from = std::max(other.clock, a.clock), reach = radius(i) + radius(j);
    const double t = from - other.clock, s = from - a.clock;
    Vec2 d, u;
    if (falls_) {
        d = (other.x + t * (other.v + 0.5 * t * g_)) - (a.x + s * (a.v + 0.5 * s * g_));
        u = (other.v + t * g_) - (a.v + s * g_);
    } else {
        d = (other.x + t * other.v) - (a.x + s * a.v);
        u = other.v - a.v;
    }
    d = offset + d;
    const double b = dot(d, u), c = dot(d, d) - reach * reach, inside = b * b - dot(u, u) * c;
    if (b >= 0 || (inside < 0 && c > 0)) return gas_never;
    return c <= 0 ? from : from + c / (std::sqrt(inside) - b);
}

/// How two meet that were foreseen to do so now. Where their cells have more than one way to one another it is the
/// image that is at hand now: places at two clocks do not tell, nor flights of two that graze, for by rounding these
/// may not meet any more.
template <class Queue>
auto GasRun<Queue>::as_foreseen_now(Slot i, Slot j) const -> Meeting {
    const GasDisc &a = discs_.disc[i], &b = discs_.disc[j];
    Vec2 offset = gas_.grid.between(a, b);
    if (gas_.grid.has_twins()) {
        const auto place = [this](const GasDisc& d) { return d.x + (now_ - d.clock) * d.v; };
        const Vec2 within = place(b) - place(a);
        const auto off_touch = [&](Vec2 to) { return std::abs(length(to + within) - radius(i) - radius(j)); };
        for (std::size_t k = 0; k < cells_around; ++k)
            if (gas_.grid.around(a.cell, column_around(k), row_around(k)) == b.cell &&
                off_touch(offset_[k]) < off_touch(offset))
                offset = offset_[k];
    }
    return {as_foreseen_now(now_, time_to_meet(i, j, offset)), offset};
}

template <class Queue>
GasFlight GasRun<Queue>::flight(Slot i, const GasObstacle& o) const {
    const GasDisc& d = discs_.disc[i];
    return {gas_.grid.middle(d) + d.x - (o.a + (d.clock - o.clock) * o.v), d.v - o.v, g_, radius(i)};
}

template <class Queue>
GasFlight GasRun<Queue>::flight(Slot i, const GasNear& near) const {
    GasDisc d = discs_.disc[i];
    d.turns_x = near.turns_x, d.turns_y = near.turns_y;
    return {gas_.grid.middle(d) + d.x - gas_.obstacle[near.obstacle].a, d.v, g_, radius(i)};
}

/// From a body of the company, as both are at a time.
template <class Queue>
GasFlight GasRun<Queue>::flight(Slot i, const GasMover& m, double time) const {
    const GasDisc& d = discs_.disc[i];
    const double s = time - d.clock, t = time - m.clock;
    const Vec2 x = gas_.grid.middle(d) + d.x + s * (d.v + 0.5 * s * g_);
    return {x - (m.x + t * (m.v + 0.5 * t * m.a)), (d.v + s * g_) - (m.v + t * m.a), g_ - m.a, radius(i)};
}

/// Where the company goes is known to the end of its step alone.
template <class Queue>
void GasRun<Queue>::look_for_movers(Slot i, GasMeeting& next) const {
    const GasCompany& company = *scene_.company;
    if (company.until == gas_never) return;
    std::uint32_t seen = GasMover::none;
    bool near = false;
    double from = 0, most = 0;
    GasFlight f;
    for (const std::uint32_t k : company.outline) {
        const GasObstacle& o = gas_.obstacle[k];
        const GasMover& m = company.mover[o.mover];
        if (o.mover != seen) {
            seen = o.mover;
            from = std::max(discs_.disc[i].clock, m.clock), most = company.until - from;
            f = flight(i, m, from);
            near = most >= 0 && may_strike(m, f, most);
        }
        if (near) take_if_sooner(from + time_to(m, from - m.clock, o, f, most), first_obstacle + k, next);
    }
}

template <class Queue>
void GasRun<Queue>::look_for_obstacles(Slot i, GasMeeting& next) const {
    if (alone_) return;
    const GasDisc& d = discs_.disc[i];
    for (const std::uint32_t k : gas_.everywhere)
        take_if_sooner(d.clock + time_to(gas_.obstacle[k], flight(i, gas_.obstacle[k])), first_obstacle + k, next);
    if (scene_.company) look_for_movers(i, next);
    if (gas_.first_near.empty()) return;
    const bool open = gas_.grid.rim == GasGrid::Rim::open;
    const std::size_t cell = gas_.grid.index(d.cell);
    for (std::uint32_t n = gas_.first_near[cell]; n < gas_.first_near[cell + 1]; ++n) {
        const GasNear& near = gas_.near[n];
        if (open && (near.turns_x != d.turns_x || near.turns_y != d.turns_y)) continue;
        take_if_sooner(d.clock + time_to(gas_.obstacle[near.obstacle], flight(i, near)), first_obstacle + near.obstacle,
                       next);
    }
}

/// How long a way takes that begins at x and leads past a side at ±h, and which side that is.
struct GasPassage {
    double time;
    int side;
};
inline GasPassage gas_passage(double x, double v, double g, double h) {
    if (g == 0) {  // without a branch that depends on the sign
        const double left = std::max(0.0, h - std::copysign(1.0, v) * x);
        return {v == 0 ? gas_never : left / std::abs(v), v > 0 ? 1 : -1};
    }
    const double up = descent(h - x, -v, -0.5 * g), down = descent(h + x, v, 0.5 * g);
    return up < down ? GasPassage{up, 1} : GasPassage{down, -1};
}

template <class Queue>
inline auto GasRun<Queue>::exit_of(const GasDisc& d) const -> Exit {
    const GasPassage x = gas_passage(d.x.x, d.v.x, g_.x, 0.5 * gas_.grid.side.x);
    const GasPassage y = gas_passage(d.x.y, d.v.y, g_.y, 0.5 * gas_.grid.side.y);
    const bool along_x = x.time <= y.time;
    double time = d.clock + std::min(x.time, y.time);
    // Who turns back at a rim within the rounding of time would go to and fro between two cells for ever.
    if (falls_ && time == d.clock && (along_x ? x.side * d.v.x : y.side * d.v.y) < 0)
        time = std::nextafter(time, gas_never);
    return {time, along_x ? x.side : 0, along_x ? 0 : y.side};
}

}  // namespace carom
