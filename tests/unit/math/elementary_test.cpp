#include "math/elementary.hpp"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <limits>
#include <numbers>

#include "carom/random.hpp"
#include "math/bits.hpp"

namespace {

using carom::from_bits;
using carom::Random;
using carom::to_bits;
namespace portable = carom::portable;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using std::numbers::pi;
constexpr double tiny = std::numeric_limits<double>::denorm_min();
constexpr double huge = std::numeric_limits<double>::max();

/// |found - truth| in units of the last place of a double of the truth's size.
double error_in_ulp(double found, long double truth) {
    const int exponent = std::max(std::ilogb(truth), -1022) - 52;
    return static_cast<double>(std::fabs(std::ldexp(found - truth, -exponent)));
}

/// Uniform in sign and exponent: arguments of every size in [2^low, 2^high).
double of_any_size(Random& random, int low, int high) {
    const double size = std::ldexp(random.uniform(1, 2), low + static_cast<int>(random.bits() % (high - low)));
    return random.bits() & 1 ? size : -size;
}

using Function = double (*)(double);
using Truth = long double (*)(long double);

struct Accuracy {
    const char* name;
    Function function;
    Truth truth;
    double low, high;       // a range for uniform arguments
    int smallest, largest;  // exponents for arguments of any size
    double worst;           // [ulp]
    bool positive = false;  // arguments of any size are
};

std::ostream& operator<<(std::ostream& out, const Accuracy& row) { return out << row.name; }

// As macros of the name: the long double functions are overloads, not to be told apart by a template.
#define ROW(name) #name, portable::name, [](long double x) { return std::name(x); }
const Accuracy accuracies[] = {
    {ROW(sin), -2e6, 2e6, -60, 1023, 0.79},    {ROW(cos), -2e6, 2e6, -60, 1023, 0.79},
    {ROW(tan), -2e6, 2e6, -60, 1023, 0.94},    {ROW(sin), -4, 4, -30, 4, 0.79},
    {ROW(cos), -4, 4, -30, 4, 0.79},           {ROW(tan), -4, 4, -30, 4, 0.94},
    {ROW(asin), -1, 1, -60, -1, 0.51},         {ROW(acos), -1, 1, -70, -1, 0.51},
    {ROW(atan), -4, 4, -60, 80, 0.51},         {ROW(exp), -708, 709.7, -60, 9, 0.51},
    {ROW(log), 0, 2, -1074, 1023, 0.51, true}, {ROW(sinh), -2, 2, -60, 9, 0.53},
    {ROW(cosh), -2, 2, -60, 9, 0.51},          {ROW(tanh), -2, 2, -60, 5, 0.53},
};
#undef ROW

class ElementaryAccuracy : public testing::TestWithParam<Accuracy> {};

TEST_P(ElementaryAccuracy, IsWithinTheDocumentedError) {
    if (LDBL_MANT_DIG < 64) GTEST_SKIP() << "long double is no better than double here";
    const Accuracy& row = GetParam();
    Random random(1);
    double worst = 0, at = 0;
    for (int k = 0; k < 200'000; ++k) {
        double x = k % 2 ? random.uniform(row.low, row.high) : of_any_size(random, row.smallest, row.largest);
        if (row.positive) x = std::fabs(x);
        const double error = error_in_ulp(row.function(x), row.truth(x));
        if (!(error <= worst)) worst = error, at = x;
    }
    EXPECT_LE(worst, row.worst) << "at " << std::hexfloat << at;
    EXPECT_GE(worst, 0.49);  // or the measure is blind
}

INSTANTIATE_TEST_SUITE_P(Functions, ElementaryAccuracy, testing::ValuesIn(accuracies));

TEST(Elementary, FunctionsOfTwoAreWithinTheDocumentedError) {
    if (LDBL_MANT_DIG < 64) GTEST_SKIP() << "long double is no better than double here";
    Random random(2);
    double atan2 = 0, hypot = 0, pow = 0;
    for (int k = 0; k < 200'000; ++k) {
        const double x = of_any_size(random, -1022, 1022);
        const double y = k % 2 ? of_any_size(random, -1022, 1022) : x * random.uniform(-3, 3);
        const long double angle = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        if (std::fabs(angle) > DBL_MIN) atan2 = std::max(atan2, error_in_ulp(portable::atan2(y, x), angle));
        const long double length = std::hypot(static_cast<long double>(x), static_cast<long double>(y));
        if (length < huge) hypot = std::max(hypot, error_in_ulp(portable::hypot(x, y), length));
        const double base = std::fabs(k % 3 ? x : 1 + of_any_size(random, -40, -1));
        const double exponent = random.uniform(-700, 700) / std::log(base);
        const long double power = std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
        pow = std::max(pow, error_in_ulp(portable::pow(base, exponent), power));
    }
    EXPECT_LE(atan2, 0.51);
    EXPECT_LE(hypot, 0.51);
    EXPECT_LE(pow, 0.51);
}

TEST(Elementary, LargeAnglesAreReducedToTheLastBit) {
    EXPECT_EQ(portable::sin(1e22), -0.8522008497671888);  // Ng, "Argument reduction for huge arguments" (1992)
    EXPECT_EQ(portable::cos(1e22), 0.523214785395139);
    // The double that comes closest to a multiple of pi/2 (Muller, "Elementary Functions", table 11.2).
    EXPECT_EQ(portable::cos(std::ldexp(6381956970095103, 797)), -4.6871659242546277e-19);
    EXPECT_EQ(portable::sin(std::ldexp(6381956970095103, 797)), 1);
    EXPECT_EQ(portable::cos(pi / 2), 6.123233995736766e-17);
    EXPECT_EQ(portable::sin(pi), 1.2246467991473532e-16);
    EXPECT_EQ(portable::sin(-1e22), 0.8522008497671888);
}

struct Special {
    const char* text;
    double found, wanted;
};
std::ostream& operator<<(std::ostream& out, const Special& row) { return out << row.text; }
#define IS(call, wanted) \
    Special { #call, portable::call, wanted }

class ElementarySpecial : public testing::TestWithParam<Special> {};

TEST_P(ElementarySpecial, ValueHasTheBitsOfTheStandard) {
    const Special& row = GetParam();
    EXPECT_EQ(to_bits(row.found), to_bits(row.wanted)) << row.text << " gave " << row.found << ", not " << row.wanted;
}

const Special trigonometric[] = {
    IS(sin(0.0), 0.0),
    IS(sin(-0.0), -0.0),
    IS(sin(tiny), tiny),
    IS(sin(inf), nan),
    IS(sin(-inf), nan),
    IS(sin(-nan), nan),
    IS(cos(0.0), 1),
    IS(cos(-0.0), 1),
    IS(cos(tiny), 1),
    IS(cos(inf), nan),
    IS(cos(-nan), nan),
    IS(tan(0.0), 0.0),
    IS(tan(-0.0), -0.0),
    IS(tan(-tiny), -tiny),
    IS(tan(inf), nan),
    IS(tan(-nan), nan),
    IS(tan(pi / 2), 1.633123935319537e16),
    IS(asin(0.0), 0.0),
    IS(asin(-0.0), -0.0),
    IS(asin(1), pi / 2),
    IS(asin(-1), -pi / 2),
    IS(asin(1.5), nan),
    IS(asin(-inf), nan),
    IS(asin(-nan), nan),
    IS(asin(0.5), 0.5235987755982989),
    IS(acos(1), 0.0),
    IS(acos(-1), pi),
    IS(acos(0.0), pi / 2),
    IS(acos(-0.0), pi / 2),
    IS(acos(tiny), pi / 2),
    IS(acos(-1.5), nan),
    IS(acos(-nan), nan),
    IS(acos(0.5), 1.0471975511965979),
    IS(atan(0.0), 0.0),
    IS(atan(-0.0), -0.0),
    IS(atan(1), pi / 4),
    IS(atan(-inf), -pi / 2),
    IS(atan(inf), pi / 2),
    IS(atan(huge), pi / 2),
    IS(atan(-nan), nan),
    IS(atan2(0.0, 0.0), 0.0),
    IS(atan2(-0.0, 0.0), -0.0),
    IS(atan2(0.0, -0.0), pi),
    IS(atan2(-0.0, -0.0), -pi),
    IS(atan2(0.0, 1), 0.0),
    IS(atan2(-0.0, -1), -pi),
    IS(atan2(1, 0.0), pi / 2),
    IS(atan2(-1, -0.0), -pi / 2),
    IS(atan2(1, 1), pi / 4),
    IS(atan2(1, -1), 3 * (pi / 4)),
    IS(atan2(-1, -1), -3 * (pi / 4)),
    IS(atan2(inf, inf), pi / 4),
    IS(atan2(-inf, -inf), -3 * (pi / 4)),
    IS(atan2(1, inf), 0.0),
    IS(atan2(-1, inf), -0.0),
    IS(atan2(1, -inf), pi),
    IS(atan2(-inf, 1), -pi / 2),
    IS(atan2(tiny, huge), 0.0),
    IS(atan2(tiny, -huge), pi),
    IS(atan2(huge, tiny), pi / 2),
    IS(atan2(tiny, tiny), pi / 4),
    IS(atan2(huge, -huge), 3 * (pi / 4)),
    IS(atan2(-nan, 1), nan),
    IS(atan2(1, -nan), nan),
    IS(atan2(3 * tiny, 1), 3 * tiny),
};
INSTANTIATE_TEST_SUITE_P(Trigonometric, ElementarySpecial, testing::ValuesIn(trigonometric));

const Special exponential[] = {
    IS(exp(0.0), 1),
    IS(exp(-0.0), 1),
    IS(exp(1), 2.718281828459045),
    IS(exp(inf), inf),
    IS(exp(-inf), 0.0),
    IS(exp(-nan), nan),
    IS(exp(tiny), 1),
    IS(exp(709.782712893384), 0x1.fffffffffff2ap+1023),
    IS(exp(709.7827128933841), inf),
    IS(exp(-745.1332191019411), tiny),
    IS(exp(-745.1332191019412), 0.0),
    IS(exp(-1e300), 0.0),
    IS(log(1), 0.0),
    IS(log(0.0), -inf),
    IS(log(-0.0), -inf),
    IS(log(inf), inf),
    IS(log(-1), nan),
    IS(log(-nan), nan),
    IS(log(2), 0.6931471805599453),
    IS(log(tiny), -744.4400719213812),
    IS(log(huge), 709.782712893384),
    IS(pow(0.0, 0.0), 1),
    IS(pow(nan, 0.0), 1),
    IS(pow(1, nan), 1),
    IS(pow(nan, 1), nan),
    IS(pow(2, -nan), nan),
    IS(pow(-1, inf), 1),
    IS(pow(-1, -inf), 1),
    IS(pow(0.5, inf), 0.0),
    IS(pow(0.5, -inf), inf),
    IS(pow(-2, inf), inf),
    IS(pow(-2, -inf), 0.0),
    IS(pow(0.0, 3), 0.0),
    IS(pow(-0.0, 3), -0.0),
    IS(pow(-0.0, 2), 0.0),
    IS(pow(-0.0, 2.5), 0.0),
    IS(pow(0.0, -3), inf),
    IS(pow(-0.0, -3), -inf),
    IS(pow(-0.0, -2), inf),
    IS(pow(-inf, 3), -inf),
    IS(pow(-inf, -3), -0.0),
    IS(pow(-inf, 2), inf),
    IS(pow(inf, -1), 0.0),
    IS(pow(-inf, 2.5), inf),
    IS(pow(-8, 1 / 3.), nan),
    IS(pow(-2, 3), -8),
    IS(pow(-2, 4), 16),
    IS(pow(-2, 0x1p53), inf),
    IS(pow(-1, 0x1.fffffffffffffp+52), -1),
    IS(pow(-1, 0x1p53), 1),
    IS(pow(2, 1024), inf),
    IS(pow(-2, 1025), -inf),
    IS(pow(2, -1074), tiny),
    IS(pow(2, -1080), 0.0),
    IS(pow(-2, -1081), -0.0),
    IS(pow(huge, huge), inf),
    IS(pow(0.999, huge), 0.0),
    IS(pow(1.001, tiny), 1),
    IS(sinh(0.0), 0.0),
    IS(sinh(-0.0), -0.0),
    IS(sinh(inf), inf),
    IS(sinh(-inf), -inf),
    IS(sinh(-nan), nan),
    IS(sinh(-1e-300), -1e-300),
    IS(sinh(711), inf),
    IS(sinh(-710.4758600739439), -0x1.ffffffffffd3bp+1023),
    IS(cosh(0.0), 1),
    IS(cosh(-inf), inf),
    IS(cosh(-nan), nan),
    IS(cosh(-711), inf),
    IS(cosh(tiny), 1),
    IS(tanh(0.0), 0.0),
    IS(tanh(-0.0), -0.0),
    IS(tanh(inf), 1),
    IS(tanh(-inf), -1),
    IS(tanh(-nan), nan),
    IS(tanh(-tiny), -tiny),
    IS(tanh(19.0625), 1),
    IS(hypot(0.0, -0.0), 0.0),
    IS(hypot(inf, nan), inf),
    IS(hypot(nan, -inf), inf),
    IS(hypot(-nan, 1), nan),
    IS(hypot(3, -4), 5),
    IS(hypot(3e300, 4e300), 5e300),
    IS(hypot(3 * tiny, 4 * tiny), 5 * tiny),
    IS(hypot(huge, huge), inf),
    IS(hypot(-huge, tiny), huge),
    IS(hypot(tiny, 0.0), tiny),
};
INSTANTIATE_TEST_SUITE_P(Exponential, ElementarySpecial, testing::ValuesIn(exponential));
#undef IS

TEST(Elementary, SincosHasTheBitsOfSinAndCos) {
    Random random(3);
    for (int k = 0; k < 100'000; ++k) {
        const double x = from_bits(random.bits());
        const portable::SinCos both = portable::sincos(x);
        ASSERT_EQ(to_bits(both.sin), to_bits(portable::sin(x))) << std::hexfloat << x;
        ASSERT_EQ(to_bits(both.cos), to_bits(portable::cos(x))) << std::hexfloat << x;
    }
    EXPECT_EQ(to_bits(portable::sincos(-0.0).sin), to_bits(-0.0));
}

TEST(Elementary, SymmetriesHoldToTheLastBit) {
    Random random(4);
    for (int k = 0; k < 100'000; ++k) {
        const double x = of_any_size(random, -40, 40), y = of_any_size(random, -40, 40);
        ASSERT_EQ(portable::sin(-x), -portable::sin(x));
        ASSERT_EQ(portable::cos(-x), portable::cos(x));
        ASSERT_EQ(portable::tan(-x), -portable::tan(x));
        ASSERT_EQ(portable::atan(-x), -portable::atan(x));
        ASSERT_EQ(portable::atan2(-y, x), -portable::atan2(y, x));
        ASSERT_EQ(portable::sinh(-x), -portable::sinh(x));
        ASSERT_EQ(portable::cosh(-x), portable::cosh(x));
        ASSERT_EQ(portable::tanh(-x), -portable::tanh(x));
        ASSERT_EQ(portable::hypot(x, y), portable::hypot(-y, x));
        ASSERT_EQ(portable::hypot(std::ldexp(x, 500), std::ldexp(y, 500)), std::ldexp(portable::hypot(x, y), 500));
        ASSERT_EQ(portable::atan2(std::ldexp(y, -900), std::ldexp(x, -900)), portable::atan2(y, x));
    }
}

TEST(Elementary, PowerIsExactWhereADoubleCanHoldIt) {
    for (int base = 2; base <= 100; ++base) {
        double exact = 1;
        for (int n = 1; (exact *= base) <= 0x1p53; ++n) {
            ASSERT_EQ(portable::pow(base, n), exact) << base << "^" << n;
            ASSERT_EQ(portable::pow(-base, n), n % 2 ? -exact : exact) << base << "^" << n;
        }
    }
    for (int n = -1074; n <= 1023; ++n) ASSERT_EQ(portable::pow(2, n), std::ldexp(1.0, n)) << n;
    Random random(5);
    for (int k = 0; k < 100'000; ++k) {
        const double x = of_any_size(random, -1000, 1000);
        ASSERT_EQ(portable::pow(x, 1), x);
    }
}

TEST(Elementary, NoJumpWhereAFormulaTakesOverFromAnother) {
    // The ends of the pieces: neighbouring arguments, neighbouring values, in the right order.
    const struct {
        const char* name;
        Function function;
        double at;
    } seams[] = {{"sin", portable::sin, 0x1p-27},
                 {"sin", portable::sin, pi / 4},
                 {"sin", portable::sin, 0x1p20},
                 {"tan", portable::tan, pi / 4},
                 {"asin", portable::asin, 0.70710678118654757},
                 {"asin", portable::asin, 0x1p-27},
                 {"atan", portable::atan, 1},
                 {"atan", portable::atan, 1 / 64.},
                 {"exp", portable::exp, 0.34657359027997264},
                 {"log", portable::log, 0.70710678118654757},
                 {"log", portable::log, 1},
                 {"sinh", portable::sinh, 0.3},
                 {"sinh", portable::sinh, 50},
                 {"cosh", portable::cosh, 50},
                 {"tanh", portable::tanh, 0.3},
                 {"sinh", portable::sinh, 0x1p-27}};
    for (const auto& [name, function, at] : seams) {
        const double before = std::nextafter(at, 0), value = function(at);
        const double near = std::min(at * 0x1p-26, 0x1p-20);
        const double slope = (function(at + near) - function(at - near)) / (2 * near);
        const double step = value - function(before);
        const double ulp = std::nextafter(std::fabs(value), inf) - std::fabs(value);
        EXPECT_NEAR(step, slope * (at - before), 2 * ulp) << name << " at " << at;
    }
}

}  // namespace
