#pragma once
// Texts for kernels (state/rows_kernel.hpp) that also are for a few bodies, one after the other and without a call
// through a table.

#include "simd/single.hpp"
#include "state/rows.hpp"

namespace carom {
namespace {

/// What nobody wants to know.
struct NoSum {
    template <class G, class Number>
    void add(const G&, Number) {}
    double total() const { return 0; }
};

template <class WrenchSum, class PowerSum, class ForEach>
[[gnu::always_inline]] inline AccelerationSums accelerate_each(const RowArrays& all_rows, double gravity_x,
                                                               double gravity_y, double* force, size_t first,
                                                               ForEach for_each) {
    const bool falls = gravity_x != 0 || gravity_y != 0;
    WrenchSum mass, moment_x, moment_y, force_x, force_y, torque, held_x, held_y, held_torque;
    PowerSum momentum_x, momentum_y, power, held_power;
    for_each([&](const auto& g) {
        const auto x = g.of(all_rows.x), v = g.of(all_rows.v), f = g.in_block(first).of(force);
        const auto m = g.of_numbers(all_rows.mass), inverse = g.of_numbers(all_rows.inverse_mass);
        if (g.part == 0 && g.count > 1024) {
            __builtin_prefetch(all_rows.mass + g.row + 1024);
            __builtin_prefetch(all_rows.inverse_mass + g.row + 1024);
        }
        const decltype(m) zero{};
        const auto free = inverse != zero, bound = inverse == zero;
        // Not (m g) / m: a free body falls with g to the last bit.
        const decltype(f) a{select(free, gravity_x + inverse * f.x, zero),
                            select(free, gravity_y + inverse * f.y, zero)};
        store_pairs(force + 2 * (g.row - first), a, g.count);
        if (falls) {
            mass.add(g, m);
            moment_x.add(g, m * x.x);
            moment_y.add(g, m * x.y);
            momentum_x.add(g, m * v.x);
            momentum_y.add(g, m * v.y);
        }
        if (any(free)) {
            const decltype(f) ma{m * a.x, m * a.y};
            force_x.add(g, ma.x);
            force_y.add(g, ma.y);
            torque.add(g, x.x * ma.y - x.y * ma.x);
            power.add(g, ma.x * v.x + ma.y * v.y);
        }
        if (!any(bound)) return;
        const decltype(f) held{select(bound, f.x, zero), select(bound, f.y, zero)};
        held_x.add(g, held.x);
        held_y.add(g, held.y);
        held_torque.add(g, x.x * held.y - x.y * held.x);
        held_power.add(g, held.x * v.x + held.y * v.y);
    });
    return {mass.total(),    moment_x.total(),    moment_y.total(),  momentum_x.total(), momentum_y.total(),
            force_x.total(), force_y.total(),     torque.total(),    power.total(),      held_x.total(),
            held_y.total(),  held_torque.total(), held_power.total()};
}
template <class WrenchSum, class PowerSum>
[[gnu::always_inline]] inline AccelerationSums accelerate_few(const RowArrays& all_rows, double gravity_x,
                                                              double gravity_y, double* force, size_t first,
                                                              size_t last) {
    return accelerate_each<WrenchSum, PowerSum>(all_rows, gravity_x, gravity_y, force, first,
                                                [=](auto work) { for_each_single(first, last, work); });
}

template <class Number>
inline Number load_numbers(const double* from) {
    Number out;
    __builtin_memcpy(&out, from, sizeof out);
    return out;
}
/// Blocks of sums in lanes or singly, which stay in registers while all terms are added to them.
template <class Number, size_t block>
[[gnu::always_inline]] inline void combine_blocks(const Term* terms, size_t count, const double* start, double* out,
                                                  size_t numbers, size_t& i) {
    constexpr size_t width = sizeof(Number) / sizeof(double);
    for (; i + block * width <= numbers; i += block * width) {
        Number total[block] = {};
        for (size_t j = 0; j < count; ++j)
            for (size_t k = 0; k < block; ++k)
                total[k] += terms[j].weight * load_numbers<Number>(terms[j].in + i + k * width);
        for (size_t k = 0; k < block; ++k) {
            if (start) total[k] = load_numbers<Number>(start + i + k * width) + total[k];
            __builtin_memcpy(out + i + k * width, &total[k], sizeof total[k]);
        }
    }
}
[[gnu::always_inline]] inline void combine_few(const Term* terms, size_t count, const double* start, double* out,
                                               size_t numbers) {
    size_t i = 0;
    combine_blocks<Two, 2>(terms, count, start, out, numbers, i);
    combine_blocks<Two, 1>(terms, count, start, out, numbers, i);
    combine_blocks<double, 1>(terms, count, start, out, numbers, i);
}

/// The largest |e| / (tolerance max(1, |a|, |b|)), and a sum that is 0 if all of them are finite: a maximum says
/// nothing of what is not a number.
template <class Number>
[[gnu::always_inline]] inline void compare_blocks(const double* e, const double* a, const double* b, double tolerance,
                                                  size_t numbers, size_t& i, double& most, double& rest) {
    constexpr size_t width = sizeof(Number) / sizeof(double);
    if (i + width > numbers) return;
    const auto size = [](Number x) { return x < Number{} ? -x : x; };
    const auto larger = [](Number x, Number y) { return x < y ? y : x; };
    Number worst{}, odd{};
    for (; i + width <= numbers; i += width) {
        const Number at = size(load_numbers<Number>(a + i)), to = size(load_numbers<Number>(b + i));
        const Number allowed = tolerance * larger(larger(at, to), Number{} + 1);
        const Number ratio = size(load_numbers<Number>(e + i)) / allowed;
        worst = larger(worst, ratio);
        odd += ratio - ratio;
    }
    double of_each[2][width];
    __builtin_memcpy(of_each[0], &worst, sizeof worst);
    __builtin_memcpy(of_each[1], &odd, sizeof odd);
    for (size_t k = 0; k < width; ++k) {
        most = most < of_each[0][k] ? of_each[0][k] : most;
        rest += of_each[1][k];
    }
}
[[gnu::always_inline]] inline double largest_of_few(const double* e, const double* a, const double* b, double tolerance,
                                                    size_t numbers) {
    size_t i = 0;
    double most = 0, rest = 0;
    compare_blocks<Two>(e, a, b, tolerance, numbers, i, most, rest);
    compare_blocks<double>(e, a, b, tolerance, numbers, i, most, rest);
    return rest == 0 ? most : __builtin_inf();
}

}  // namespace
}  // namespace carom
