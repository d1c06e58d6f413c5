#include "math/block_matrix.hpp"

#include <algorithm>
#include <cstring>

#include "math/elimination.hpp"
#include "simd/isa.hpp"

namespace carom {

template <int N>
void BlockMatrix<N>::analyse(std::size_t n, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    Elimination elimination = eliminate(n, couplings);
    work_ = elimination.work();
    std::size_t most = 0;
    for (std::size_t k = 0; k < n; ++k) most = std::max(most, elimination.count_below(k));
    given_.resize(most);
    row_at_ = std::move(elimination.rows), column_ = std::move(elimination.column);
    below_ = std::move(elimination.below);
    place_.resize(n);
    for (std::uint32_t k = 0; k < n; ++k) place_[row_at_[k]] = k;
    diagonal_.assign(n, Block{});
    blocks_.assign(below_.size(), Block{});
    find_supernodes();
}

template <int N>
void BlockMatrix<N>::clear() {
    std::fill(diagonal_.begin(), diagonal_.end(), Block{});
    std::fill(blocks_.begin(), blocks_.end(), Block{});
}

namespace {

template <int N>
void add_to(BlockOf<double, N>& block, double weight, const double* left, const double* right) {
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) block.at[j][i] += weight * left[i] * right[j];
}

}  // namespace

template <int N>
void BlockMatrix<N>::add(Place place, double weight, const double* left, const double* right) {
    if (place.mirrored) std::swap(left, right);
    add_to<N>(block(place), weight, left, right);
}
template <int N>
void BlockMatrix<N>::add(std::uint32_t row, double weight, const double* left, const double* right) {
    add_to<N>(diagonal(row), weight, left, right);
}

template <int N>
typename BlockMatrix<N>::Place BlockMatrix<N>::place_of(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t row = std::max(place_[a], place_[b]), column = std::min(place_[a], place_[b]);
    const auto first = below_.begin() + static_cast<std::ptrdiff_t>(column_[column]);
    const auto last = below_.begin() + static_cast<std::ptrdiff_t>(column_[column + 1]);
    return {static_cast<std::uint32_t>(std::lower_bound(first, last, row) - below_.begin()), place_[a] < place_[b]};
}

namespace {

const SupernodeKernel& supernode_kernel() {
    return kernel_in_use<baseline_supernode_kernel, avx2_supernode_kernel, avx512_supernode_kernel>();
}
constexpr std::size_t first_whole(std::size_t row) { return row / supernode_rows * supernode_rows; }
constexpr std::size_t whole_rows(std::size_t rows) { return first_whole(rows + supernode_rows - 1); }

/// A block among dense columns, that begin with the first one of its own. (g++ calls memmove for std::copy of so few.)
template <int N>
void lay(const BlockOf<double, N>& block, std::size_t row, std::size_t stride, double* columns) {
    for (std::size_t j = 0; j < N; ++j) std::memcpy(columns + j * stride + N * row, block.at[j], sizeof block.at[j]);
}
template <int N>
void take(BlockOf<double, N>& block, std::size_t row, std::size_t stride, const double* columns) {
    for (std::size_t j = 0; j < N; ++j) std::memcpy(block.at[j], columns + j * stride + N * row, sizeof block.at[j]);
}

}  // namespace

template <int N>
void BlockMatrix<N>::find_supernodes() {
    constexpr std::size_t worth = 8;  // rows: fewer are eliminated sooner where they are
    supernodes_.clear(), targets_.clear();
    const auto below = [this](std::size_t k) { return column_[k + 1] - column_[k]; };
    std::size_t room = 0;
    for (std::size_t first = 0, last = 0; first < diagonal_.size(); first = last) {
        while (++last < diagonal_.size() && below(last - 1) == below(last) + 1 && below_[column_[last - 1]] == last) {
        }
        const std::size_t rows = 1 + below(first);
        const bool is_dense = last - first > 1 && rows >= worth;
        supernodes_.push_back({first, last - first, rows, targets_.size(), is_dense});
        if (!is_dense) continue;
        room = std::max(room, N * (2 * (last - first) + 1) * whole_rows(N * rows));
        for (std::size_t q = column_[last - 1]; q < column_[last]; ++q)
            for (std::size_t p = q + 1, at = column_[below_[q]]; p < column_[last]; ++p) {
                while (below_[at] != below_[p]) ++at;
                targets_.push_back(static_cast<std::uint32_t>(at));
            }
    }
    panel_.resize(room);
}

template <int N>
void BlockMatrix<N>::factor_supernode(const Columns& columns) {
    const std::size_t count = columns.count, rows = columns.rows;
    const std::size_t stride = whole_rows(N * rows), of_block = N * stride;
    const Supernode node{panel_.data(), panel_.data() + count * of_block, stride};
    const auto each_block = [&](const auto& act) {
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t row = k + 1, q = column_[columns.first + k]; row < rows; ++row) act(blocks_[q++], row, k);
    };
    each_block([&](const Block& b, std::size_t row, std::size_t k) { lay(b, row, stride, node.given + k * of_block); });
    for (std::size_t k = 0; k < count; ++k) {
        Block& diagonal = diagonal_[columns.first + k];
        double* const own = node.given + k * of_block;
        lay(diagonal, k, stride, own);
        supernode_kernel().subtract[N - 1](node, k, N * k, first_whole(N * k), own);
        take(diagonal, k, stride, own);
        factor_block(diagonal.at);
        supernode_kernel().scale[N - 1](node, &diagonal.at[0][0], k, first_whole(N * (k + 1)));
    }
    each_block([&](Block& b, std::size_t row, std::size_t k) { take(b, row, stride, node.scaled + k * of_block); });
    subtract_from_later(columns, node);
}

template <int N>
void BlockMatrix<N>::subtract_from_later(const Columns& columns, const Supernode& node) {
    const std::size_t rows = columns.rows;
    double* const later = node.scaled + N * columns.count * node.stride;
    const std::uint32_t* target = targets_.data() + columns.targets;
    for (std::size_t row = columns.count; row < rows; ++row) {
        Block& diagonal = diagonal_[below_[column_[columns.first] + row - 1]];
        const auto each_block = [&](const auto& act) {
            act(diagonal, row);
            for (std::size_t p = row + 1; p < rows; ++p) act(blocks_[target[p - row - 1]], p);
        };
        each_block([&](const Block& b, std::size_t p) { lay(b, p, node.stride, later); });
        supernode_kernel().subtract[N - 1](node, columns.count, N * row, first_whole(N * row), later);
        each_block([&](Block& b, std::size_t p) { take(b, p, node.stride, later); });
        target += rows - row - 1;
    }
}

template <int N>
void BlockMatrix<N>::factor() {
    for (const Columns& columns : supernodes_) {
        if (columns.is_dense) {
            factor_supernode(columns);
            continue;
        }
        for (std::size_t k = columns.first; k < columns.first + columns.count; ++k)
            factor_column(order(), k, diagonal_.data(), blocks_.data(), given_.data());
    }
}

template <int N>
void BlockMatrix<N>::solve(std::span<double> x) {
    const std::size_t n = diagonal_.size();
    auto& y = ordered_;
    y.resize(N * n);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < N; ++i) y[N * k + i] = x[N * row_at_[k] + i];
    solve_in_order(y.data());
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < N; ++i) x[N * row_at_[k] + i] = y[N * k + i];
}

template <int N>
void BlockMatrix<N>::solve_in_order(double* y) const {
    solve_blocks(order(), diagonal_.data(), blocks_.data(), y);
}

template class BlockMatrix<1>;
template class BlockMatrix<2>;
template class BlockMatrix<3>;
template class BlockMatrix<4>;

}  // namespace carom
