#pragma once
// Sums and products with their rounding errors kept (Dekker 1971, Knuth, Neumaier 1974). Only + - *, so that the bits
// are the same on every machine; this needs -ffp-contract=off and no fast-math.

#include <cmath>

#include "math/exact_sum.hpp"

namespace carom {

/// The unevaluated sum high + low, |low| <= ulp(high) / 2 once normalised: some 106 bits.
struct DoubleDouble {
    double high = 0, low = 0;

    constexpr double value() const { return high + low; }
};

/// a + b exactly, in any order of magnitude.
constexpr DoubleDouble two_sum(double a, double b) {
    const auto sum = exact_sum(a, b);
    return {sum.high, sum.low};
}

/// a + b exactly where |a| >= |b| or a == 0.
constexpr DoubleDouble fast_two_sum(double a, double b) {
    const auto sum = exact_sum_of_larger(a, b);
    return {sum.high, sum.low};
}

/// a in two halves of 26 bits each (Veltkamp). Overflows for |a| > 2^996.
constexpr DoubleDouble split(double a) {
    const double c = 0x8000001p0 * a;
    const double high = c - (c - a);
    return {high, a - high};
}

/// a b exactly, without fma: 2^-969 < |a b| or zero, |a|, |b| < 2^996.
constexpr DoubleDouble two_product(double a, double b) {
    const double product = a * b;
    const DoubleDouble x = split(a), y = split(b);
    return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

/// A running sum whose error does not grow with the number of terms (Neumaier's form of Kahan's sum: it also keeps the
/// small sum when a large term arrives). A sum that has overflowed, or met an infinity, stays what IEEE makes of it.
class CompensatedSum {
  public:
    constexpr CompensatedSum() = default;
    constexpr explicit CompensatedSum(double start) : sum_(start) {}

    constexpr void add(double term) {
        const DoubleDouble next = two_sum(sum_, term);
        sum_ = next.high;
        lost_ += next.low;
    }
    constexpr CompensatedSum& operator+=(double term) { return add(term), *this; }

    double value() const {
        const double corrected = sum_ + lost_;
        return std::isfinite(sum_) ? corrected : sum_;  // the error of an infinite sum is NaN
    }

  private:
    double sum_ = 0, lost_ = 0;
};

}  // namespace carom
