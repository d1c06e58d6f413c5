#include <fmt/format.h>

#include <algorithm>
#include <carom/error.hpp>
#include <carom/random.hpp>
#include <cmath>
#include <limits>

#include "math/compensated.hpp"
#include "math/elementary.hpp"
#include "solvers/events/fetch.hpp"
#include "solvers/events/foresee.hpp"
#include "solvers/events/meet_company.hpp"
#include "state/row_name.hpp"

namespace carom {

namespace {

/// Of the shortest flight: shorter ones could be lost in rounding.
constexpr double next_to_nothing = 1e-4;
/// So many discs have records for more than a cache near the processor: their memory is asked for before it is needed.
/// With fewer that takes longer than it saves (docs/performance-notes.md).
constexpr Slot many_discs = 25000;

/// The restitution of viscoelastic bodies to leading order (Ramirez et al., Phys. Rev. E 60, 4465 (1999)), from that at
/// a speed, and how many times that speed it is.
double at_speed(double e, double speed) { return std::max(0.0, 1 - (1 - e) * portable::pow(speed, 0.2)); }

}  // namespace

template <class Queue>
GasRun<Queue>::GasRun(const GasScene& scene, const GasData& gas, GasPart<Queue>& part, GasBooks& books, GasEdge* edge)
    : scene_(scene),
      gas_(gas),
      part_(part),
      discs_(part.discs),
      own_(&books),
      books_(&books),
      edge_(edge),
      g_(scene.gravity),
      falls_(g_ != Vec2{}),
      alone_(gas.everywhere.empty() && gas.first_near.empty() && !scene.company),
      scale_(gas.widest > 0 ? 1.3 / gas.widest : 1),
      mask_(gas.alike ? 0 : no_slot),
      none_(part.discs.size()),
      fetches_(none_ >= many_discs),
      kernel_(meet_kernel()),
      view_{&discs_.disc.data()->x.x, discs_.radius.data(), mask_, g_.x, g_.y} {
    for (std::size_t k = 0; k < cells_around; ++k)
        offset_[k] = {column_around(k) * gas_.grid.side.x, row_around(k) * gas_.grid.side.y};
}

template <class Queue>
void GasRun<Queue>::run(double until) {
    if (!part_.queued) queue_all();
    if constexpr (std::is_same_v<Queue, Calendar>) part_.queue.look_ahead(fetches_ ? fetch_far : 0);
    for (;;) {
        const Slot i = part_.queue.next(discs_.event);
        if (i == no_slot || discs_.event[i].due > until) return;
        if (fetches_) fetch_ahead();
        watch_for_jam(discs_.event[i].due);
        if (!edge_ || foretells(i)) happen(i);
        if (scene_.company && scene_.company->stopped) return;
    }
}

/// How many cells away from the inner ones of a block.
template <class Queue>
std::int32_t GasRun<Queue>::distance(Slot i) const {
    const Cell at = discs_.disc[i].cell;
    return edge_->border.distance(part_.window.column(at), part_.window.row(at));
}

/// An event is booked where a disc of it is: how many cells away from the inner ones.
template <class Queue>
std::int32_t GasRun<Queue>::open_books(Slot i) {
    if (!edge_) return 0;
    const std::int32_t away = distance(i);
    books_ = away == 0 ? own_ : &edge_->beyond;
    return away;
}

/// Whether a block still follows such an event.
template <class Queue>
bool GasRun<Queue>::foretells(Slot i) {
    if (open_books(i) <= GasEdge::width) return true;
    part_.queue.change(discs_.event, i, gas_never);
    return false;
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

/// What closes in on discs that have nowhere to go strikes them ever faster, and infinitely often before it has
/// arrived: in the end discs are a hundred times as fast as any at first, and have flown less than a tenth of their
/// radius.
template <class Queue>
void GasRun<Queue>::watch_for_press(Slot i, const GasObstacle& o, double flown) {
    constexpr double fast = 100, hardly = 0.1;
    constexpr int many = 1000;
    const double speed = length(discs_.disc[i].v), r = radius(i) > 0 ? radius(i) : gas_.grid.side.x;
    const double at_first = 16 * gas_.grid.side.x / gas_.set_back;  // of the fastest, or up to twice it
    if (speed > fast * std::max(at_first, length(o.v)) && flown * speed < hardly * r) ++pressed_;
    if (pressed_ >= many) end_pressed(o, "it ever faster and more often");
}

/// What moves in steps and is held where it presses discs, as by a joint and walls, comes to be in them, and strikes
/// them wherever they turn: they fly no farther than rounding. What rests on it makes flights ten thousand times as
/// long, and those of what it squeezes by its own energy are no shorter than that lets them.
template <class Queue>
void GasRun<Queue>::watch_for_wedge(Slot i, const GasObstacle& o, double flown) {
    constexpr double rounding = 1e-12;
    constexpr int many = 100000;
    const double r = radius(i) > 0 ? radius(i) : gas_.grid.side.x;
    const double speed = length(discs_.disc[i].v);
    if (speed > 0 && flown * speed < rounding * r && ++wedged_ >= many)
        end_pressed(o, "it wherever it turns, again and again");
}

template <class Queue>
void GasRun<Queue>::end_pressed(const GasObstacle& o, const char* how) const {
    throw Error(fmt::format("the gas has no room left: body {} presses it, and strikes {}",
                            name_of_row(scene_.bodies, o.row), how),
                Error::Cause::run);
}

// ---- Where discs are ------------------------------------------------------------------------------------------------

template <class Queue>
void GasRun<Queue>::move(Slot i, double time) {
    GasDisc& d = discs_.disc[i];
    if (falls_) book_fall(i, std::max(d.clock, gas_.begin), time);
    const double t = time - d.clock;
    d.x += t * (d.v + 0.5 * t * g_);
    d.v += t * g_;
    d.clock = time;
}

/// What gravity gave to a disc between two times of its flight.
template <class Queue>
void GasRun<Queue>::book_fall(Slot i, double from, double to) {
    const GasDisc& d = discs_.disc[i];
    const double m = scene_.bodies.mass[discs_.event[i].row], s = from - d.clock, t = to - from;
    const Vec2 v = d.v + s * g_, x = gas_.grid.middle(d) + d.x + s * (d.v + 0.5 * s * g_);
    books_->account[Account::gravity] += m * t * dot(g_, v + 0.5 * t * g_);
    books_->account[Giver::gravity].add(m * t * g_, m * cross(t * (x + t * (0.5 * v + t / 6 * g_)), g_));
}

template <class Queue>
void GasRun<Queue>::show(State& state, double now) {
    for (Slot i = 0; i < none_; ++i) {
        const GasDisc& d = discs_.disc[i];
        const std::uint32_t row = discs_.event[i].row;
        if (falls_) book_fall(i, std::max(d.clock, gas_.begin), now);
        const double t = now - d.clock;
        state.x.linear[row] = gas_.grid.middle(d) + (d.x + t * (d.v + 0.5 * t * g_));
        state.v.linear[row] = d.v + t * g_;
    }
    for (Slot i = 0; i < discs_.spin.size(); ++i) {
        const GasSpin& s = discs_.spin[i];
        state.x.angular[discs_.event[i].row] = s.angle + (now - s.clock) * s.velocity;
        state.v.angular[discs_.event[i].row] = s.velocity;
    }
    const Bodies& bodies = scene_.bodies;
    if (scene_.company) return;  // its solver moves driven bodies too
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        if (bodies.kind[row] != Kind::driven) continue;
        state.x.linear[row] += (now - gas_.begin) * state.v.linear[row];
        state.x.angular[row] += (now - gas_.begin) * state.v.angular[row];
    }
}

// ---- What happens ---------------------------------------------------------------------------------------------------

template <class Queue>
void GasRun<Queue>::queue_all() {
    part_.cells.begin(part_.window);
    for (Slot i = 0; i < none_; ++i) part_.cells.at(discs_.disc[i].cell).put(discs_.disc.data(), i);
    part_.queue.fill(discs_.event, edge_ ? edge_->from : gas_.begin);
    part_.queued = true;
}

template <class Queue>
void GasRun<Queue>::foresee_all() {
    for (GasEvent& event : discs_.event) event.due = event.hit = gas_never;
    queue_all();
    for (Slot i = 0; i < none_; ++i) foresee(i);
    part_.queue.fill(discs_.event, gas_.begin);
}

/// What a block's cell will have seen of a disc.
template <class Queue>
void GasRun<Queue>::note(Slot i) {
    if (!edge_) return;
    const GasDisc& d = discs_.disc[i];
    edge_->note(part_.window.column(d.cell), part_.window.row(d.cell), d, discs_.event[i].row);
}

template <class Queue>
void GasRun<Queue>::happen(Slot i) {
    const GasEvent& event = discs_.event[i];
    if (event.due < event.hit) return leave_cell(i);
    const std::uint32_t partner = discs_.disc[i].partner;
    if (partner < first_obstacle && discs_.disc[partner].hits != event.partner_hits) return foresee(i);
    now_ = event.due;
    if (partner >= first_obstacle) return hit_obstacle(i, partner - first_obstacle);
    hit_disc(i, partner);
}

template <class Queue>
void GasRun<Queue>::leave_cell(Slot i) {
    GasDisc& d = discs_.disc[i];
    const Exit exit = exit_of(d);
    move(i, discs_.event[i].due);
    const GasGrid& grid = gas_.grid;
    note(i);
    part_.cells.at(d.cell).take(discs_.disc.data(), i);
    const auto step = [](std::uint16_t& cell, std::int32_t& turns, int by, std::int32_t n) {
        const std::int32_t to = cell + by, around = to < 0 ? -1 : to >= n ? 1 : 0;
        turns += around;
        cell = static_cast<std::uint16_t>(to - around * n);
    };
    step(d.cell.x, d.turns_x, exit.x, grid.nx);
    step(d.cell.y, d.turns_y, exit.y, grid.ny);
    d.x -= Vec2{exit.x * grid.side.x, exit.y * grid.side.y};
    note(i);
    if (edge_ && !part_.window.has(d.cell)) return part_.queue.change(discs_.event, i, gas_never);
    part_.cells.at(d.cell).put(discs_.disc.data(), i);
    // Only the cells ahead are new; what was foreseen still holds.
    GasMeeting next{discs_.event[i].hit, d.partner};
    if (next.time < gas_never && d.partner < first_obstacle &&
        discs_.disc[d.partner].hits != discs_.event[i].partner_hits)
        return foresee(i);
    look_ahead(i, exit, next);
    look_for_obstacles(i, next);
    settle(i, next);
}

/// The time of a hit by the flights as they are: what was foreseen before a disc came into another cell may differ from
/// it in the last bit, and then the course would depend on who foresaw it when.
template <class Queue>
double GasRun<Queue>::as_foreseen_now(double due, double again) const {
    return std::abs(again - due) <= 1e-6 * gas_.set_back ? again : due;
}

template <class Queue>
void GasRun<Queue>::hit_disc(Slot i, Slot j) {
    if (discs_.event[j].row < discs_.event[i].row) return hit_disc(j, i);
    open_books(i);
    const auto [time, offset] = as_foreseen_now(i, j);
    move(i, time), move(j, time);
    if (bounce(i, j, offset)) {
        ++discs_.disc[i].hits, ++discs_.disc[j].hits;
        ++books_->tally.disc_collisions;
    }
    note(i), note(j);
    foresee(i);
    foresee(j);
}

/// The impulse along the line of the centres, (1 + e) (d·u)/(d·d) d over the inverse masses: without a square root,
/// and with the distance as it is, it keeps the energy to rounding. False if they part already, by rounding.
template <class Queue>
bool GasRun<Queue>::bounce(Slot i, Slot j, Vec2 offset) {
    GasDisc &a = discs_.disc[i], &b = discs_.disc[j];
    const Vec2 way = offset + (b.x - a.x), d = scale_ * way, u = b.v - a.v;
    const double approach = dot(d, u), squared = dot(d, d);
    if (!gas_.plain) return dot(way, u) < 0 && bounce_with_all(i, j, way);
    if (approach >= 0) return false;
    const double ease_a = inverse_mass(i), ease_b = inverse_mass(j);
    const double s = 2 * approach / (squared * (ease_a + ease_b));
    a.v += (s * ease_a) * d;
    b.v -= (s * ease_b) * d;
    books_->tally.virial -= s * squared / scale_;
    if (gas_.grid.rim != GasGrid::Rim::periodic || gas_.grid.unrolled(a, b) == offset) return true;
    // Across the sides of the box the torques of the two do not cancel.
    const Vec2 apart = gas_.grid.middle(b) + b.x - (gas_.grid.middle(a) + a.x);
    books_->account[Giver::method].torque -= s * cross(apart, d);
    return true;
}

/// With restitution, friction and spin.
template <class Queue>
bool GasRun<Queue>::bounce_with_all(Slot i, Slot j, Vec2 d) {
    const Bodies& bodies = scene_.bodies;
    const std::uint32_t p = discs_.event[i].row, q = discs_.event[j].row;
    const double distance = length(d);
    const Vec2 normal = d / distance;
    const double approach = dot(discs_.disc[i].v - discs_.disc[j].v, normal);
    const Surfaces met = meeting({bodies.restitution[p], bodies.friction[p]},
                                 {bodies.restitution[q], bodies.friction[q]}, approach, i, j);
    turn_up(i), turn_up(j);
    const Vec2 before = discs_.disc[i].v;
    collide(party(i), party(j), {normal, met.restitution, met.friction, beyond_rounding(i) + beyond_rounding(j)},
            books_->account);
    books_->tally.virial += distance * bodies.mass[p] * dot(before - discs_.disc[i].v, normal);
    return true;
}

template <class Queue>
Party GasRun<Queue>::party(Slot i) {
    GasDisc& d = discs_.disc[i];
    const std::uint32_t row = discs_.event[i].row;
    Party p{gas_.grid.middle(d) + d.x, &d.v,       nullptr, scene_.bodies.inverse_mass[row], 0,
            scene_.bodies.radius[row], Giver::held};
    if (!discs_.spin.empty()) {
        p.w = &discs_.spin[i].velocity;
        p.inverse_inertia = scene_.bodies.inverse_inertia[row];
    }
    return p;
}

/// The angle of a disc is that of its last hit.
template <class Queue>
void GasRun<Queue>::turn_up(Slot i) {
    if (discs_.spin.empty()) return;
    GasSpin& s = discs_.spin[i];
    s.angle += (discs_.disc[i].clock - s.clock) * s.velocity;
    s.clock = discs_.disc[i].clock;
}

/// How two meet, from how each is: without a loss where the rule against collapse says so, but for friction of that
/// part of the impulse which is weight.
template <class Queue>
typename GasRun<Queue>::Surfaces GasRun<Queue>::meeting(const Surfaces& a, const Surfaces& b, double approach, Slot i,
                                                        Slot j, double weight) {
    Surfaces met{mixed_restitution(scene_.bodies, a.restitution, b.restitution),
                 mixed_friction(scene_.bodies, a.friction, b.friction), a.warms || b.warms};
    if (scene_.options.restitution_speed)
        met.restitution = at_speed(met.restitution, approach / *scene_.options.restitution_speed);
    if (discs_.past.empty()) return met;
    const bool one = collapses(i, approach), other = j != no_slot && collapses(j, approach);
    if (!(one || other) || (met.restitution == 1 && met.friction == 0 && !met.warms)) return met;
    ++books_->tally.made_elastic;
    return {1, met.warms ? 0 : weight * met.friction, false, true};
}

/// The part that gravity has in the impulse of an elastic bounce off what it presses the disc onto: what it gave since
/// the last hit. The bounces of what lies there add up to its weight, and friction of no more than that takes no energy
/// in no time, so that it cannot jam.
template <class Queue>
double GasRun<Queue>::weight_in_bounce(Slot i, Vec2 gravity, Vec2 normal, double approach) const {
    const double pull = -dot(gravity, normal);
    if (discs_.past.empty() || !(pull > 0)) return 0;
    const double gave = pull * (discs_.disc[i].clock - discs_.past[i].last_hit);
    return gave < 2 * approach ? gave / (2 * approach) : 1;
}

/// With so much more speed than rounding leaves of it a disc that bounces off nothing parts from what it struck. It
/// would else come nearer or not as the last bit says, and what touches it on two sides would strike it for ever.
template <class Queue>
double GasRun<Queue>::beyond_rounding(Slot i) const {
    return discs_.past.empty() ? 0 : 1e-12 * length(discs_.disc[i].v);
}

/// Whether a disc has flown next to nowhere many times in a row; or once so little that the next flight, shorter by the
/// restitution, could be lost in rounding. Discs that touch in a row pass a blow on in no time at all, and may.
template <class Queue>
bool GasRun<Queue>::collapses(Slot i, double approach) {
    constexpr std::uint32_t many = 8;
    GasPast& past = discs_.past[i];
    const double time = discs_.disc[i].clock, r = radius(i) > 0 ? radius(i) : gas_.grid.side.x;
    const double way = approach * (time - past.last_hit), shortest = scene_.options.collapse * r;
    past.short_flights = way < shortest ? past.short_flights + 1 : 0;
    const bool lost = time > past.last_hit && way < next_to_nothing * shortest;
    past.last_hit = time;
    return lost || past.short_flights > many;
}

/// Random numbers are those of a disc's hit, so that they do not depend on what happens elsewhere before it.
template <class Queue>
std::uint64_t GasRun<Queue>::random_seed(Slot i) const {
    const auto seed = static_cast<std::uint64_t>(scene_.options.seed);
    return mixed(mixed(mixed(seed, gas_.made_anew), discs_.event[i].row), discs_.disc[i].hits);
}

/// From a thermal wall come the velocities of a gas at its temperature behind an opening: Maxwell's along the wall, and
/// across it weighted with the speed, v exp(−½ m v²/kT).
template <class Queue>
void GasRun<Queue>::warm_up(Slot i, const GasObstacle& wall, Vec2 normal) {
    GasDisc& d = discs_.disc[i];
    const double m = scene_.bodies.mass[discs_.event[i].row], speed = std::sqrt(wall.temperature / m);
    Random random(random_seed(i));
    const double out = speed * std::sqrt(-2 * portable::log(1 - random.uniform()));
    const Vec2 before = d.v;
    d.v = out * normal + (speed * random.normal()) * perpendicular(normal);
    const Vec2 impulse = m * (d.v - before);
    books_->account[Account::bath] -= 0.5 * dot(impulse, d.v + before);
    books_->account[Giver::walls].add_at(gas_.grid.middle(d) + d.x, impulse);
}

template <class Queue>
void GasRun<Queue>::hit_obstacle(Slot i, std::uint32_t k) {
    const GasObstacle& o = gas_.obstacle[k];
    const std::uint32_t row = discs_.event[i].row;
    GasMeeting again{gas_never, no_slot};
    look_for_obstacles(i, again);
    const double set_off = discs_.disc[i].clock;
    move(i, as_foreseen_now(now_, again.time));
    const double flown = discs_.disc[i].clock - set_off;
    if (o.mover != GasObstacle::no_row) {
        watch_for_wedge(i, o, flown);
        if (!hit_mover(i, k)) foresee(i);
        return;
    }
    GasFlight f = flight(i, o);
    if (!gas_.first_near.empty()) {  // the image that it strikes
        const std::size_t cell = gas_.grid.index(discs_.disc[i].cell);
        double nearest = gas_never;
        for (std::uint32_t n = gas_.first_near[cell]; n < gas_.first_near[cell + 1]; ++n) {
            if (gas_.near[n].obstacle != k) continue;
            const GasFlight other = flight(i, gas_.near[n]);
            const double gap = std::abs(gap_to(o, other));
            if (gap < nearest) nearest = gap, f = other;
        }
    }
    const Vec2 normal = normal_at(o, f);
    const double approach = -dot(f.v, normal), pulled = least_rebound(i, g_, normal);
    const double least = std::max(pulled, beyond_rounding(i));
    if (approach <= 0 && approach > -least) return lift(i, o, normal, approach, least);
    if (approach > 0) {
        const Surfaces met = meeting({o.restitution, o.friction, o.temperature > 0},
                                     {scene_.bodies.restitution[row], scene_.bodies.friction[row]}, approach, i,
                                     no_slot, weight_in_bounce(i, g_, normal, approach));
        if (met.restitution * approach < pulled) ++books_->tally.made_elastic;
        turn_up(i);
        Vec2 velocity = o.v;
        double spin = o.spin;
        Party wall{.v = &velocity, .w = &spin, .radius = o.radius};
        wall.holder = o.row == GasObstacle::no_row ? Giver::walls : Giver::held;
        const Vec2 before = discs_.disc[i].v;
        if (met.warms)
            warm_up(i, o, normal);
        else
            collide(party(i), wall, {-normal, met.restitution, met.friction, least}, books_->account);
        if (o.moves) watch_for_press(i, o, flown);
        if (o.endless || o.hollow)
            books_->tally.wall_impulse += scene_.bodies.mass[row] * dot(discs_.disc[i].v - before, normal);
        ++discs_.disc[i].hits;
        ++books_->tally.wall_collisions;
    }
    note(i);
    foresee(i);
}

/// The speed with which a disc that gravity presses onto something at least leaves it: that of the shortest flight that
/// the rule against collapse knows. What would lie there trembles.
template <class Queue>
double GasRun<Queue>::least_rebound(Slot i, Vec2 gravity, Vec2 normal) const {
    const double pull = -dot(gravity, normal), r = radius(i) > 0 ? radius(i) : gas_.grid.side.x;
    return pull > 0 ? std::sqrt(0.5 * next_to_nothing * scene_.options.collapse * r * pull) : 0;
}

/// A disc that lies on something begins to tremble. The energy is that of an impact which gave some.
template <class Queue>
void GasRun<Queue>::lift(Slot i, const GasObstacle& o, Vec2 normal, double approach, double least) {
    GasDisc& d = discs_.disc[i];
    const double m = scene_.bodies.mass[discs_.event[i].row], gain = least + approach;
    const Vec2 impulse = m * gain * normal;
    books_->account[Account::impact] -= dot(impulse, d.v + 0.5 * gain * normal - o.v);
    books_->account[Account::driven] += dot(impulse, o.v);
    books_->account[o.row == GasObstacle::no_row ? Giver::walls : Giver::held].add_at(gas_.grid.middle(d) + d.x,
                                                                                      impulse);
    d.v += gain * normal;
    ++d.hits;
    ++books_->tally.wall_collisions, ++books_->tally.made_elastic;
    note(i);
    foresee(i);
}

template class GasRun<Calendar>;
template class GasRun<SortedQueue>;

}  // namespace carom
