#pragma once
// What sine and cosine consist of, for numbers or lanes of them. Methods: Cody and Waite, "Software Manual for the
// Elementary Functions" (1980), for the reduction of the argument; minimax polynomials on [-pi/4, pi/4] as in fdlibm
// (coefficients by Remez exchange, computed for Carom). Nothing of std: see exact_sum.hpp.

#include "math/exact_sum.hpp"

namespace carom::portable {
namespace {

constexpr double quarter_pi = 0x1.921fb54442d18p-1;
constexpr double most_cody_waite = 0x1p20;  ///< it reduces |x| up to here

/// An angle less a multiple of pi/2.
template <class Number>
struct ReducedAngle {
    Unevaluated<Number> rest;  ///< in [-pi/4, pi/4], but for a rounding error
    Number multiple;           ///< of pi/2, with the lowest bits of the mantissa those of the multiple as an integer
};

/// pi/2 comes in three parts of 33 bits, whose products with the multiple are exact, and a tail.
template <class Number>
inline ReducedAngle<Number> reduce_cody_waite(Number x) {
    constexpr double to_integer = 0x1.8p52;  // adding and taking away rounds to the nearest integer
    const Number multiple = x * 0x1.45f306dc9c883p-1 + to_integer;
    const Number n = multiple - to_integer;
    const Number first = x - n * 0x1.921fb54400000p+0;  // exact
    const auto second = exact_sum(first, -n * 0x1.0b4611a600000p-34);
    const auto third = exact_sum(second.high, -n * 0x1.3198a2e000000p-69);
    const Number tail = second.low + third.low - n * 0x1.b839a252049c1p-104;
    return {exact_sum_of_larger(third.high, tail), multiple};
}

/// sin(x.high + x.low) on [-pi/4, pi/4], as a sum not yet rounded; error of the polynomial 2^-57.8.
template <class Number>
inline Unevaluated<Number> sine_of_rest(Number x, Number low) {
    const Number z = x * x;
    const Number w = z * z;
    const Number p = (0x1.111111110f730p-7 + z * -0x1.a01a019be920cp-13) +
                     w * ((0x1.71de35552a63cp-19 + z * -0x1.ae5e4b830f28ap-26) + w * 0x1.5d8b555645323p-33);
    const Number cubic = z * x * (-0x1.5555555555548p-3 + z * p);
    return {x, cubic + low * (1.0 - 0.5 * z)};
}

/// cos(x.high + x.low) likewise; error of the polynomial 2^-63.9.
template <class Number>
inline Unevaluated<Number> cosine_of_rest(Number x, Number low) {
    const Number z = x * x;
    const Number w = z * z;
    const Number p = (0x1.555555555554bp-5 + z * -0x1.6c16c16c15013p-10) +
                     w * ((0x1.a01a019c8ed03p-16 + z * -0x1.27e4f7f140b75p-22) +
                          w * (0x1.1ee9db8de2652p-29 + z * -0x1.8fa65e647ad07p-37));
    const Number half = 0.5 * z;
    const Number high = 1.0 - half;
    return {high, ((1.0 - high) - half) + (w * p - x * low)};
}

}  // namespace
}  // namespace carom::portable
