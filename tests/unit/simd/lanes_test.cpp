// The lanes of the instruction set that the tests are compiled for; the others are tested through the kernels.
#include "simd/lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace carom;

TEST(Lanes, LoadAndStorePairs) {
    double xy[2 * lanes + 2], out[2 * lanes + 2];
    for (int i = 0; i < 2 * lanes + 2; ++i) xy[i] = i, out[i] = -1;
    const Lanes2 from = pairs_from(xy + 2);
    const Lanes2 back = pairs(xy, [](int lane) { return lanes - lane; });
    for (int lane = 0; lane < lanes; ++lane) {
        EXPECT_EQ(from.x[lane], 2 * lane + 2);
        EXPECT_EQ(from.y[lane], 2 * lane + 3);
        EXPECT_EQ(back.x[lane], 2 * (lanes - lane));
        EXPECT_EQ(back.y[lane], 2 * (lanes - lane) + 1);
    }
    store_pairs(out, from, 1);
    EXPECT_EQ(out[1], 3);
    EXPECT_EQ(out[2], -1);  // no more than was asked for
    store_pairs(out, from, lanes);
    for (int i = 0; i < 2 * lanes; ++i) EXPECT_EQ(out[i], xy[i + 2]);
    EXPECT_EQ(out[2 * lanes], -1);
}

TEST(Lanes, ComputeAsDoublesDo) {
    for (const double a : {0.0, 2.0, 1e-310, 3e300, std::numeric_limits<double>::infinity()}) {
        const Lanes root = square_root(all(a)), chosen = select(all(a) > all(1), all(5), all(6));
        for (int lane = 0; lane < lanes; ++lane) {
            EXPECT_EQ(root[lane], std::sqrt(a));
            EXPECT_EQ(chosen[lane], a > 1 ? 5 : 6);
        }
    }
    const uint32_t whole[8] = {0, 1, 2147483647, 7, 8, 9, 10, 11};
    for (int lane = 0; lane < lanes; ++lane) EXPECT_EQ(whole_numbers(whole)[lane], whole[lane]);
}
