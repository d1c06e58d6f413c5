#pragma once
// What the elementary functions and the root finder do with double-doubles (Dekker 1971; Hida, Li, Bailey 2001).

#include <cmath>

#include "math/compensated.hpp"

namespace carom {

constexpr DoubleDouble add(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble sum = two_sum(a.high, b.high);
    return fast_two_sum(sum.high, sum.low + (a.low + b.low));
}

constexpr DoubleDouble subtract(DoubleDouble a, DoubleDouble b) { return add(a, {-b.high, -b.low}); }

/// a / b to some 100 bits, by one step of long division.
constexpr DoubleDouble divide(DoubleDouble a, DoubleDouble b) {
    const double quotient = a.high / b.high;
    const DoubleDouble back = two_product(quotient, b.high);
    const double rest = (((a.high - back.high) - back.low) + a.low) - quotient * b.low;
    return fast_two_sum(quotient, rest / b.high);
}

/// The square root to some 100 bits, by one Newton step.
inline DoubleDouble square_root(DoubleDouble a) {
    if (a.high == 0) return {};
    const double root = std::sqrt(a.high);
    const DoubleDouble square = two_product(root, root);
    return fast_two_sum(root, (((a.high - square.high) - square.low) + a.low) / (2 * root));
}

}  // namespace carom
