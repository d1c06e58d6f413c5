#include "math/rough.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom {
namespace {

TEST(Rough, LogarithmIsOffByAHundredthAndExactAtPowersOfTwo) {
    for (double x = 1e-300; x < 1e300; x *= 1.37) EXPECT_NEAR(rough_log2(x), std::log2(x), 0.0101) << x;
    for (int k = -1000; k < 1000; k += 37) EXPECT_EQ(rough_log2(std::ldexp(1, k)), k);
}

TEST(Rough, PowerIsOffByAThirdOfAPerCentAndExactAtWholeNumbers) {
    for (double x = -999; x < 999; x += 0.0373) EXPECT_NEAR(rough_exp2(x) / std::exp2(x), 1, 0.0035) << x;
    for (int k = -999; k < 1000; k += 37) EXPECT_EQ(rough_exp2(k), std::ldexp(1, k));
}

}  // namespace
}  // namespace carom
