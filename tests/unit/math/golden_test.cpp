// The same bits everywhere. The hashes were the same from g++ 12 (-O0, -O2, -O3 -march=native -fno-tree-slp-vectorize),
// clang 14 (-O2, -O3 -march=native) and emscripten 3.1.6 (-O3, with and without -msimd128), all -ffp-contract=off. A
// change of one on purpose changes every stored trajectory that used the function.
#include "golden.hpp"

#include <gtest/gtest.h>

namespace {

using carom::golden::Row;

TEST(Elementary, GivesTheSameBitsEverywhere) {
    carom::golden::each([](const Row& row) { EXPECT_EQ(row.found, row.wanted) << row.name; });
}

}  // namespace
