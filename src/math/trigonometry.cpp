// sin, cos, tan and their inverses.
// Methods: those of trigonometry_text.hpp; Payne and Hanek, "Radian reduction for trigonometric functions" (1983), for
// the reduction of large arguments; for the inverses one table look-up, after Gal (1986), and the Taylor series of the
// small rest.

#include <cmath>
#include <cstdint>

#include "math/bits.hpp"
#include "math/double_double.hpp"
#include "math/elementary.hpp"
#include "math/elementary_tables.hpp"
#include "math/trigonometry_text.hpp"

namespace carom::portable {
namespace {

constexpr DoubleDouble pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr DoubleDouble half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// An angle less a multiple of pi/2.
struct Reduced {
    DoubleDouble rest;  // in [-pi/4, pi/4], but for a rounding error
    unsigned quadrant;  // that multiple; its last two bits are of use
};

/// 64 bits of 2/pi from a bit position of the table.
std::uint64_t two_over_pi_at(int position) {
    const int word = position / 64, shift = position % 64;
    if (shift == 0) return two_over_pi[word];
    return two_over_pi[word] << shift | two_over_pi[word + 1] >> (64 - shift);
}

/// For any finite |x| >= 2^20. x = m 2^e times those 192 bits of 2/pi that count: the bits before them add multiples of
/// 4, those after them less than 2^-137. No double comes closer to a multiple of pi/2 than 2^-61 of it, so that of the
/// 126 bits kept some 65 count at worst.
Reduced reduce_payne_hanek(double x) {
    __extension__ using Wide = unsigned __int128;
    const int start = exponent_of(x) - 52 + 62;  // the first bit weighs 2 after the product
    const std::uint64_t m = (to_bits(x) & 0xfffffffffffffu) | 0x10000000000000u;
    const Wide c = static_cast<Wide>(m) * two_over_pi_at(start + 128);
    const Wide b = static_cast<Wide>(m) * two_over_pi_at(start + 64) + (c >> 64);
    const std::uint64_t middle = static_cast<std::uint64_t>(b);
    const std::uint64_t high = m * two_over_pi_at(start) + static_cast<std::uint64_t>(b >> 64);
    // Two bits of quadrant, then the fraction of a quadrant; more than one half belongs to the next quadrant.
    unsigned quadrant = static_cast<unsigned>(high >> 62);
    Wide fraction = (static_cast<Wide>(high) << 64 | middle) << 2;
    const bool beyond = fraction >> 127 != 0;
    if (beyond) {
        ++quadrant;
        fraction = -fraction;
    }
    const int zeros = __builtin_clzll(static_cast<std::uint64_t>(fraction >> 64) | 1);
    fraction <<= zeros;
    const double scale = power_of_two(-zeros) * (beyond == (x < 0) ? 1 : -1);
    const double top = static_cast<double>(static_cast<std::uint64_t>(fraction >> 75)) * (0x1p-53 * scale);
    const double next = static_cast<double>(static_cast<std::uint64_t>(fraction >> 11)) * (0x1p-117 * scale);
    const DoubleDouble product = two_product(top, half_pi.high);
    const double rest = product.low + (top * half_pi.low + next * half_pi.high);
    return {fast_two_sum(product.high, rest), x < 0 ? 0 - quadrant : quadrant};
}

/// Of a finite x.
Reduced reduce(double x) {
    const double size = std::fabs(x);
    if (size <= quarter_pi) return {{x, 0}, 0};
    if (size > most_cody_waite) return reduce_payne_hanek(x);
    const auto [rest, multiple] = reduce_cody_waite(x);
    return {{rest.high, rest.low}, static_cast<unsigned>(to_bits(multiple))};
}

DoubleDouble sin_kernel(DoubleDouble x) {
    const auto [high, low] = sine_of_rest(x.high, x.low);
    return {high, low};
}
DoubleDouble cos_kernel(DoubleDouble x) {
    const auto [high, low] = cosine_of_rest(x.high, x.low);
    return {high, low};
}

/// The sine (shift 0) or cosine (shift 1) of a reduced angle.
double sine(const Reduced& angle, unsigned shift) {
    const unsigned quadrant = angle.quadrant + shift;
    const double value = (quadrant & 1 ? cos_kernel(angle.rest) : sin_kernel(angle.rest)).value();
    return quadrant & 2 ? -value : value;
}

}  // namespace

double sin(double x) {
    if (!std::isfinite(x)) return nan;
    if (std::fabs(x) < 0x1p-27) return x;  // keeps the sign of zero
    return sine(reduce(x), 0);
}

double cos(double x) {
    if (!std::isfinite(x)) return nan;
    return sine(reduce(x), 1);
}

SinCos sincos(double x) {
    if (!std::isfinite(x)) return {nan, nan};
    const Reduced angle = reduce(x);
    return {std::fabs(x) < 0x1p-27 ? x : sine(angle, 0), sine(angle, 1)};
}

double tan(double x) {
    if (!std::isfinite(x)) return nan;
    if (std::fabs(x) < 0x1p-27) return x;
    const Reduced angle = reduce(x);
    const DoubleDouble s = sin_kernel(angle.rest), c = cos_kernel(angle.rest);
    const DoubleDouble sine = fast_two_sum(s.high, s.low), cosine = fast_two_sum(c.high, c.low);
    return angle.quadrant & 1 ? -divide(cosine, sine).value() : divide(sine, cosine).value();
}

namespace {

/// atan(y / x) for 0 <= y <= x (about): y / x lies near i / 32, and atan(y / x) = atan(i / 32) + atan(t) with
/// t = (y - x i/32) / (x + y i/32), |t| <= 1/64. Right to some 65 bits.
DoubleDouble arctangent(DoubleDouble y, DoubleDouble x) {
    const int i = static_cast<int>(y.high / x.high * 32 + 0.5);
    const double c = i * 0x1p-5;
    const DoubleDouble cx = two_product(c, x.high), cy = two_product(c, y.high);
    const DoubleDouble numerator{y.high - cx.high, (y.low - c * x.low) - cx.low};  // y - cx is exact: Sterbenz
    const DoubleDouble sum = two_sum(x.high, cy.high);
    const DoubleDouble denominator = fast_two_sum(sum.high, sum.low + (cy.low + (x.low + c * y.low)));
    const DoubleDouble t = divide(numerator, denominator);
    const double z = t.high * t.high;
    const double series = -1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11))));
    const TableEntry& entry = atan_table[i];
    const DoubleDouble high = two_sum(entry.high, t.high);
    return fast_two_sum(high.high, high.low + (entry.low + (t.low + t.high * z * series)));
}

/// sqrt(1 - x^2) for |x| <= 1.
DoubleDouble other_leg(double x) {
    const DoubleDouble square = two_product(x, x);
    const DoubleDouble rest = two_sum(1, -square.high);
    return square_root(fast_two_sum(rest.high, rest.low - square.low));
}

/// The angle in [0, pi/2] whose tangent is y / x, y, x >= 0 and not both zero.
DoubleDouble first_quadrant(DoubleDouble y, DoubleDouble x) {
    return y.high <= x.high ? arctangent(y, x) : subtract(half_pi, arctangent(x, y));
}

}  // namespace

double asin(double x) {
    const double size = std::fabs(x);
    if (!(size <= 1)) return nan;
    if (size < 0x1p-27) return x;
    return std::copysign(first_quadrant({size, 0}, other_leg(x)).value(), x);
}

double acos(double x) {
    const double size = std::fabs(x);
    if (!(size <= 1)) return nan;
    if (size < 0x1p-60) return half_pi.high;
    const DoubleDouble angle = first_quadrant(other_leg(x), {size, 0});
    return (x < 0 ? subtract(pi, angle) : angle).value();
}

double atan(double x) {
    const double size = std::fabs(x);
    if (std::isnan(x)) return nan;
    if (size < 0x1p-27) return x;
    if (size > 0x1p64) return std::copysign(half_pi.high, x);
    return std::copysign(first_quadrant({size, 0}, {1, 0}).value(), x);
}

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return nan;
    double rise = std::fabs(y), run = std::fabs(x);
    const bool left = std::signbit(x);
    if (std::isinf(rise) && std::isinf(run)) rise = run = 1;
    const int steepness = exponent_of(rise) - exponent_of(run);
    if (rise == 0 || steepness < -64) return std::copysign(left ? pi.high : rise == 0 ? 0 : rise / run, y);
    if (run == 0 || steepness > 64) return std::copysign(half_pi.high, y);
    // Halfway to the ends of the range the exact products would overflow or lose bits.
    const double larger = rise > run ? rise : run;
    const double scale = larger > 0x1p400 ? 0x1p-600 : larger < 0x1p-400 ? 0x1p600 : 1;
    const DoubleDouble angle = first_quadrant({rise * scale, 0}, {run * scale, 0});
    return std::copysign((left ? subtract(pi, angle) : angle).value(), y);
}

}  // namespace carom::portable
