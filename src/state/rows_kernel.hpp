#pragma once
// The text of the kernels in state/rows.hpp, compiled once for each instruction set.

#include "simd/groups.hpp"
#include "state/rows.hpp"

namespace carom {
namespace {

template <class SumOf, class ForEach>
AccelerationSums accelerate(const RowArrays& all_rows, double gravity_x, double gravity_y, double* force, size_t first,
                            ForEach for_each) {
    const bool falls = gravity_x != 0 || gravity_y != 0;
    SumOf mass, moment_x, moment_y, momentum_x, momentum_y, force_x, force_y, torque, power;
    SumOf held_x, held_y, held_torque, held_power;
    for_each([&](const auto& g) {
        const auto x = g.of(all_rows.x), v = g.of(all_rows.v), f = g.in_block(first).of(force);
        const auto m = g.of_numbers(all_rows.mass), inverse = g.of_numbers(all_rows.inverse_mass);
        if (g.part == 0 && g.count > 1024) {
            __builtin_prefetch(all_rows.mass + g.row + 1024);
            __builtin_prefetch(all_rows.inverse_mass + g.row + 1024);
        }
        const decltype(m) zero{};
        const auto free = inverse != zero;
        // Not (m g) / m: a free body falls with g to the last bit.
        const decltype(f) a{select(free, gravity_x + inverse * f.x, zero),
                            select(free, gravity_y + inverse * f.y, zero)};
        const decltype(f) held{select(free, zero, f.x), select(free, zero, f.y)}, ma{m * a.x, m * a.y};
        store_pairs(force + 2 * (g.row - first), a, g.count);
        if (falls) {
            mass.add(g, m);
            moment_x.add(g, m * x.x);
            moment_y.add(g, m * x.y);
            momentum_x.add(g, m * v.x);
            momentum_y.add(g, m * v.y);
        }
        force_x.add(g, ma.x);
        force_y.add(g, ma.y);
        torque.add(g, x.x * ma.y - x.y * ma.x);
        power.add(g, ma.x * v.x + ma.y * v.y);
        held_x.add(g, held.x);
        held_y.add(g, held.y);
        held_torque.add(g, x.x * held.y - x.y * held.x);
        held_power.add(g, held.x * v.x + held.y * v.y);
    });
    return {mass.total(),    moment_x.total(),    moment_y.total(),  momentum_x.total(), momentum_y.total(),
            force_x.total(), force_y.total(),     torque.total(),    power.total(),      held_x.total(),
            held_y.total(),  held_torque.total(), held_power.total()};
}
AccelerationSums accelerate(const RowArrays& all_rows, double gravity_x, double gravity_y, double* force, size_t first,
                            size_t last) {
    if (are_few(all_rows.rows))
        return accelerate<SingleSum>(all_rows, gravity_x, gravity_y, force, first,
                                     [=](auto work) { for_each_single(first, last, work); });
    return accelerate<Sums>(all_rows, gravity_x, gravity_y, force, first,
                            [&](auto work) { for_each_group(first, last, all_rows.rows, work); });
}

KickSums kick(const RowArrays& all_rows, double h, const double* acceleration, double* velocity, size_t first,
              size_t last) {
    Sums momentum_x, momentum_y, angular, energy;
    for_each_group(first, last, all_rows.rows, [&](const Group& g) {
        const Lanes2 x = g.of(all_rows.x), v = g.of(velocity), a = g.in_block(first).of(acceleration);
        const Lanes m = g.of_numbers(all_rows.mass);
        const Lanes2 dv{all(h) * a.x, all(h) * a.y}, gain{m * dv.x, m * dv.y};
        store_pairs(velocity + 2 * g.row, Lanes2{v.x + dv.x, v.y + dv.y}, g.count);
        momentum_x.add(g, gain.x);
        momentum_y.add(g, gain.y);
        angular.add(g, x.x * gain.y - x.y * gain.x);
        energy.add(g, gain.x * (v.x + all(0.5) * dv.x) + gain.y * (v.y + all(0.5) * dv.y));
    });
    return {momentum_x.total(), momentum_y.total(), angular.total(), energy.total()};
}

void drift(double h, const double* v, double* x, size_t numbers) {
    for (size_t k = 0; k < numbers; ++k) x[k] += h * v[k];
}

/// Blocks of sums in lanes or singly, which stay in registers while all terms are added to them.
template <class Number, size_t block>
void combine_blocks(const Term* terms, size_t count, const double* start, double* out, size_t numbers, size_t& i) {
    constexpr size_t width = sizeof(Number) / sizeof(double);
    for (; i + block * width <= numbers; i += block * width) {
        Number total[block] = {};
        for (size_t j = 0; j < count; ++j)
            for (size_t k = 0; k < block; ++k)
                total[k] += terms[j].weight * load_as<Number>(terms[j].in + i + k * width);
        for (size_t k = 0; k < block; ++k) {
            if (start) total[k] = load_as<Number>(start + i + k * width) + total[k];
            __builtin_memcpy(out + i + k * width, &total[k], sizeof total[k]);
        }
    }
}
void combine(const Term* terms, size_t count, const double* start, double* out, size_t numbers) {
    size_t i = 0;
    combine_blocks<Lanes, 4>(terms, count, start, out, numbers, i);
    combine_blocks<Lanes, 1>(terms, count, start, out, numbers, i);
    combine_blocks<double, 4>(terms, count, start, out, numbers, i);
    combine_blocks<double, 1>(terms, count, start, out, numbers, i);
}

bool finite(const double* number, size_t numbers) {
    constexpr uint64_t exponent = 0x7ff0000000000000, one = 0x0010000000000000;
    uint64_t carried = 0;  // into the sign, where all bits of the exponent are set
    for (size_t k = 0; k < numbers; ++k) carried |= (load_as<uint64_t>(number + k) & exponent) + one;
    return carried >> 63 == 0;
}

}  // namespace
}  // namespace carom
