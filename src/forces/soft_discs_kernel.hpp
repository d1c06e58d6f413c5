#pragma once
// The text of the kernels of soft discs, compiled once for each instruction set: see simd/lanes.hpp. Every pair is
// computed at both of its discs, which sum their own forces in the order of their neighbours' rows; neighbours that do
// not touch add nothing. So the bits depend neither on lanes and threads nor on when neighbours were looked for.

#include "forces/soft_discs_layout.hpp"
#include "simd/groups.hpp"

namespace carom {
namespace {

/// The number nearest to a, for |a| < 2⁵¹.
inline Lanes rounded(Lanes a) {
    constexpr double shift = 6755399441055744;  // 1.5 · 2⁵²: beyond it there are no fractions
    return (a + all(shift)) - all(shift);
}

/// A pair of discs in each lane.
struct Overlap {
    Mask touching;
    Lanes2 d;        ///< to the neighbour
    Lanes distance;  ///< 1 where they do not touch
    Lanes depth;
};

inline Overlap overlap(const SoftLayout& soft, const uint32_t* neighbour, const double* x, Lanes2 own, Lanes radius) {
    const Lanes2 other = pairs(x, [neighbour](int lane) { return neighbour[lane]; });
    Lanes2 d{other.x - own.x, other.y - own.y};
    d.x -= all(soft.width) * rounded(d.x * all(soft.inverse_width));
    d.y -= all(soft.height) * rounded(d.y * all(soft.inverse_height));
    const Lanes squared = d.x * d.x + d.y * d.y, reach = radius + numbers(soft.radius, neighbour);
    // Two centres in one point have no direction to part in: by symmetry there is no force.
    const Mask touching = (squared < reach * reach) & (squared > all(0));
    const Lanes distance = square_root(select(touching, squared, all(1)));
    return {touching, d, distance, select(touching, reach - distance, all(0))};
}

/// Calls work(group, its place in the columns' neighbours, how many columns).
template <class Work>
inline void for_each_crowd(const SoftLayout& soft, size_t first, size_t last, Work work) {
    for_each_group(first, last, soft.rows, [&](const Group& g) {
        const uint32_t* chunk = soft.first_column + g.row / chunk_rows;
        const size_t columns = chunk[1] - chunk[0];
        work(g, columns > 0 ? soft.neighbours + chunk_rows * chunk[0] + g.part : nullptr, columns);
    });
}

SoftPowers forces(const SoftLayout& soft, const double* x, const double* v, double* force, size_t first, size_t last) {
    Sums elastic, damping;
    for_each_crowd(soft, first, last, [&](const Group& g, const uint32_t* neighbour, size_t columns) {
        const Lanes2 own = g.of(x), velocity = g.of(v);
        const Lanes radius = g.of_numbers(soft.radius), inverse_mass = g.of_numbers(soft.inverse_mass);
        Lanes2 push{}, drag{};
        for (; columns > 0; --columns, neighbour += chunk_rows) {
            const Overlap pair = overlap(soft, neighbour, x, own, radius);
            if (!any(pair.touching)) continue;
            const Lanes pressure = all(soft.stiffness) * pair.depth / pair.distance;
            push.x -= pressure * pair.d.x;
            push.y -= pressure * pair.d.y;
            if (soft.damping == 0) continue;
            const Lanes2 other = pairs(v, [neighbour](int lane) { return neighbour[lane]; });
            const Lanes rate = ((other.x - velocity.x) * pair.d.x + (other.y - velocity.y) * pair.d.y) / pair.distance;
            const Lanes mobility = inverse_mass + numbers(soft.inverse_mass, neighbour);
            const Mask damped = pair.touching & (mobility > all(0));
            const Lanes pull = select(damped, all(soft.damping) / select(damped, mobility, all(1)) * rate, all(0));
            drag.x += pull / pair.distance * pair.d.x;
            drag.y += pull / pair.distance * pair.d.y;
            damping.add(g, all(0.5) * pull * rate);
        }
        elastic.add(g, push.x * velocity.x + push.y * velocity.y);
        double* on = force + 2 * (g.row - first);
        const Lanes2 before = g.in_block(first).of(force);
        store_pairs(on, {before.x + (push.x + drag.x), before.y + (push.y + drag.y)}, g.count);
    });
    return {elastic.total(), damping.total()};
}

double energy(const SoftLayout& soft, const double* x, size_t first, size_t last) {
    Sums sum;
    for_each_crowd(soft, first, last, [&](const Group& g, const uint32_t* neighbour, size_t columns) {
        const Lanes2 own = g.of(x);
        const Lanes radius = g.of_numbers(soft.radius);
        for (; columns > 0; --columns, neighbour += chunk_rows) {
            const Overlap pair = overlap(soft, neighbour, x, own, radius);
            sum.add(g, all(0.25 * soft.stiffness) * pair.depth * pair.depth);
        }
    });
    return sum.total();
}

double farthest(const double* x, const double* was, size_t rows) {
    Lanes most{};
    for_each_group(0, rows, rows, [&](const Group& g) {
        const Lanes2 now = g.of(x), then = g.of(was);
        const Lanes dx = now.x - then.x, dy = now.y - then.y, squared = dx * dx + dy * dy;
        most = select(squared > most, squared, most);
    });
    double largest = 0;
    for (int lane = 0; lane < lanes; ++lane) largest = most[lane] > largest ? most[lane] : largest;
    return largest;
}

}  // namespace
}  // namespace carom
