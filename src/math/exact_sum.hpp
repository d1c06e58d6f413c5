#pragma once
// A sum with its rounding error, of numbers or of lanes of them (Knuth, Dekker). This needs -ffp-contract=off. Nothing
// of std: kernels that are compiled for an instruction set include it (simd/lanes.hpp).

namespace carom {
namespace {

/// The unevaluated sum high + low.
template <class Number>
struct Unevaluated {
    Number high, low;
};

/// a + b exactly, in any order of magnitude (six operations).
template <class Number>
constexpr Unevaluated<Number> exact_sum(Number a, Number b) {
    const Number sum = a + b;
    const Number b_part = sum - a;
    const Number a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}

/// a + b exactly where |a| >= |b| or a == 0 (three operations).
template <class Number>
constexpr Unevaluated<Number> exact_sum_of_larger(Number a, Number b) {
    const Number sum = a + b;
    return {sum, b - (sum - a)};
}

}  // namespace
}  // namespace carom
