#include "math/roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <vector>

#include "carom/random.hpp"

namespace {

using carom::first_descent;
using carom::Random;

using Coefficients = std::vector<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

long double value(const Coefficients& c, long double t) {
    long double sum = 0;
    for (auto k = c.size(); k-- > 0;) sum = sum * t + c[k];
    return sum;
}

/// Sum of |c[k]| t^k: what rounding errors are measured by.
long double size(const Coefficients& c, long double t) {
    long double sum = 0;
    for (auto k = c.size(); k-- > 0;) sum = sum * t + std::fabs(c[k]);
    return sum;
}

/// factor times the product of (t - root).
Coefficients with_roots(const std::vector<double>& roots, double factor) {
    Coefficients c{factor};
    for (double root : roots) {
        c.insert(c.begin(), 0);
        for (std::size_t k = 0; k + 1 < c.size(); ++k) c[k] -= root * c[k + 1];
    }
    return c;
}

Coefficients times(const Coefficients& a, const Coefficients& b) {
    Coefficients c(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < b.size(); ++k) c[i + k] += a[i] * b[k];
    return c;
}

struct Case {
    const char* name;
    Coefficients c;
    double end;
    double impact;  // none: -1
};
std::ostream& operator<<(std::ostream& out, const Case& row) { return out << row.name; }

constexpr double none = -1;

class FirstDescent : public testing::TestWithParam<Case> {};

TEST_P(FirstDescent, IsAtTheKnownTime) {
    const Case& row = GetParam();
    const std::optional<double> t = first_descent(row.c, row.end);
    if (row.impact == none) {
        EXPECT_FALSE(t.has_value()) << *t;
    } else {
        ASSERT_TRUE(t.has_value());
        EXPECT_NEAR(*t, row.impact, 4e-16 * row.impact);
    }
}

const Case up_to_quadratic[] = {
    {"nothing", {}, 1, none},
    {"zero", {0, 0, 0}, 1, none},
    {"positive constant", {1}, infinity, none},
    {"negative constant", {-1}, infinity, none},
    {"line falls", {1, -2}, 1, 0.5},
    {"line falls at the end", {1, -1}, 1, 1},
    {"line falls after the end", {1, -1}, 0.999, none},
    {"line rises", {1, 2}, infinity, none},
    {"contact, closing", {0, -2}, 1, 0},
    {"contact, parting", {0, 2}, infinity, none},
    {"overlap, closing", {-1e-17, -2}, 1, 0},
    {"overlap, parting", {-1e-17, 2}, infinity, none},
    {"contact, closing, no time", {0, -1}, 0, 0},
    {"gap, no time", {1, -1}, 0, none},
    {"leading zeros", {1, -2, 0, 0, 0, 0, 0}, 1, 0.5},
    {"dropped ball", {4.9, 0, -4.9}, 10, 1},
    {"thrown ball", {1, 2, -3}, 10, 1},
    {"ball thrown down", {1, -2, -3}, 10, 1 / 3.},
    {"ball leaves the floor and comes back", {0, 4, -2}, 10, 2},
    {"ball leaves the floor and time is up", {0, 4, -2}, 1.9, none},
    {"contact, pulled apart", {0, 0, 1}, infinity, none},
    {"contact, pulled together", {0, 0, -1}, infinity, 0},
    {"discs meet, first of two roots", {3, -4, 1}, 10, 1},
    {"discs graze", {1, -2, 1}, 10, none},
    {"discs graze in thirds", {1, -6, 9}, 10, none},
    {"discs overlap by a hair", {1, -2, 1 - 0x1p-53}, 10, 1 / (1 + 0x1.6a09e667f3bcdp-27)},
    {"discs miss by a hair", {1, -2, 1 + 0x1p-52}, 10, none},
    {"contact, closing, then would part", {0, -1, 5}, 10, 0},
    {"overlap, parting, comes back", {-3, 4, -1}, 10, 3},
    {"overlap, parting, turns at the surface", {-4, 4, -1}, 10, 2},
    {"overlap, parting, turns below", {-5, 4, -1}, 10, 2},
    {"overlap, turns after the end", {-5, 4, -1}, 1.9, none},
    {"tiny coefficients", {1e-200, 0, -1e-200}, 10, 1},
    {"huge coefficients", {1e200, 0, -1e200}, 10, 1},
    {"far root, tiny slope", {1, -1e-200}, infinity, 1e200},
    {"discriminant of which rounding takes half",
     {4495507386617024, -8991015309622410, 4495507923005401},
     1,
     67048544 / 67048549.},
    {"no cancellation", {1, -1e9, 1}, infinity, 1.000000000000000001e-9},
};
INSTANTIATE_TEST_SUITE_P(UpToQuadratic, FirstDescent, testing::ValuesIn(up_to_quadratic));

const Case higher[] = {
    {"cubic falls", {8, 0, 0, -1}, 10, 2},
    {"cubic falls, no end", {8, 0, 0, -1}, infinity, 2},
    {"cubic falls at the end", {8, 0, 0, -1}, 2, 2},
    {"cubic falls after the end", {8, 0, 0, -1}, 1.999, none},
    {"contact, cubic closing", {0, 0, 0, -1}, 10, 0},
    {"contact, cubic parting", {0, 0, 0, 1}, infinity, none},
    {"contact, parting, comes back", times({0, 1}, with_roots({1, 2}, 1)), 10, 1},
    {"contact, closing before it would part", times({0, 1}, with_roots({1, 2}, -1)), 10, 0},
    {"overlap, parting, comes back at 3", with_roots({0.125, 3, 5}, 1), 10, 3},
    {"overlap, closing", with_roots({-1, 3, 5}, -1), 10, 0},
    {"overlap, turns below", {-10, 0, 2, 0, -1}, 10, 1},
    {"overlap, turns at the surface", {-1, 0, 2, 0, -1}, 10, 1},
    {"second of three roots", with_roots({1, 2, 3}, -1), 10, 1},
    {"touch from above", with_roots({2, 2}, 1), 10, none},
    {"quartic touch from above", times(with_roots({2, 2}, 1), {1, 0, 1}), 10, none},
    {"quartic touch in thirds", times({1, -6, 9}, {1, 0, 1}), 10, none},
    {"quartic touch, then impact", times(with_roots({1, 1}, 1), with_roots({3, 4}, 1)), 10, 3},
    {"touch at the end", times(with_roots({2, 2}, 1), {1, 0, 1}), 2, none},
    {"two touches, then impact", times(with_roots({1, 1, 2, 2}, 1), {4, -1}), 10, 4},
    {"fourfold touch", with_roots({1, 1, 1, 1}, 1), 10, none},
    {"sextic touch thrice", times(with_roots({1, 1, 2, 2}, 1), with_roots({3, 3}, 1)), 10, none},
    {"sextic", with_roots({1, 2, 3, 4, 5, 6}, 1), 10, 1},
    {"sextic upside down", with_roots({1, 2, 3, 4, 5, 6}, -1), 10, 2},
    {"sextic from between roots", with_roots({-1, 2, 3, 4, 5, 6}, -1), infinity, 2},
    {"touch that rounding makes an overlap",
     {669780, -4611600, 10103744, -8788080, 6795108, -3538080, 682344},
     10,
     none},
    {"impact almost a touch", times({1, -2, 1 - 0x1p-40}, {1, 0, 1}), 10, 1 / (1 + 0x1p-20)},
    {"miss, almost a touch", times({1, -2, 1 + 0x1p-40}, {1, 0, 1}), 10, none},
    {"slope touches zero on the way up", {16, 36, -42, 20, -3}, 10, 4},
    {"tiny coefficients", {8e-250, 0, 0, -1e-250}, 10, 2},
    {"leading zero of a cubic", {8, 0, 0, -1, 0, 0, 0}, 10, 2},
    {"root of many sizes", {1e-12, -1, 0, 1}, 10, 1e-12},
};
INSTANTIATE_TEST_SUITE_P(Higher, FirstDescent, testing::ValuesIn(higher));

/// What the definition says, tried on a grid: up to t the gap is open, at t it is zero, from there it falls.
void expect_first_descent(const Coefficients& c, double end) {
    const std::optional<double> t = first_descent(c, end);
    const double until = t.value_or(end);
    const long double slack = 2e-15L;
    for (int k = 0; k <= 400; ++k) {
        const long double s = until * (k / 400.0L);
        ASSERT_GE(value(c, s), -slack * size(c, s)) << "overlap at " << s << " before the answer " << until;
    }
    if (!t) return;
    ASSERT_GE(*t, 0);
    ASSERT_LE(*t, end);
    ASSERT_LE(std::fabs(value(c, *t)), slack * size(c, *t)) << "no contact at " << *t;
    bool falls = false;  // by more than rounding, before it rises above zero again
    for (long double step = 1e-15L; step < 1e3 && !falls; step *= 2) {
        const long double s = *t + step * (1 + *t);
        falls = value(c, s) < -1e-18L * size(c, s);
        if (value(c, s) > slack * size(c, s)) break;
    }
    ASSERT_TRUE(falls) << "no fall at " << *t;
}

TEST(FirstDescentAtRandom, AgreesWithItsDefinition) {
    Random random(1);
    int found = 0;
    for (int k = 0; k < 20'000; ++k) {
        Coefficients c(1 + random.bits() % 7);
        for (double& x : c) x = random.bits() % 8 ? random.normal() : 0;
        c[0] = std::fabs(c[0]);
        if (c[0] == 0) c[0] = 0.5;
        const double end = random.uniform(0, 5);
        SCOPED_TRACE(testing::PrintToString(c));
        expect_first_descent(c, end);
        if (HasFatalFailure()) return;
        found += first_descent(c, end).has_value();
    }
    EXPECT_GT(found, 5'000);
    EXPECT_LT(found, 15'000);
}

TEST(FirstDescentAtRandom, FindsTheKnownRootAmongSix) {
    Random random(2);
    for (int k = 0; k < 20'000; ++k) {
        std::vector<double> roots(1 + random.bits() % 6);
        for (double& root : roots) root = random.uniform(-2, 4);
        std::sort(roots.begin(), roots.end());
        double gap = infinity;
        for (std::size_t i = 1; i < roots.size(); ++i) gap = std::min(gap, roots[i] - roots[i - 1]);
        if (gap < 0.05 || std::any_of(roots.begin(), roots.end(), [](double r) { return std::fabs(r) < 0.01; }))
            continue;
        const Coefficients c = with_roots(roots, random.bits() & 1 ? 1 : -1);
        // The sign alternates at every root: the first positive one, or the next where that is a rise.
        auto wanted = std::upper_bound(roots.begin(), roots.end(), 0.0);
        const std::optional<double> t = first_descent(c, 3);
        if (c[0] < 0) {
            if (c.size() > 1 && c[1] < 0) {
                ASSERT_EQ(t, 0.0);
                continue;
            }
            if (t && value(c, *t) < -1e-9) continue;  // turned below the surface: "AgreesWithItsDefinition" of its kind
            if (wanted != roots.end()) ++wanted;
        }
        if (wanted == roots.end() || *wanted > 3) {
            ASSERT_FALSE(t.has_value()) << testing::PrintToString(roots) << *t;
        } else {
            ASSERT_TRUE(t.has_value()) << testing::PrintToString(roots);
            ASSERT_NEAR(*t, *wanted, 1e-8) << testing::PrintToString(roots);
        }
    }
}

TEST(FirstDescentAtRandom, IsRightToTheLastPlaces) {
    if (LDBL_MANT_DIG < 64) GTEST_SKIP() << "long double is no better than double here";
    Random random(3);
    int found = 0;
    for (int k = 0; k < 20'000; ++k) {
        Coefficients c(4 + random.bits() % 4);
        for (double& x : c) x = random.normal();
        c[0] = std::fabs(c[0]);
        const std::optional<double> t = first_descent(c, 2);
        if (!t || *t == 0) continue;
        long double low = *t * (1 - 1e-9L), high = *t * (1 + 1e-9L);
        if (!(value(c, low) > 0 && value(c, high) < 0)) continue;  // all but a touch
        for (int n = 0; n < 60; ++n) (value(c, 0.5L * (low + high)) > 0 ? low : high) = 0.5L * (low + high);
        // How far long double itself may place the root.
        const long double slope = (value(c, *t * (1 + 1e-9L)) - value(c, *t * (1 - 1e-9L))) / (2e-9L * *t);
        const long double doubt = 16 * LDBL_EPSILON * size(c, *t) / std::fabs(slope);
        ASSERT_LE(std::fabs(low - *t), 1.01L * *t * DBL_EPSILON + doubt) << testing::PrintToString(c);
        ++found;
    }
    EXPECT_GT(found, 5'000);
}

TEST(FirstDescent, AnExactTouchIsNoImpactWhereverItIs) {
    // (p t - q)^2 (t^2 + r) and (p t - q)^2 (t + r): exact coefficients, the touch itself mostly between two doubles.
    for (double p = 1; p <= 40; ++p) {
        for (double q = 1; q <= 40; ++q) {
            const Coefficients touch{q * q, -2 * p * q, p * p};
            ASSERT_FALSE(first_descent(touch, infinity).has_value()) << p << ' ' << q;
            for (double r = 1; r <= 9; ++r) {
                ASSERT_FALSE(first_descent(times(touch, {r, 0, 1}), infinity).has_value()) << p << ' ' << q << ' ' << r;
                ASSERT_FALSE(first_descent(times(touch, {r, 1}), infinity).has_value()) << p << ' ' << q << ' ' << r;
            }
        }
    }
}

TEST(FirstDescent, ThreefoldRootIsFoundAsWellAsItIsDetermined) {
    // (1 - t)^3 is below 1e-30 about its root, which is where even doubled precision ends.
    const std::optional<double> t = first_descent(Coefficients{1, -3, 3, -1}, 10);
    ASSERT_TRUE(t.has_value());
    EXPECT_NEAR(*t, 1, 1e-10);
}

TEST(FirstDescent, TwoDiscsInTheirOwnGravity) {
    // Centres at (3 - 3t, t - t^2) relative to each other, radii that add up to 1: a quartic that starts apart.
    const Coefficients distance = times({3, -3}, {3, -3}), height = times({0, 1, -1}, {0, 1, -1});
    Coefficients gap(5);
    for (std::size_t k = 0; k < 5; ++k) gap[k] = (k < 3 ? distance[k] : 0) + height[k];
    gap[0] -= 1;
    const std::optional<double> t = first_descent(gap, 10);
    ASSERT_TRUE(t.has_value());
    const double x = 3 - 3 * *t, y = *t - *t * *t;
    EXPECT_NEAR(x * x + y * y, 1, 1e-15);
    EXPECT_LT(*t, 1);
}

}  // namespace
