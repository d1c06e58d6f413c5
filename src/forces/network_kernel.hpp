#pragma once
// The text of the network's kernels, compiled once for each instruction set: see simd/lanes.hpp.
//
// Every spring is computed at both of its ends. That costs arithmetic and saves what is dearer: nothing is added into
// a body's force but by itself, so there are no scattered writes, no colours and no locks, and the order of the sum is
// the order of the columns. Both ends see the same length, so their forces are opposite to the last bit.

#include "simd/groups.hpp"
// Behind the lanes: it is to find their functions.
#include "forces/network_text.hpp"

namespace carom {
namespace {

/// Calls work(group, its columns, their end) for all bodies from first to last − 1.
template <class Work>
inline void for_each_group_of(const NetworkLayout& net, size_t first, size_t last, Work work) {
    for_each_group(first, last, net.rows, [&](const Group& g) {
        const uint32_t* chunk = net.first_column + g.row / chunk_rows;
        work(g, net.columns + chunk[0], net.columns + chunk[1]);
    });
}

inline const uint32_t* partner_rows(const NetworkLayout& net, const NetworkColumn& c, const Group& g) {
    return net.partners + chunk_rows * c.partners + g.part;
}
inline Lanes2 at_partners(const NetworkLayout& net, const NetworkColumn& c, const Group& g, const double* xy) {
    if (c.consecutive) return pairs_from(xy + 2 * (c.partners + g.part));
    return pairs(xy, [rows = partner_rows(net, c, g)](int lane) { return rows[lane]; });
}

/// Asks for numbers some chunks before they are wanted: they come in streams, but what the processor foresees by itself
/// ends with a page of 4 kB, and it then waits for memory once a page and longer than it computes. Always inline: g++
/// 12 takes a function that does no more than this for one without effect, and drops the calls.
[[gnu::always_inline]] inline void foresee(const double* values) {
    __builtin_prefetch(values);
    __builtin_prefetch(values + chunk_rows);
}
/// The vectors of a chunk to come, here of that which begins in a row.
[[gnu::always_inline]] inline void foresee_vectors(const double* xy, size_t row) { foresee(xy + 2 * (row + 1024)); }
[[gnu::always_inline]] inline void foresee_parameters(const NetworkLayout& net, const NetworkColumn& c,
                                                      size_t numbers_a_chunk) {
    constexpr size_t chunks_ahead = 8;
    if (!c.uniform) foresee(net.parameters + chunk_rows * c.parameters + chunks_ahead * numbers_a_chunk);
}

inline Lanes parameter(const NetworkLayout& net, const NetworkColumn& c, const Group& g, size_t which) {
    const double* const values = net.parameters + chunk_rows * c.parameters;
    if (c.uniform) return all(values[which]);
    const double* const group = values + chunk_rows * which;
    if (!c.with_partners) return load(group + g.part);
    const size_t place = c.partners % chunk_rows + g.part;
    if (place + lanes <= chunk_rows) return load(group + place);
    if (place >= chunk_rows) return load(group + net.next_chunk + place - chunk_rows);
    const Mask here = all(static_cast<double>(place)) + places() < all(chunk_rows);
    return select(here, load(group + place), load(group + net.next_chunk + place - chunk_rows));
}

/// +1 where the partner has the higher row, −1 where it has the lower one, 0 where a body holds on to itself.
inline Lanes onward(const NetworkLayout& net, const NetworkColumn& c, const Group& g) {
    if (c.consecutive) return all(c.partners + g.part > g.row ? 1 : -1);
    const Lanes own = all(static_cast<double>(g.row)) + places();
    const Lanes partner = whole_numbers(partner_rows(net, c, g));
    return select(partner > own, all(1), all(0)) - select(partner < own, all(1), all(0));
}

/// One column's springs at a group.
[[gnu::always_inline]] inline auto stretched(const NetworkLayout& net, const NetworkColumn& c, const Group& g,
                                             const double* x, Lanes2 own) {
    return stretched(own, at_partners(net, c, g, x), onward(net, c, g), parameter(net, c, g, 0),
                     parameter(net, c, g, 1));
}

/// Keeps what a band's springs to higher rows pull at a group.
inline void keep(const KeptPulls& kept, const Band& band, size_t row, Lanes2 pull) {
    const size_t place = row & band.mask;
    double* const x = kept.pulls + band.begin + place;
    const auto store = [&band, &pull](double* to) {
        __builtin_memcpy(to, &pull.x, sizeof pull.x);
        __builtin_memcpy(to + band.y(), &pull.y, sizeof pull.y);
    };
    store(x);
    if (place < chunk_rows) store(x + band.mask + 1);
}

/// Adds the pull of columns as in a lattice: consecutive, not damped, and of uniform parameters or not. The loop that
/// counts: here it is without questions. Returns the first column that is of another kind.
template <bool uniform>
inline const NetworkColumn* pull_in_line(const NetworkLayout& net, const KeptPulls& kept, const NetworkColumn* column,
                                         const NetworkColumn* end, const Group& g, const double* x, Lanes2 own,
                                         Lanes2& pull) {
    Lanes2 sum = pull;
    for (; column != end && column->consecutive && !column->damped && column->uniform == uniform; ++column) {
        const size_t partner = column->partners + g.part;
        const bool higher = partner > g.row;
        if (column->band != 0 && !higher && partner >= kept.first) {
            const Band& band = net.bands[column->band - 1];
            const double* const there = kept.pulls + band.begin + (partner & band.mask);
            sum.x -= load(there);
            sum.y -= load(there + band.y());
            continue;
        }
        if (!uniform && higher && g.part == 0) foresee_parameters(net, *column, net.next_chunk);
        const double* const shared = net.parameters + chunk_rows * column->parameters;
        const auto number = [&](size_t which) {
            return uniform ? all(shared[which]) : parameter(net, *column, g, which);
        };
        const auto s = stretched(own, pairs_from(x + 2 * partner), all(higher ? 1 : -1), number(0), number(1));
        const Lanes tension = s.stiffness * s.stretch * s.inverse;
        const Lanes2 added{tension * s.d.x, tension * s.d.y};
        sum.x += added.x;
        sum.y += added.y;
        if (higher && column->band != 0 && kept.pulls) keep(kept, net.bands[column->band - 1], g.row, added);
    }
    pull = sum;
    return column;
}

/// Adds the pull of the columns from here on, whatever their kind, and what damps.
inline void pull_on(const NetworkLayout& net, const NetworkColumn* column, const NetworkColumn* end, const Group& g,
                    const double* x, const double* v, Lanes2& pull, Lanes2& drag, Sums& damping) {
    const Lanes2 own = g.of(x), velocity = g.of(v);
    for (; column != end; ++column) {
        const auto s = stretched(net, *column, g, x, own);
        const Lanes tension = s.stiffness * s.stretch * s.inverse;
        pull.x += tension * s.d.x;
        pull.y += tension * s.d.y;
        if (!column->damped) continue;
        const Lanes2 partner = at_partners(net, *column, g, v);
        const Lanes rate = ((partner.x - velocity.x) * s.d.x + (partner.y - velocity.y) * s.d.y) * s.inverse;
        const Lanes damped = parameter(net, *column, g, 2) * rate;
        drag.x += damped * s.inverse * s.d.x;
        drag.y += damped * s.inverse * s.d.y;
        damping.add(g, 0.5 * damped * rate);
    }
}

NetworkPowers forces(const NetworkLayout& net, const KeptPulls& kept, const double* x, const double* v, double* force,
                     size_t first, size_t last) {
    Sums elastic, damping;
    for_each_group_of(net, first, last, [&](const Group& g, const NetworkColumn* column, const NetworkColumn* end) {
        const Lanes2 own = g.of(x), velocity = g.of(v);
        Lanes2 pull{}, drag{};
        const size_t columns = end - column;
        if (g.part == 0) {
            foresee_vectors(v, g.row);
            if (columns > 0 && end[-1].consecutive) foresee_vectors(x, end[-1].partners);
        }
        for (const NetworkColumn* before = nullptr; column != before && column != end;) {
            before = column;
            column = pull_in_line<true>(net, kept, column, end, g, x, own, pull);
            column = pull_in_line<false>(net, kept, column, end, g, x, own, pull);
        }
        if (g.part == 0)
            for (const NetworkColumn* c = column; c != end; ++c) foresee_parameters(net, *c, 2 * chunk_rows * columns);
        if (column != end) pull_on(net, column, end, g, x, v, pull, drag, damping);
        elastic.add(g, pull.x * velocity.x + pull.y * velocity.y);
        store_pairs(force + 2 * (g.row - first), Lanes2{pull.x + drag.x, pull.y + drag.y}, g.count);
    });
    return {elastic.total(), damping.total()};
}

double energy(const NetworkLayout& net, const double* x, size_t first, size_t last) {
    Sums sum;
    for_each_group_of(net, first, last, [&](const Group& g, const NetworkColumn* column, const NetworkColumn* end) {
        const Lanes2 own = g.of(x);
        for (; column != end; ++column) {
            const auto s = stretched(net, *column, g, x, own);
            const Mask held = onward(net, *column, g) != all(0);
            sum.add(g, select(held, all(0.25) * s.stiffness * s.stretch * s.stretch, all(0)));
        }
    });
    return sum.total();
}

/// How often a spring counts at a group's bodies: (a − b)² ≤ 2 a² + 2 b² when both ends move; a² alone when one stands.
inline Lanes shares(const NetworkLayout& net, const NetworkColumn& c, const Group& g, const double* inverse_mass) {
    Lanes mobility;
    for (size_t lane = 0; lane < static_cast<size_t>(lanes); ++lane)
        mobility[lane] = inverse_mass[c.consecutive ? c.partners + g.part + lane : partner_rows(net, c, g)[lane]];
    const Lanes turned = onward(net, c, g);  // 0 for a body that holds on to itself
    return select(mobility == all(0), all(1), all(2)) * turned * turned;
}

void stiffness(const NetworkLayout& net, const double* x, const double* inverse_mass, NodeStiffness* node, size_t first,
               size_t last) {
    for_each_group_of(net, first, last, [&](const Group& g, const NetworkColumn* column, const NetworkColumn* end) {
        const Lanes2 own = g.of(x);
        Lanes xx{}, xy{}, yy{}, damping{};
        for (; column != end; ++column) {
            const auto s = stretched(net, *column, g, x, own);
            const Lanes share = shares(net, *column, g, inverse_mass);
            // Along the spring k; across it k (1 − L/d), which counts only when it stiffens (d > L).
            const Lanes across = select(s.stretch > all(0), s.stiffness * s.stretch * s.inverse, all(0));
            const Lanes along = (s.stiffness - across) * s.inverse * s.inverse;
            xx += share * (along * s.d.x * s.d.x + across);
            xy += share * along * s.d.x * s.d.y;
            yy += share * (along * s.d.y * s.d.y + across);
            if (column->damped) damping += share * parameter(net, *column, g, 2);
        }
        for (size_t k = 0; k < g.count && k < static_cast<size_t>(lanes); ++k)
            node[g.row - first + k] = {xx[k], xy[k], yy[k], 0, damping[k], 0};
    });
}

}  // namespace
}  // namespace carom
