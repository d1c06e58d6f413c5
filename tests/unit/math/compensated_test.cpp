#include "math/compensated.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "carom/random.hpp"
#include "math/double_double.hpp"

namespace {

using carom::CompensatedSum;
using carom::DoubleDouble;
using carom::Random;

TEST(Compensated, TwoSumKeepsTheWholeError) {
    const DoubleDouble sum = carom::two_sum(1e-20, 1);
    EXPECT_EQ(sum.high, 1);
    EXPECT_EQ(sum.low, 1e-20);
    // In integers the whole sum can be had: 53-bit numbers at most 2^9 apart in size.
    Random random(1);
    for (int k = 0; k < 10'000; ++k) {
        const auto a = static_cast<std::int64_t>(random.bits() >> 11);
        const auto b = static_cast<std::int64_t>(random.bits() >> 11) << 9;
        const DoubleDouble s = carom::two_sum(static_cast<double>(a), -static_cast<double>(b));
        ASSERT_EQ(static_cast<std::int64_t>(s.high) + static_cast<std::int64_t>(s.low), a - b);
        ASSERT_EQ(s.high, static_cast<double>(a) - static_cast<double>(b));
    }
}

TEST(Compensated, FastTwoSumEqualsTwoSumForOrderedTerms) {
    Random random(2);
    for (int k = 0; k < 10'000; ++k) {
        const double b = random.uniform(-1, 1),
                     a = std::copysign(std::fabs(b) + random.uniform(0, 1e3), random.normal());
        const DoubleDouble fast = carom::fast_two_sum(a, b), whole = carom::two_sum(a, b);
        ASSERT_EQ(fast.high, whole.high);
        ASSERT_EQ(fast.low, whole.low);
    }
}

TEST(Compensated, TwoProductKeepsTheWholeError) {
    Random random(3);
    for (int k = 0; k < 10'000; ++k) {
        const double a = random.uniform(-1, 1), b = random.uniform(-1e9, 1e9);
        const DoubleDouble product = carom::two_product(a, b);
        ASSERT_EQ(product.high, a * b);
        ASSERT_EQ(product.low, std::fma(a, b, -product.high));
    }
}

TEST(Compensated, QuotientAndRootCarryAHundredBits) {
    const DoubleDouble third = carom::divide({1, 0}, {3, 0});
    EXPECT_EQ(third.high, 0x1.5555555555555p-2);
    EXPECT_EQ(third.low, 0x1.5555555555555p-56);
    const DoubleDouble root = carom::square_root({2, 0});
    EXPECT_EQ(root.high, 0x1.6a09e667f3bcdp+0);
    EXPECT_NEAR(root.low / -0x1.bdd3413b26456p-54, 1, 0x1p-45);
    EXPECT_EQ(carom::square_root({0, 0}).high, 0);
    // The low parts of the operands count.
    EXPECT_EQ(carom::divide({1, 0x1p-60}, {1, 0}).low, 0x1p-60);
    EXPECT_EQ(carom::divide({1, 0}, {1, 0x1p-60}).low, -0x1p-60);
    EXPECT_EQ(carom::square_root({1, 0x1p-60}).low, 0x1p-61);
}

TEST(CompensatedSum, KeepsWhatAPlainSumLoses) {
    CompensatedSum sum;
    double plain = 0;
    for (int k = 0; k < 1'000'000; ++k) sum.add(0.1), plain += 0.1;
    EXPECT_EQ(sum.value(), 100000);
    EXPECT_GT(std::fabs(plain - 100000), 1e-7);
}

TEST(CompensatedSum, KeepsTheSmallSumWhenALargeTermComesAndGoes) {
    CompensatedSum sum;  // Kahan's own sum gives 0 here
    for (double term : {1.0, 1e100, 1.0, -1e100}) sum += term;
    EXPECT_EQ(sum.value(), 2);
}

TEST(CompensatedSum, StartsWhereItIsTold) {
    CompensatedSum sum(1e16);
    sum.add(1);
    sum.add(1);
    EXPECT_EQ(sum.value(), 1e16 + 2);
    EXPECT_EQ(CompensatedSum().value(), 0);
}

TEST(CompensatedSum, AnInfiniteSumIsInfiniteAndNotNan) {
    CompensatedSum sum;
    sum.add(1);
    sum.add(std::numeric_limits<double>::infinity());
    sum.add(1);
    EXPECT_EQ(sum.value(), std::numeric_limits<double>::infinity());
    sum.add(-std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(sum.value()));
}

}  // namespace
