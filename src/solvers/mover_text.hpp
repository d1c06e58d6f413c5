#pragma once
// The text of the kernels in solvers/mover_rows.hpp, for groups of rows and for one. Who includes it for groups has
// said before what `sine_and_cosine` of lanes is.

#include "math/elementary.hpp"
#include "simd/single.hpp"
#include "solvers/mover_rows.hpp"

namespace carom {
namespace {

inline Single2 sine_and_cosine(double angle) {
    const portable::SinCos turned = portable::sincos(angle);
    return {turned.sin, turned.cos};
}

template <class G>
using FoursOf = decltype(G{}.of_fours(nullptr));
template <class G>
using PairsOf = decltype(G{}.of(nullptr));

template <class G>
inline void put_frame(const MoverRows& m, const G& g, const decltype(g.of(m.x))& x,
                      const decltype(g.of_numbers(m.angle))& angle) {
    const auto turned = sine_and_cosine(angle);
    store_fours(m.frames + 4 * g.row, FoursOf<G>{x.x, x.y, turned.y, turned.x}, g.count);
}

template <class G>
inline void place(const MoverRows& m, const G& g, const double* inverse_mass) {
    put_frame(m, g, g.of(m.x), g.of_numbers(m.angle));
    const auto of_each = g.of_numbers(inverse_mass);
    const decltype(g.of_numbers(inverse_mass)) zero{};
    store_fours(m.movers + 4 * g.row, FoursOf<G>{zero, zero, zero, of_each}, g.count);
}

template <class G>
inline void take_drift(const MoverRows& m, const G& g, double h, double share) {
    auto x = g.of(m.x);
    auto angle = g.of_numbers(m.angle);
    const auto x0 = g.of(m.start.x);
    const auto angle0 = g.of_numbers(m.start.angle);
    if (const auto asleep = g.flagged(m.asleep); any(asleep)) {
        const decltype(angle) zero{};
        const auto v = g.of(m.v);
        x = {select(asleep, x0.x, x.x), select(asleep, x0.y, x.y)}, angle = select(asleep, angle0, angle);
        store_pairs(m.x + 2 * g.row, x, g.count), store_numbers(m.angle + g.row, angle, g.count);
        store_pairs(m.v + 2 * g.row, PairsOf<G>{select(asleep, zero, v.x), select(asleep, zero, v.y)}, g.count);
        store_numbers(m.turning + g.row, select(asleep, zero, g.of_numbers(m.turning)), g.count);
    }
    const double rate = 1 / h;
    auto now = g.of_fours(m.movers);
    now.x = rate * (x.x - x0.x), now.y = rate * (x.y - x0.y), now.z = rate * (angle - angle0);
    store_fours(m.before + 4 * g.row, now, g.count);
    if (m.gives_again) {
        const auto given = g.of_fours(m.given);
        now.x += share * given.x, now.y += share * given.y, now.z += share * given.z;
    }
    store_fours(m.movers + 4 * g.row, now, g.count);
    const decltype(angle) none{};
    if (m.leads) store_fours(m.leads + 4 * g.row, FoursOf<G>{none, none, none, now.w}, g.count);
}

template <class G>
inline void drift(const MoverRows& m, const G& g, double h) {
    const auto carried = g.flagged(m.carried);
    if (every(carried)) return;
    const auto now = g.of_fours(m.movers), before = g.of_fours(m.before);
    auto x = g.of(m.x);
    auto angle = g.of_numbers(m.angle);
    x.x = select(carried, x.x, x.x + h * (now.x - before.x));
    x.y = select(carried, x.y, x.y + h * (now.y - before.y));
    angle = select(carried, angle, angle + h * (now.z - before.z));
    store_pairs(m.x + 2 * g.row, x, g.count), store_numbers(m.angle + g.row, angle, g.count);
    put_frame(m, g, x, angle);
}

template <class G>
inline void kick(const MoverRows& m, const G& g, double share) {
    const auto carried = g.flagged(m.carried);
    if (every(carried)) return;
    const auto was = g.of_fours(m.movers), before = g.of_fours(m.before);
    const auto v = g.of(m.v), proposed = g.of(m.proposed.v);
    const auto turning = g.of_numbers(m.turning), proposed_turning = g.of_numbers(m.proposed.turning);
    auto now = was;
    now.x = v.x + (was.x - before.x), now.y = v.y + (was.y - before.y), now.z = turning + (was.z - before.z);
    if (m.gives_again) {
        const auto given = g.of_fours(m.given);
        now.x += share * given.x, now.y += share * given.y, now.z += share * given.z;
    }
    const auto put = [&](double* to, const decltype(now)& old, const decltype(now)& a) {
        store_fours(
            to + 4 * g.row,
            FoursOf<G>{select(carried, old.x, a.x), select(carried, old.y, a.y), select(carried, old.z, a.z), old.w},
            g.count);
    };
    put(m.movers, was, now);
    put(m.before, before, FoursOf<G>{proposed.x, proposed.y, proposed_turning, before.w});
}

template <class G>
inline void take_velocities(const MoverRows& m, const G& g) {
    const auto now = g.of_fours(m.movers), before = g.of_fours(m.before);
    const decltype(now.x) zero{};
    const auto asleep = g.flagged(m.asleep);
    const auto held = now.w == zero;
    const auto start = g.of(m.start.v), v = g.of(m.v);
    const auto start_turning = g.of_numbers(m.start.turning), turning = g.of_numbers(m.turning);
    const auto gained = [&](auto a, auto b) { return select(asleep, zero, a - b); };
    FoursOf<G> given{gained(now.x, before.x), gained(now.y, before.y), gained(now.z, before.z), now.w};
    if (m.leads) {
        const auto lead = g.of_fours(m.leads);
        given.x += lead.x, given.y += lead.y, given.z += lead.z;
    }
    store_fours(m.given + 4 * g.row, given, g.count);
    store_fours(m.before + 4 * g.row, FoursOf<G>{start.x, start.y, start_turning, before.w}, g.count);
    store_fours(m.means + 4 * g.row,
                FoursOf<G>{0.5 * (start.x + now.x), 0.5 * (start.y + now.y), 0.5 * (start_turning + now.z), now.w},
                g.count);
    store_pairs(m.v + 2 * g.row, PairsOf<G>{select(held, v.x, now.x), select(held, v.y, now.y)}, g.count);
    store_numbers(m.turning + g.row, select(held, turning, now.z), g.count);
}

template <class Sum, class ForEach>
inline MoverSums sum_each(const MoverRows& m, const double* mass, const double* inertia, ForEach for_each) {
    Sum work, momentum_x, momentum_y, angular;
    for_each([&](const auto& g) {
        const auto inverse_mass = g.of_fours(m.movers).w;
        const decltype(g.of_numbers(mass)) zero{};
        const auto moves = inverse_mass != zero;
        const auto of_mass = select(moves, g.of_numbers(mass), zero);
        const auto of_inertia = select(moves, g.of_numbers(inertia), zero);
        const auto x = g.of(m.proposed.x), x1 = g.of(m.x), v = g.of(m.proposed.v), v1 = g.of(m.v);
        const auto start = g.of(m.start.v);
        const decltype(g.of(m.x)) dx{x1.x - x.x, x1.y - x.y}, dv{v1.x - v.x, v1.y - v.y};
        const decltype(g.of(m.x)) mid{x.x + 0.5 * dx.x, x.y + 0.5 * dx.y}, mean{v.x + 0.5 * dv.x, v.y + 0.5 * dv.y};
        const auto w = g.of_numbers(m.proposed.turning), dw = g.of_numbers(m.turning) - w;
        work.add(g, 0.5 * of_mass * (dv.x * (v.x - start.x) + dv.y * (v.y - start.y)) +
                        0.5 * of_inertia * dw * (w - g.of_numbers(m.start.turning)));
        momentum_x.add(g, of_mass * dv.x);
        momentum_y.add(g, of_mass * dv.y);
        angular.add(g, of_mass * ((mid.x * dv.y - mid.y * dv.x) + (dx.x * mean.y - dx.y * mean.x)) + of_inertia * dw);
    });
    return {work.total(), momentum_x.total(), momentum_y.total(), angular.total()};
}

}  // namespace
}  // namespace carom
