// exp, log, pow, the hyperbolic functions and hypot.
// Method: Tang, "Table-driven implementation of the exponential function in IEEE floating-point arithmetic" (1989) and
// "... of the logarithm function ..." (1990), carried in double-doubles (compensated.hpp) so that one rounding is left.

#include "math/elementary.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "math/bits.hpp"
#include "math/double_double.hpp"
#include "math/elementary_tables.hpp"

namespace carom::portable {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double to_integer = 0x1.8p52;  // adding and taking away rounds to the nearest integer

/// fraction 2^exponent, the fraction in [1/2, 2].
struct Scaled {
    DoubleDouble fraction;
    int exponent;

    /// Exact for exponents as small as those that sinh, cosh and tanh use it with.
    DoubleDouble unscaled() const {
        const double scale = power_of_two(exponent);
        return {fraction.high * scale, fraction.low * scale};
    }
    /// Rounded; to infinity or into the subnormal numbers at the ends of the range.
    double value() const {
        const double rounded = fraction.value();
        if (exponent > 1023) return rounded * 0x1p1023 * power_of_two(exponent - 1023);
        if (exponent < -1022) return rounded * power_of_two(exponent + 1000) * 0x1p-1000;
        return rounded * power_of_two(exponent);
    }
};

/// e^(x.high + x.low) for |x| < 750, to some 61 bits: x = (64 exponent + j) ln2/64 + r, |r| <= ln2/128.
Scaled exponential(DoubleDouble x) {
    const double n = (x.high * 0x1.71547652b82fep+6 + to_integer) - to_integer;
    const double first = x.high - n * 0x1.62e42fefa0000p-7;  // exact: 36 bits times 17
    const DoubleDouble second = two_sum(first, -n * 0x1.cf79abc9e3b3ap-46);
    const DoubleDouble r = two_sum(second.high, second.low + x.low);
    const double z = r.high * r.high;
    const double series = z * (0.5 + r.high * (1.0 / 6 + r.high * (1.0 / 24)) +
                               z * r.high * (1.0 / 120 + r.high * (1.0 / 720 + r.high * (1.0 / 5040))));
    const int k = static_cast<int>(n);
    const int j = k & 63;
    const TableEntry& t = exp_table[j];
    const DoubleDouble sum = fast_two_sum(t.high, t.high * r.high);
    const double low = sum.low + (t.low + t.low * r.high + t.high * (r.low + series));
    return {fast_two_sum(sum.high, low), (k - j) / 64};
}

/// log x of a finite x > 0, to some 68 bits: x = 2^k m, sqrt(1/2) <= m < sqrt(2), m c = 1 + r with c from a table,
/// |r| < 1/150, and c = 1 about m = 1, so that nothing cancels there.
DoubleDouble logarithm(double x) {
    int k = 0;
    if (x < 0x1p-1022) x *= 0x1p54, k = -54;
    const std::uint64_t from_root = to_bits(x) - to_bits(0x1.6a09e667f3bcdp-1);
    const std::int64_t octave = static_cast<std::int64_t>(from_root) >> 52;
    const double m = from_bits(to_bits(x) - (static_cast<std::uint64_t>(octave) << 52));
    k += static_cast<int>(octave);
    const LogEntry& c = log_table[static_cast<int>(m * 128 + 0.5) - log_table_first];

    const double m_high = from_bits(to_bits(m) & ~std::uint64_t{0xffffff});  // 29 bits: its product with 11 is exact
    const DoubleDouble r = two_sum(m_high * c.reciprocal - 1, (m - m_high) * c.reciprocal);
    const DoubleDouble square = two_product(r.high, r.high);
    const double q = r.high;
    const double series =
        (1.0 / 3 - q * (1.0 / 4)) +
        square.high * ((1.0 / 5 - q * (1.0 / 6)) +
                       square.high * ((1.0 / 7 - q * (1.0 / 8)) + square.high * (1.0 / 9 - q * (1.0 / 10))));
    const double cubic = q * square.high * series;

    const DoubleDouble a = two_sum(k * 0x1.62e42fefa3800p-1 + c.high, q);  // k ln2 + log c: exact in the high parts
    const DoubleDouble b = two_sum(a.high, -0.5 * square.high);
    const double constants = k * 0x1.ef35793c76730p-45 + c.low;
    const double low = (a.low + b.low) + ((r.low - q * r.low - 0.5 * square.low) + (cubic + constants));
    return fast_two_sum(b.high, low);
}

/// x^y for finite x > 0.
double power_of_positive(double x, double y) {
    const DoubleDouble l = logarithm(x);
    const double about = y * l.high;
    if (about > 710) return infinity;
    if (about < -746) return 0;
    if (std::fabs(about) < 0x1p-60) return 1;
    const DoubleDouble product = two_product(y, l.high);
    return exponential({product.high, product.low + y * l.low}).value();
}

/// The part of sinh x beyond x, |x| < 0.3.
double sinh_rest(double x) {
    const double z = x * x;
    return x * z *
           (1.0 / 6 + z * (1.0 / 120 + z * (1.0 / 5040 + z * (1.0 / 362880 + z * (1.0 / 39916800 + z / 6227020800)))));
}

/// Twice cosh x, |x| < 50.
DoubleDouble twice_cosh(double x) { return add(exponential({x, 0}).unscaled(), exponential({-x, 0}).unscaled()); }

}  // namespace

double exp(double x) {
    if (std::isnan(x)) return nan;
    if (x > 710) return infinity;
    if (x < -746) return 0;
    return exponential({x, 0}).value();
}

double log(double x) {
    if (x == 0) return -infinity;
    if (!(x > 0)) return nan;
    return x == infinity ? infinity : logarithm(x).value();
}

double pow(double x, double y) {
    if (y == 0 || x == 1) return 1;
    if (std::isnan(x) || std::isnan(y)) return nan;
    const double size = std::fabs(x);
    if (std::isinf(y)) return size == 1 ? 1 : (size > 1) == (y > 0) ? infinity : 0;
    const bool integer = std::floor(y) == y;
    const bool odd = integer && std::floor(0.5 * y) * 2 != y;
    const double sign = odd ? std::copysign(1.0, x) : 1;
    if (size == 0 || size == infinity) return sign * ((size == 0) == (y < 0) ? infinity : 0);
    if (x < 0 && !integer) return nan;
    return sign * power_of_positive(size, y);
}

double sinh(double x) {
    const double size = std::fabs(x);
    if (std::isnan(x)) return nan;
    if (size < 0x1p-27) return x;
    if (size < 0.3) return x + sinh_rest(x);
    if (size > 711) return std::copysign(infinity, x);
    Scaled grown = exponential({size, 0});
    if (size < 50)
        return 0.5 * std::copysign(subtract(grown.unscaled(), exponential({-size, 0}).unscaled()).value(), x);
    --grown.exponent;  // the other exponential is below half an ulp of this one
    return std::copysign(grown.value(), x);
}

double cosh(double x) {
    const double size = std::fabs(x);
    if (std::isnan(x)) return nan;
    if (size < 50) return 0.5 * twice_cosh(x).value();
    if (size > 711) return infinity;
    Scaled grown = exponential({size, 0});
    --grown.exponent;
    return grown.value();
}

double tanh(double x) {
    const double size = std::fabs(x);
    if (std::isnan(x)) return nan;
    if (size < 0x1p-27) return x;
    if (size > 22) return std::copysign(1.0, x);
    if (size < 0.3) {
        const DoubleDouble sine = fast_two_sum(x, sinh_rest(x));
        return divide({2 * sine.high, 2 * sine.low}, twice_cosh(x)).value();
    }
    const DoubleDouble denominator = add(exponential({2 * size, 0}).unscaled(), {1, 0});  // tanh = 1 - 2 / (e^2x + 1)
    return std::copysign(subtract({1, 0}, divide({2, 0}, denominator)).value(), x);
}

double hypot(double x, double y) {
    if (std::isinf(x) || std::isinf(y)) return infinity;
    if (std::isnan(x) || std::isnan(y)) return nan;
    double a = std::fabs(x), b = std::fabs(y);
    if (a < b) {
        const double swap = a;
        a = b, b = swap;
    }
    if (b == 0 || exponent_of(a) - exponent_of(b) > 60) return a + b;
    // Towards the ends of the range the squares would overflow or lose bits.
    const int shift = a > 0x1p400 ? -700 : b < 0x1p-400 ? 700 : 0;
    a *= power_of_two(shift), b *= power_of_two(shift);
    return square_root(add(two_product(a, a), two_product(b, b))).value() * power_of_two(-shift);
}

}  // namespace carom::portable
