#pragma once
// Powers to half a per cent, for the length of a step: that is enough, and it is a tenth of the work of pow.

#include "math/bits.hpp"

namespace carom {

/// log₂ of a normal number > 0, off by 0.01 at most: exact at the powers of two, a parabola between them.
constexpr double rough_log2(double x) {
    constexpr std::uint64_t low_bits = (std::uint64_t{1} << 52) - 1;
    const double t = from_bits((to_bits(x) & low_bits) | to_bits(1)) - 1;
    return exponent_of(x) + t * (4 - t) * (1.0 / 3);
}

/// 2^x for |x| < 1000, to 0.35 %: the same.
constexpr double rough_exp2(double x) {
    const int whole = static_cast<int>(x + 1024) - 1024;
    const double t = x - whole;
    return power_of_two(whole) * (1 + t * (2 + t) * (1.0 / 3));
}

}  // namespace carom
