// The order in which rows of blocks are eliminated, and solves with the factor.
#include "math/block_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simd/isa.hpp"

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

// The last row of its twelve generations ends so that whatever parts it evenly takes many rows, as of a sheet.
TEST(BlockMatrix, ALargeTreeThatNoFewRowsPartBringsNoFill) {
    constexpr std::uint32_t rows = 3000;
    Couplings pairs;
    for (std::uint32_t i = 1; i < rows; ++i) pairs.emplace_back((i - 1) / 2, i);
    BlockMatrix<1> matrix;
    matrix.analyse(rows, pairs);
    EXPECT_EQ(matrix.below_count(), rows - 1);
}

/// A sheet of n × n bodies hinged to their neighbours: hinges of a body are coupled.
Couplings sheet(std::uint32_t n, std::uint32_t& hinges) {
    std::vector<std::vector<std::uint32_t>> of_body(std::size_t{n} * n);
    hinges = 0;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            if (x > 0) of_body[y * n + x - 1].push_back(hinges), of_body[y * n + x].push_back(hinges++);
            if (y > 0) of_body[y * n + x - n].push_back(hinges), of_body[y * n + x].push_back(hinges++);
        }
    Couplings pairs;
    for (const auto& list : of_body)
        for (std::size_t i = 0; i < list.size(); ++i)
            for (std::size_t j = i + 1; j < list.size(); ++j) pairs.emplace_back(list[i], list[j]);
    return pairs;
}

// By least degree its factor has 178 000 blocks and makes 690 products a row; cut along its sides 121 000 and 287.
TEST(BlockMatrix, ALargeSheetIsDissected) {
    BlockMatrix<1> matrix;
    std::uint32_t hinges = 0;
    const Couplings pairs = sheet(60, hinges);
    matrix.analyse(hinges, pairs);
    EXPECT_LT(matrix.below_count(), 125'000u);
    EXPECT_LT(matrix.work_per_row(), 300u);
    const double one = 1;
    for (std::uint32_t i = 0; i < hinges; ++i) matrix.add(i, 7, &one, &one);
    for (const auto& [a, b] : pairs) matrix.add(matrix.place_of(a, b), -1, &one, &one);
    std::vector<double> x(hinges, 0.0);
    for (std::uint32_t i = 0; i < hinges; ++i) x[i] = 7.0 * (1 + i % 5);
    for (const auto& [a, b] : pairs) x[a] -= 1 + b % 5, x[b] -= 1 + a % 5;
    matrix.factor();
    matrix.solve(x);
    for (std::uint32_t i = 0; i < hinges; ++i) ASSERT_NEAR(x[i], 1 + i % 5, 1e-12);
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
            matrix.add(i, 3, e, e);
            if (i + 1 < rows) matrix.add(matrix.place_of(i, i + 1), -1, e, e);
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

/// A sheet's matrix with numbers that have nothing to do with one another.
template <int N>
BlockMatrix<N> sheet_of_numbers() {
    BlockMatrix<N> matrix;
    std::uint32_t hinges = 0;
    const Couplings pairs = sheet(9, hinges);
    matrix.analyse(hinges, pairs);
    auto numbers = [n = 0](double(&out)[N]) mutable {
        for (double& x : out) x = std::sin(++n);
    };
    double left[N], right[N];
    for (std::uint32_t i = 0; i < hinges; ++i)
        for (int r = 0; r < N; ++r) {
            for (int k = 0; k < N; ++k) left[k] = k == r;
            matrix.add(i, 9 * N + i % 7, left, left);
        }
    for (const auto& [a, b] : pairs) numbers(left), numbers(right), matrix.add(matrix.place_of(a, b), -1, left, right);
    return matrix;
}
template <int N>
void expect_the_bits_of_single_columns() {
    BlockMatrix<N> matrix = sheet_of_numbers<N>();
    using Blocks = std::vector<BlockOf<double, N>>;
    Blocks diagonal(matrix.diagonals(), matrix.diagonals() + matrix.order().rows);
    Blocks blocks(matrix.below_diagonals(), matrix.below_diagonals() + matrix.below_count());
    Blocks given(matrix.most_below());
    factor_blocks(matrix.order(), diagonal.data(), blocks.data(), given.data());
    matrix.factor();
    for (std::size_t i = 0; i < diagonal.size(); ++i)
        for (int r = 0; r < N; ++r)
            for (int c = 0; c <= r; ++c) ASSERT_EQ(matrix.diagonals()[i].at[c][r], diagonal[i].at[c][r]) << N;
    for (std::size_t i = 0; i < blocks.size(); ++i)
        for (int r = 0; r < N; ++r)
            for (int c = 0; c < N; ++c) ASSERT_EQ(matrix.below_diagonals()[i].at[c][r], blocks[i].at[c][r]) << N;
}
// Mechanisms that are alike are factored in lanes, column by column, and what a lane has is what one alone would have.
TEST(BlockMatrix, DenseColumnsHaveTheBitsOfSingleOnes) {
    for (const Isa which : available_isas()) {
        use_isa(which);
        expect_the_bits_of_single_columns<1>();
        expect_the_bits_of_single_columns<2>();
        expect_the_bits_of_single_columns<3>();
        expect_the_bits_of_single_columns<4>();
    }
    use_isa({});
}

}  // namespace
}  // namespace carom
