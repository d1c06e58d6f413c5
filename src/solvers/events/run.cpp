#include <fmt/format.h>

#include <algorithm>
#include <carom/error.hpp>
#include <carom/random.hpp>
#include <cmath>
#include <limits>

#include "math/compensated.hpp"
#include "math/elementary.hpp"
#include "solvers/events/foresee.hpp"
#include "state/pages.hpp"

namespace carom {

namespace {

/// Of the shortest flight: shorter ones could be lost in rounding.
constexpr double next_to_nothing = 1e-4;

/// The restitution of viscoelastic bodies to leading order (Ramirez et al., Phys. Rev. E 60, 4465 (1999)), from that at
/// a speed, and how many times that speed it is.
double at_speed(double e, double speed) { return std::max(0.0, 1 - (1 - e) * portable::pow(speed, 0.2)); }

}  // namespace

template <class Queue>
GasRun<Queue>::GasRun(const GasScene& scene, State& state, GasOf<Queue>& gas)
    : scene_(scene),
      state_(state),
      all_(gas),
      gas_(gas.data),
      g_(scene.gravity),
      falls_(g_ != Vec2{}),
      mask_(gas_.alike ? 0 : no_slot),
      none_(static_cast<Slot>(gas_.event.size())),
      kernel_(meet_kernel()) {
    begin_ = gas_.now + gas_.now_low;
    for (std::size_t k = 0; k <= cells_around; ++k) {
        offset_x_[k] = column_[k] * gas_.grid.side.x;
        offset_y_[k] = row_[k] * gas_.grid.side.y;
    }
    if (!gas.queued) queue_all();
}

template <class Queue>
void GasRun<Queue>::run(double h) {
    const DoubleDouble end = two_sum(gas_.now, h);
    gas_.now = end.high;
    gas_.now_low += end.low;
    for (;;) {
        const Slot i = all_.queue.next(gas_.event);
        if (i == no_slot || gas_.event[i].due > gas_.now + gas_.now_low) break;
        if (all_.queue.today() != day_) fetch_ahead();
        if (gas_.event[i].due >= 2 * gas_.set_back) {
            set_back();
            continue;
        }
        watch_for_jam(gas_.event[i].due);
        happen(i);
    }
    write_state();
}

/// Discs that all touch pass blows on in no time, and in a cluster of them that can go on for longer than anybody
/// waits: the number of collisions is finite, but grows beyond all bounds with their number.
template <class Queue>
void GasRun<Queue>::watch_for_jam(double due) {
    if (due > stuck_since_ + 1e-12 * gas_.set_back) stuck_since_ = due, stuck_ = 0;
    const std::uint64_t most = 100000 + 1000 * static_cast<std::uint64_t>(none_);
    if (++stuck_ <= most) return;
    throw Error(fmt::format("the gas is jammed: {} collisions in no time. Discs that all touch one another have no "
                            "order in which they collide; set them a little apart at the start",
                            most),
                Error::Cause::run);
}

/// Brings near what the events of the coming days will read: a large gas would wait for its memory most of the time.
/// A disc's neighbours are known when its cell is, and its cell when its record is here, hence the stages.
template <class Queue>
void GasRun<Queue>::fetch_ahead() {
    day_ = all_.queue.today();
    const auto fetch = [](const auto& what) { __builtin_prefetch(&what, 1); };
    for (const std::size_t link : {0, 1, 2})
        if (const Slot i = all_.queue.on_day(gas_.event, 12 - 2 * link, link); i < none_) fetch(gas_.event[i]);
    all_.queue.for_day(gas_.event, 6, [&](Slot i) { fetch(gas_.disc[i]); });
    all_.queue.for_day(gas_.event, 4, [&](Slot i) {
        const GasDisc& d = gas_.disc[i];
        if (d.partner < none_) fetch(gas_.disc[d.partner]), fetch(gas_.event[d.partner]);
        const Slot* own = all_.first_in_cell.data() + gas_.grid.index(d.cell);
        fetch(*own);
        if (d.cell.y > 0) fetch(*(own - gas_.grid.nx));
        if (d.cell.y + 1 < gas_.grid.ny) fetch(*(own + gas_.grid.nx));
    });
    all_.queue.for_day(gas_.event, 2, [&](Slot i) {
        const GasDisc& d = gas_.disc[i];
        for (const Slot j : first_around(d.cell)) fetch(gas_.disc[j]);
        if (d.partner >= none_ || gas_.event[i].due < gas_.event[i].hit) return;
        for (const Slot j : first_around(gas_.disc[d.partner].cell)) fetch(gas_.disc[j]);
        const GasEvent& other = gas_.event[d.partner];
        if (other.next < none_) fetch(gas_.event[other.next]);
        if (other.previous < none_) fetch(gas_.event[other.previous]);
    });
}

// ---- Where discs are ------------------------------------------------------------------------------------------------

template <class Queue>
void GasRun<Queue>::move(Slot i, double time) {
    GasDisc& d = gas_.disc[i];
    if (falls_) book_fall(i, std::max(d.clock, begin_), time);
    const double t = time - d.clock;
    d.x += t * (d.v + 0.5 * t * g_);
    d.v += t * g_;
    d.clock = time;
}

/// What gravity gave to a disc between two times of its flight.
template <class Queue>
void GasRun<Queue>::book_fall(Slot i, double from, double to) {
    const GasDisc& d = gas_.disc[i];
    const double m = scene_.bodies.mass[gas_.event[i].row], s = from - d.clock, t = to - from;
    const Vec2 v = d.v + s * g_, x = gas_.grid.middle(d) + d.x + s * (d.v + 0.5 * s * g_);
    state_.account[Account::gravity] += m * t * dot(g_, v + 0.5 * t * g_);
    state_.account[Giver::gravity].add(m * t * g_, m * cross(t * (x + t * (0.5 * v + t / 6 * g_)), g_));
}

/// The clock goes back by a power of two, so that times stay as precise as they are at the start.
template <class Queue>
void GasRun<Queue>::set_back() {
    const double by = gas_.set_back;
    for (GasDisc& d : gas_.disc) d.clock -= by;
    for (GasEvent& e : gas_.event) e.due -= by, e.hit -= by;
    for (GasSpin& s : gas_.spin) s.clock -= by;
    for (GasPast& p : gas_.past) p.last_hit -= by;
    for (GasObstacle& o : gas_.obstacle) o.clock -= by;
    gas_.now -= by;
    begin_ -= by;
    stuck_since_ -= by;
    all_.queue.shift(gas_.event, by);
}

template <class Queue>
void GasRun<Queue>::write_state() {
    const double now = gas_.now + gas_.now_low;
    for (Slot i = 0; i < none_; ++i) {
        const GasDisc& d = gas_.disc[i];
        const std::uint32_t row = gas_.event[i].row;
        if (falls_) book_fall(i, std::max(d.clock, begin_), now);
        const double t = now - d.clock;
        state_.x.linear[row] = gas_.grid.middle(d) + (d.x + t * (d.v + 0.5 * t * g_));
        state_.v.linear[row] = d.v + t * g_;
    }
    for (Slot i = 0; i < gas_.spin.size(); ++i) {
        const GasSpin& s = gas_.spin[i];
        state_.x.angular[gas_.event[i].row] = s.angle + (now - s.clock) * s.velocity;
        state_.v.angular[gas_.event[i].row] = s.velocity;
    }
    const Bodies& bodies = scene_.bodies;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        if (bodies.kind[row] != Kind::driven) continue;
        state_.x.linear[row] += (now - begin_) * state_.v.linear[row];
        state_.x.angular[row] += (now - begin_) * state_.v.angular[row];
    }
}

// ---- What happens ---------------------------------------------------------------------------------------------------

template <class Queue>
void GasRun<Queue>::queue_all() {
    reserve_large(all_.first_in_cell, gas_.grid.cells());
    all_.first_in_cell.assign(gas_.grid.cells(), none_);
    gas_.disc[none_].next_in_cell = none_;
    for (Slot i = 0; i < none_; ++i) {
        Slot& first = all_.first_in_cell[gas_.grid.index(gas_.disc[i].cell)];
        gas_.disc[i].next_in_cell = first;
        first = i;
    }
    if (!gas_.fits) {
        for (GasEvent& event : gas_.event) event.due = event.hit = gas_never;
        all_.queue.fill(gas_.event, gas_.now);
        for (Slot i = 0; i < none_; ++i) foresee(i);
    }
    all_.queue.fill(gas_.event, gas_.now);
    all_.queued = true;
    gas_.fits = true;
}

template <class Queue>
void GasRun<Queue>::happen(Slot i) {
    const GasEvent& event = gas_.event[i];
    if (event.due < event.hit) return leave_cell(i);
    const std::uint32_t partner = gas_.disc[i].partner;
    move(i, event.due);
    if (partner >= first_obstacle) return hit_obstacle(i, partner - first_obstacle);
    if (gas_.disc[partner].hits != event.partner_hits) return foresee(i);
    hit_disc(i, partner);
}

template <class Queue>
void GasRun<Queue>::leave_cell(Slot i) {
    GasDisc& d = gas_.disc[i];
    const Exit exit = exit_of(d);
    move(i, gas_.event[i].due);
    GasGrid& grid = gas_.grid;
    Slot* link = &all_.first_in_cell[grid.index(d.cell)];
    while (*link != i) link = &gas_.disc[*link].next_in_cell;
    *link = d.next_in_cell;
    const auto step = [](std::uint16_t& cell, std::int32_t& turns, int by, std::int32_t n) {
        const std::int32_t to = cell + by, around = to < 0 ? -1 : to >= n ? 1 : 0;
        turns += around;
        cell = static_cast<std::uint16_t>(to - around * n);
    };
    step(d.cell.x, d.turns_x, exit.x, grid.nx);
    step(d.cell.y, d.turns_y, exit.y, grid.ny);
    d.x -= Vec2{exit.x * grid.side.x, exit.y * grid.side.y};
    Slot& first = all_.first_in_cell[grid.index(d.cell)];
    d.next_in_cell = first;
    first = i;
    // Only the cells ahead are new; what was foreseen still holds.
    GasMeeting next{gas_.event[i].hit, d.partner};
    if (next.time < gas_never && d.partner < first_obstacle && gas_.disc[d.partner].hits != gas_.event[i].partner_hits)
        return foresee(i);
    look_ahead(i, exit, next);
    look_for_obstacles(i, next);
    settle(i, next);
}

template <class Queue>
void GasRun<Queue>::hit_disc(Slot i, Slot j) {
    move(j, gas_.event[i].due);
    if (bounce(i, j)) {
        ++gas_.disc[i].hits, ++gas_.disc[j].hits;
        ++gas_.disc_hits;
    }
    foresee(i);
    foresee(j);
}

/// The impulse along the line of the centres, (1 + e) (d·u)/(d·d) d over the inverse masses: without a square root,
/// and with the distance as it is, it keeps the energy to rounding. False if they part already, by rounding.
template <class Queue>
bool GasRun<Queue>::bounce(Slot i, Slot j) {
    GasDisc &a = gas_.disc[i], &b = gas_.disc[j];
    const Vec2 d = gas_.grid.between(a, b) + (b.x - a.x), u = b.v - a.v;
    const double approach = dot(d, u), squared = dot(d, d);
    if (approach >= 0) return false;
    if (!gas_.plain) return bounce_with_all(i, j, d);
    const double ease_a = inverse_mass(i), ease_b = inverse_mass(j);
    const double s = 2 * approach / (squared * (ease_a + ease_b));
    a.v += (s * ease_a) * d;
    b.v -= (s * ease_b) * d;
    gas_.virial -= s * squared;
    if (gas_.grid.rim != GasGrid::Rim::periodic) return true;
    // Across the sides of the box the torques of the two do not cancel.
    const Vec2 apart = gas_.grid.middle(b) + b.x - (gas_.grid.middle(a) + a.x);
    if (squared_length(apart) > 4 * squared) state_.account[Giver::method].torque -= s * cross(apart, d);
    return true;
}

/// With restitution, friction and spin.
template <class Queue>
bool GasRun<Queue>::bounce_with_all(Slot i, Slot j, Vec2 d) {
    const Bodies& bodies = scene_.bodies;
    const std::uint32_t p = gas_.event[i].row, q = gas_.event[j].row;
    const double distance = length(d);
    const Vec2 normal = d / distance;
    const double approach = dot(gas_.disc[i].v - gas_.disc[j].v, normal);
    const double e = restitution(bodies.restitution[p], bodies.restitution[q], approach, i, j);
    turn_up(i), turn_up(j);
    const Vec2 before = gas_.disc[i].v;
    collide(party(i), party(j), {normal, e, mixed_friction(bodies.friction[p], bodies.friction[q])}, state_.account);
    gas_.virial += distance * bodies.mass[p] * dot(before - gas_.disc[i].v, normal);
    return true;
}

template <class Queue>
Party GasRun<Queue>::party(Slot i) {
    GasDisc& d = gas_.disc[i];
    const std::uint32_t row = gas_.event[i].row;
    Party p{gas_.grid.middle(d) + d.x, &d.v,       nullptr, scene_.bodies.inverse_mass[row], 0,
            scene_.bodies.radius[row], Giver::held};
    if (!gas_.spin.empty()) {
        p.w = &gas_.spin[i].velocity;
        p.inverse_inertia = scene_.bodies.inverse_inertia[row];
    }
    return p;
}

/// The angle of a disc is that of its last hit.
template <class Queue>
void GasRun<Queue>::turn_up(Slot i) {
    if (gas_.spin.empty()) return;
    GasSpin& s = gas_.spin[i];
    s.angle += (gas_.disc[i].clock - s.clock) * s.velocity;
    s.clock = gas_.disc[i].clock;
}

/// The coefficient of an impact; 1 where the rule against collapse says so.
template <class Queue>
double GasRun<Queue>::restitution(double a, double b, double approach, Slot i, Slot j) {
    double e = mixed_restitution(a, b);
    if (scene_.options.restitution_speed) e = at_speed(e, approach / *scene_.options.restitution_speed);
    if (gas_.past.empty()) return e;
    const bool one = collapses(i, approach), other = j != no_slot && collapses(j, approach);
    if (e == 1 || !(one || other)) return e;
    ++gas_.made_elastic;
    return 1;
}

/// Whether a disc has flown next to nowhere many times in a row; or once so little that the next flight, shorter by the
/// restitution, could be lost in rounding. Discs that touch in a row pass a blow on in no time at all, and may.
template <class Queue>
bool GasRun<Queue>::collapses(Slot i, double approach) {
    constexpr std::uint32_t many = 8;
    GasPast& past = gas_.past[i];
    const double time = gas_.disc[i].clock, r = radius(i) > 0 ? radius(i) : gas_.grid.side.x;
    const double way = approach * (time - past.last_hit), shortest = scene_.options.collapse * r;
    past.short_flights = way < shortest ? past.short_flights + 1 : 0;
    const bool lost = time > past.last_hit && way < next_to_nothing * shortest;
    past.last_hit = time;
    return lost || past.short_flights > many;
}

/// From a thermal wall come the velocities of a gas at its temperature behind an opening: Maxwell's along the wall, and
/// across it weighted with the speed, v exp(−½ m v²/kT).
template <class Queue>
void GasRun<Queue>::warm_up(Slot i, const GasObstacle& wall) {
    GasDisc& d = gas_.disc[i];
    const double m = scene_.bodies.mass[gas_.event[i].row], speed = std::sqrt(wall.temperature / m);
    Random random(static_cast<std::uint64_t>(scene_.options.seed) * 0x9e3779b97f4a7c15u + gas_.drawn++);
    const double out = speed * std::sqrt(-2 * portable::log(1 - random.uniform()));
    const Vec2 before = d.v;
    d.v = out * wall.normal + (speed * random.normal()) * perpendicular(wall.normal);
    const Vec2 impulse = m * (d.v - before);
    state_.account[Account::bath] -= 0.5 * dot(impulse, d.v + before);
    state_.account[Giver::walls].add_at(gas_.grid.middle(d) + d.x, impulse);
}

template <class Queue>
void GasRun<Queue>::hit_obstacle(Slot i, std::uint32_t k) {
    const GasObstacle& o = gas_.obstacle[k];
    const std::uint32_t row = gas_.event[i].row;
    GasFlight f = flight(i, o);
    if (!gas_.first_near.empty()) {  // the image that it strikes
        const std::size_t cell = gas_.grid.index(gas_.disc[i].cell);
        double nearest = gas_never;
        for (std::uint32_t n = gas_.first_near[cell]; n < gas_.first_near[cell + 1]; ++n) {
            if (gas_.near[n].obstacle != k) continue;
            const GasFlight other = flight(i, gas_.near[n]);
            const double gap = std::abs(gap_to(o, other));
            if (gap < nearest) nearest = gap, f = other;
        }
    }
    const Vec2 normal = normal_at(o, f);
    const double approach = -dot(f.v, normal), least = least_rebound(i, normal);
    if (approach <= 0 && approach > -least) return lift(i, o, normal, approach, least);
    if (approach > 0) {
        double e = restitution(o.restitution, scene_.bodies.restitution[row], approach, i, no_slot);
        if (e * approach < least) e = least / approach, ++gas_.made_elastic;
        turn_up(i);
        Vec2 velocity = o.v;
        double spin = o.spin;
        Party wall{.v = &velocity, .w = &spin, .radius = o.radius};
        wall.holder = o.row == GasObstacle::no_row ? Giver::walls : Giver::held;
        const Vec2 before = gas_.disc[i].v;
        if (o.temperature > 0)
            warm_up(i, o);
        else
            collide(party(i), wall, {-normal, e, mixed_friction(o.friction, scene_.bodies.friction[row])},
                    state_.account);
        if (o.endless) gas_.wall_impulse += scene_.bodies.mass[row] * dot(gas_.disc[i].v - before, normal);
        ++gas_.disc[i].hits;
        ++gas_.obstacle_hits;
    }
    foresee(i);
}

/// The speed with which a disc that gravity presses onto something at least leaves it: that of the shortest flight that
/// the rule against collapse knows. What would lie there trembles.
template <class Queue>
double GasRun<Queue>::least_rebound(Slot i, Vec2 normal) const {
    const double pull = -dot(g_, normal), r = radius(i) > 0 ? radius(i) : gas_.grid.side.x;
    return pull > 0 ? std::sqrt(0.5 * next_to_nothing * scene_.options.collapse * r * pull) : 0;
}

/// A disc that lies on something begins to tremble. The energy is that of an impact which gave some.
template <class Queue>
void GasRun<Queue>::lift(Slot i, const GasObstacle& o, Vec2 normal, double approach, double least) {
    GasDisc& d = gas_.disc[i];
    const double m = scene_.bodies.mass[gas_.event[i].row], gain = least + approach;
    const Vec2 impulse = m * gain * normal;
    state_.account[Account::impact] -= dot(impulse, d.v + 0.5 * gain * normal - o.v);
    state_.account[Account::driven] += dot(impulse, o.v);
    state_.account[o.row == GasObstacle::no_row ? Giver::walls : Giver::held].add_at(gas_.grid.middle(d) + d.x,
                                                                                     impulse);
    d.v += gain * normal;
    ++d.hits;
    ++gas_.obstacle_hits, ++gas_.made_elastic;
    foresee(i);
}

template <class Queue>
void advance(const GasScene& scene, State& state, double h, GasOf<Queue>& gas) {
    if (!gas.data.fits) {
        check_gas(scene, state);
        fill_gas(scene, state, gas.data);
        gas.queued = false;
    }
    GasRun(scene, state, gas).run(h);
}

template void advance(const GasScene&, State&, double, GasOf<Calendar>&);
template void advance(const GasScene&, State&, double, GasOf<SortedQueue>&);

}  // namespace carom
