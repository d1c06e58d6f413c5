// The order in which rows of blocks are eliminated, and solves with the factor.
#include "math/block_matrix.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace carom {
namespace {

using Couplings = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Couplings chain(std::uint32_t rows) {
    Couplings pairs;
    for (std::uint32_t i = 0; i + 1 < rows; ++i) pairs.emplace_back(i, i + 1);
    return pairs;
}

// What one end of a chain waits for in a solve, the other uses.
TEST(BlockMatrix, EndsOfAChainAreTakenByTurns) {
    BlockMatrix<1> matrix;
    matrix.analyse(6, chain(6));
    EXPECT_EQ(std::vector<std::uint32_t>(matrix.place().begin(), matrix.place().end()),
              (std::vector<std::uint32_t>{0, 2, 4, 5, 3, 1}));
}

TEST(BlockMatrix, ChainsAndTreesBringNoFill) {
    BlockMatrix<1> matrix;
    matrix.analyse(50, chain(50));
    EXPECT_EQ(matrix.below_count(), 49u);
    matrix.analyse(7, Couplings{{0, 1}, {0, 2}, {1, 3}, {1, 4}, {2, 5}, {2, 6}});
    EXPECT_EQ(matrix.below_count(), 6u);
    matrix.analyse(4, Couplings{{0, 1}, {1, 2}, {2, 3}, {3, 0}});
    EXPECT_EQ(matrix.below_count(), 5u) << "a ring brings one";
}

// With 3 on the diagonal and −1 beside it, against what it was multiplied with.
TEST(BlockMatrix, SolvesAChain) {
    constexpr int N = 2;
    constexpr std::uint32_t rows = 9;
    BlockMatrix<N> matrix;
    matrix.analyse(rows, chain(rows));
    const double one[][N] = {{1, 0}, {0, 1}};
    for (std::uint32_t i = 0; i < rows; ++i)
        for (const auto& e : one) {
            matrix.add(i, i, 3, e, e);
            if (i + 1 < rows) matrix.add(i, i + 1, -1, e, e);
        }
    const auto x = [](std::uint32_t i, std::uint32_t r) { return i < rows ? 1.0 + i + 0.5 * r : 0.0; };
    std::vector<double> y;
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t r = 0; r < N; ++r) y.push_back(3 * x(i, r) - x(i - 1, r) - x(i + 1, r));
    matrix.factor();
    matrix.solve(y);
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t r = 0; r < N; ++r) EXPECT_NEAR(y[N * i + r], x(i, r), 1e-14 * rows);
}

}  // namespace
}  // namespace carom
