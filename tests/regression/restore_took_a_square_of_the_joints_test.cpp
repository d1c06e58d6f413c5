// To restore a world of 40 000 joints took a second longer than it had to: each was looked for among all.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <chrono>
#include <cmath>

#include "solvers/mechanism.hpp"

namespace carom {
namespace {

/// For how long the joints of a restored state are looked for, at the least [s].
double shortest_search(std::uint32_t count) {
    double shortest = HUGE_VAL;
    for (int i = 0; i < 5; ++i) {
        Mechanisms mechanisms;
        for (std::uint32_t k = 1; k <= count; ++k) add(mechanisms, JointId{k}, Joint{});
        const auto start = std::chrono::steady_clock::now();
        keep_remembered(mechanisms, {});
        shortest = std::min(shortest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        EXPECT_EQ(mechanisms.joints.size(), count);
    }
    return shortest;
}

// Sixteen times as many take sixteen times as long, and up to a hundred where no cache holds them; they took 1300 times
// as long.
TEST(Restore, LooksForEachJointOnce) { EXPECT_LT(shortest_search(32000), 300 * shortest_search(2000)); }

}  // namespace
}  // namespace carom
