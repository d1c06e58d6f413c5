#pragma once
// The text of the kernels in state/rows.hpp, compiled once for each instruction set.

#include "simd/groups.hpp"
#include "state/rows_text.hpp"

namespace carom {
namespace {

/// The same sum where bodies are few, and are gone through one by one.
template <class SumOf>
struct OfFew {
    using Sum = SumOf;
};
template <>
struct OfFew<Sums> {
    using Sum = SingleSum;
};

template <class SumOf>
AccelerationSums accelerate(const RowArrays& all_rows, double gravity_x, double gravity_y, double* force, size_t first,
                            size_t last) {
    using FewSum = typename OfFew<SumOf>::Sum;
    if (are_few(all_rows.rows))
        return accelerate_few<FewSum, FewSum>(all_rows, gravity_x, gravity_y, force, first, last);
    return accelerate_each<SumOf, SumOf>(all_rows, gravity_x, gravity_y, force, first,
                                         [&](auto work) { for_each_group(first, last, all_rows.rows, work); });
}

/// Gathers the exponents of numbers: is any of them that of infinity and nan?
struct Exponents {
    uint64_t carried = 0;  // into the sign, where all bits of the exponent are set
    Mask of_lanes = {};

    template <class Bits>
    static Bits carry(Bits bits) {
        constexpr int64_t exponent = 0x7ff0000000000000, one = 0x0010000000000000;
        return (bits & exponent) + one;
    }
    void add(const double* number) { carried |= carry(load_as<uint64_t>(number)); }
    void add(Lanes numbers) { of_lanes |= carry((Mask)numbers); }
    void add(double number) { add(&number); }
    bool finite() const { return carried >> 63 == 0 && !any(of_lanes < Mask{}); }
};

template <class SumOf, class ForEach>
inline KickSums kick_each(const RowArrays& all_rows, double h, const double* acceleration, double* velocity,
                          size_t first, ForEach for_each) {
    SumOf momentum_x, momentum_y, angular, energy;
    Exponents found;
    for_each([&](const auto& g) {
        const auto x = g.of(all_rows.x), v = g.of(velocity), a = g.in_block(first).of(acceleration);
        const auto m = g.of_numbers(all_rows.mass);
        const decltype(g.of(velocity)) dv{h * a.x, h * a.y}, gain{m * dv.x, m * dv.y};
        const decltype(g.of(velocity)) after{v.x + dv.x, v.y + dv.y};
        store_pairs(velocity + 2 * g.row, after, g.count);
        found.add(after.x);
        found.add(after.y);
        momentum_x.add(g, gain.x);
        momentum_y.add(g, gain.y);
        angular.add(g, x.x * gain.y - x.y * gain.x);
        energy.add(g, gain.x * (v.x + 0.5 * dv.x) + gain.y * (v.y + 0.5 * dv.y));
    });
    return {momentum_x.total(), momentum_y.total(), angular.total(), energy.total(), found.finite()};
}
KickSums kick(const RowArrays& all_rows, double h, const double* acceleration, double* velocity, size_t first,
              size_t last) {
    if (are_few(all_rows.rows))
        return kick_each<SingleSum>(all_rows, h, acceleration, velocity, first,
                                    [=](auto work) { for_each_single(first, last, work); });
    return kick_each<Sums>(all_rows, h, acceleration, velocity, first,
                           [&](auto work) { for_each_group(first, last, all_rows.rows, work); });
}

bool drift(double h, const double* v, double* x, size_t numbers) {
    Exponents found;
    for (size_t k = 0; k < numbers; ++k) {
        x[k] += h * v[k];
        found.add(x + k);
    }
    return found.finite();
}

void combine(const Term* terms, size_t count, const double* start, double* out, size_t numbers) {
    size_t i = 0;
    combine_blocks<Lanes, 4>(terms, count, start, out, numbers, i);
    combine_blocks<Lanes, 1>(terms, count, start, out, numbers, i);
    combine_blocks<double, 4>(terms, count, start, out, numbers, i);
    combine_blocks<double, 1>(terms, count, start, out, numbers, i);
}

double largest(const double* e, const double* a, const double* b, double tolerance, size_t numbers) {
    size_t i = 0;
    double most = 0, rest = 0;
    compare_blocks<Lanes>(e, a, b, tolerance, numbers, i, most, rest);
    compare_blocks<double>(e, a, b, tolerance, numbers, i, most, rest);
    return rest == 0 ? most : __builtin_inf();
}

bool finite(const double* number, size_t numbers) {
    Exponents found;
    for (size_t k = 0; k < numbers; ++k) found.add(number + k);
    return found.finite();
}

bool zero(const double* number, size_t numbers) {
    uint64_t found = 0;
    for (size_t k = 0; k < numbers; k += chunk_rows) {
        __builtin_prefetch(number + k + numbers);
        for (size_t j = k; j < numbers && j < k + chunk_rows; ++j) found |= load_as<uint64_t>(number + j) << 1;
    }
    return found == 0;
}

}  // namespace
}  // namespace carom
