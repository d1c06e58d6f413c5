#pragma once
// The second half of GasRun: what will be.

#include <algorithm>
#include <cmath>
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
void GasRun<Queue>::settle(Slot i, const GasMeeting& next) {
    GasDisc& d = discs_.disc[i];
    GasEvent& event = discs_.event[i];
    d.partner = next.partner;
    event.hit = next.time;
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

/// Its own time and place, as the kernel sees them.
template <class Queue>
GasView GasRun<Queue>::view(Slot i) const {
    const GasDisc& a = discs_.disc[i];
    return {a.x.x, a.x.y, a.v.x, a.v.y, a.clock, radius(i), g_.x, g_.y, &discs_.disc.data()->x.x, discs_.radius.data(),
            mask_};
}

/// The first discs of the eight cells around a cell, in the order of their offsets; then that of the cell itself.
template <class Queue>
auto GasRun<Queue>::first_around(Cell at) const -> std::array<Slot, cells_around + 1> {
    const GasWindow& w = part_.window;
    const Slot* const first = part_.first_in_cell.data();
    const std::int32_t x = w.column(at), y = w.row(at);
    if (x > 0 && x + 1 < w.nx && y > 0 && y + 1 < w.ny) {
        const Slot *own = first + w.index(x, y), *below = own - w.nx, *above = own + w.nx;
        return {below[-1], below[0], below[1], own[-1], own[1], above[-1], above[0], above[1], own[0]};
    }
    const auto around = [](std::int32_t c, std::int32_t n) { return c < 0 ? c + n : c >= n ? c - n : c; };
    std::array<Slot, cells_around + 1> slots;
    for (std::size_t k = 0; k < slots.size(); ++k) {
        const std::int32_t column = around(x + column_[k], w.all_x), row = around(y + row_[k], w.all_y);
        slots[k] = column < w.nx && row < w.ny ? first[w.index(column, row)] : none_;
    }
    return slots;
}

template <class Queue>
void GasRun<Queue>::look_around(Slot i, GasMeeting& next) const {
    const GasDisc* const discs = discs_.disc.data();
    const auto slots = first_around(discs[i].cell);
    const GasView a = view(i);
    std::array<double, cells_around> time;
    kernel_.times(a, slots.data(), offset_x_.data(), offset_y_.data(), time.data());
    // The others in these cells, and in its own.
    Slot more = slots[cells_around] == i ? discs[i].next_in_cell : slots[cells_around];
    for (; more != none_; more = discs[more].next_in_cell) meet(a, i, more, cells_around, next);
    std::array<Slot, cells_around> behind;
    std::array<std::uint8_t, cells_around> where;
    std::size_t count = 0;
    for (std::size_t k = 0; k < cells_around; ++k) {
        behind[count] = discs[slots[k]].next_in_cell;
        where[count] = static_cast<std::uint8_t>(k);
        count += behind[count] != none_;
    }
    for (std::size_t k = 0; k < count; ++k)
        for (more = behind[k]; more != none_; more = discs[more].next_in_cell) meet(a, i, more, where[k], next);
    for (std::size_t k = 0; k < cells_around; ++k)
        if (time[k] <= next.time && meets(i, slots[k])) take_if_sooner(time[k], slots[k], next);
}

/// The three cells ahead of one that the disc came into.
template <class Queue>
void GasRun<Queue>::look_ahead(Slot i, const Exit& exit, GasMeeting& next) const {
    const auto slots = first_around(discs_.disc[i].cell);
    const GasView a = view(i);
    for (std::size_t k = 0; k < cells_around; ++k)
        if ((exit.x != 0 && column_[k] == exit.x) || (exit.y != 0 && row_[k] == exit.y))
            for (Slot j = slots[k]; j != none_; j = discs_.disc[j].next_in_cell) meet(a, i, j, k, next);
}

/// When a disc meets another whose cell is that far away, or never: with the kernel's bits.
template <class Queue>
double GasRun<Queue>::time_to_meet(const GasView& a, Slot j, Vec2 offset) const {
    const GasDisc& other = discs_.disc[j];
    const double from = std::max(other.clock, a.clock), reach = a.radius + radius(j);
    const double t = from - other.clock, s = from - a.clock;
    const Vec2 x{a.x, a.y}, v{a.vx, a.vy};
    Vec2 d, u;
    if (falls_) {
        d = (other.x + t * (other.v + 0.5 * t * g_)) - (x + s * (v + 0.5 * s * g_));
        u = (other.v + t * g_) - (v + s * g_);
    } else {
        d = (other.x + t * other.v) - (x + s * v);
        u = other.v - v;
    }
    d = offset + d;
    const double b = dot(d, u), c = dot(d, d) - reach * reach, inside = b * b - dot(u, u) * c;
    if (b >= 0 || (inside < 0 && c > 0)) return gas_never;
    return c <= 0 ? from : from + c / (std::sqrt(inside) - b);
}

/// One other disc, whose cell is the k-th around.
template <class Queue>
void GasRun<Queue>::meet(const GasView& a, Slot i, Slot j, std::size_t k, GasMeeting& next) const {
    const double time = time_to_meet(a, j, {offset_x_[k], offset_y_[k]});
    if (time <= next.time && meets(i, j)) take_if_sooner(time, j, next);
}

/// Whether two discs that come near are where they seem to be, and can touch at all.
template <class Queue>
bool GasRun<Queue>::meets(Slot i, Slot j) const {
    if (radius(i) + radius(j) == 0) return false;
    if (gas_.grid.rim != GasGrid::Rim::open) return true;
    const GasDisc &a = discs_.disc[i], &b = discs_.disc[j];
    const std::int64_t dx = b.cell.x - a.cell.x + (static_cast<std::int64_t>(b.turns_x) - a.turns_x) * gas_.grid.nx;
    const std::int64_t dy = b.cell.y - a.cell.y + (static_cast<std::int64_t>(b.turns_y) - a.turns_y) * gas_.grid.ny;
    return std::abs(dx) <= 1 && std::abs(dy) <= 1;
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
auto GasRun<Queue>::exit_of(const GasDisc& d) const -> Exit {
    const GasPassage x = gas_passage(d.x.x, d.v.x, g_.x, 0.5 * gas_.grid.side.x);
    const GasPassage y = gas_passage(d.x.y, d.v.y, g_.y, 0.5 * gas_.grid.side.y);
    return x.time <= y.time ? Exit{d.clock + x.time, x.side, 0} : Exit{d.clock + y.time, 0, y.side};
}

}  // namespace carom
