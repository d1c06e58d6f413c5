#include "math/block_matrix.hpp"

#include <algorithm>
#include <iterator>

namespace carom {

namespace {

using Block = BlockMatrix::Block;
using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours(std::size_t n, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    Neighbours near(n);
    for (const auto& [a, b] : couplings) near[a].push_back(b), near[b].push_back(a);
    for (auto& list : near) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return near;
}

/// Takes a row out of a graph: its neighbours become neighbours of one another.
void eliminate(std::uint32_t row, Neighbours& near) {
    std::vector<std::uint32_t> joined;
    for (const std::uint32_t i : near[row]) {
        joined.clear();
        std::set_union(near[i].begin(), near[i].end(), near[row].begin(), near[row].end(), std::back_inserter(joined));
        std::erase_if(joined, [i, row](std::uint32_t j) { return j == i || j == row; });
        near[i].swap(joined);
    }
}

/// In place: L below the diagonal and 1 / D on it, of L D Lᵀ.
void factor_block(Block& m) {
    auto& a = m.at;
    a[0][0] = 1 / a[0][0];
    const double l10 = a[1][0] * a[0][0], l20 = a[2][0] * a[0][0];
    a[1][1] = 1 / (a[1][1] - l10 * a[1][0]);
    const double c21 = a[2][1] - l20 * a[1][0], l21 = c21 * a[1][1];
    a[2][2] = 1 / (a[2][2] - l20 * a[2][0] - l21 * c21);
    a[1][0] = l10, a[2][0] = l20, a[2][1] = l21;
}
/// x = (L D Lᵀ)⁻¹ x
void solve_block(const Block& m, double* x) {
    const auto& a = m.at;
    x[1] -= a[1][0] * x[0];
    x[2] -= a[2][0] * x[0] + a[2][1] * x[1];
    x[0] *= a[0][0], x[1] *= a[1][1], x[2] *= a[2][2];
    x[1] -= a[2][1] * x[2];
    x[0] -= a[1][0] * x[1] + a[2][0] * x[2];
}
/// c −= a bᵀ
void subtract(Block& c, const Block& a, const Block& b) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            c.at[i][j] -= a.at[i][0] * b.at[j][0] + a.at[i][1] * b.at[j][1] + a.at[i][2] * b.at[j][2];
}

}  // namespace

void BlockMatrix::analyse(std::size_t n, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    Neighbours near = neighbours(n, couplings);
    std::vector<bool> done(n, false);
    place_.assign(n, 0);
    row_at_.clear();
    for (std::size_t k = 0; k < n; ++k) {
        std::uint32_t least = 0;
        while (done[least]) ++least;
        for (std::uint32_t i = least + 1; i < n; ++i)
            if (!done[i] && near[i].size() < near[least].size()) least = i;
        done[least] = true;
        place_[least] = static_cast<std::uint32_t>(k);
        row_at_.push_back(least);
        eliminate(least, near);  // what is left in its own list are those eliminated later
    }
    column_.assign(1, 0);
    below_.clear();
    for (std::size_t k = 0; k < n; ++k) {
        const auto first = static_cast<std::ptrdiff_t>(below_.size());
        for (const std::uint32_t i : near[row_at_[k]]) below_.push_back(place_[i]);
        std::sort(below_.begin() + first, below_.end());
        column_.push_back(below_.size());
    }
    diagonal_.resize(n);
    blocks_.resize(below_.size());
    clear();
}

void BlockMatrix::clear() {
    std::fill(diagonal_.begin(), diagonal_.end(), Block{});
    std::fill(blocks_.begin(), blocks_.end(), Block{});
}

void BlockMatrix::add(std::uint32_t a, std::uint32_t b, double weight, const double* left, const double* right) {
    std::uint32_t row = place_[a], column = place_[b];
    if (row < column) std::swap(row, column), std::swap(left, right);
    const auto first = below_.begin() + static_cast<std::ptrdiff_t>(column_[column]);
    const auto last = below_.begin() + static_cast<std::ptrdiff_t>(column_[column + 1]);
    Block& block = row == column
                       ? diagonal_[row]
                       : blocks_[static_cast<std::size_t>(std::lower_bound(first, last, row) - below_.begin())];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) block.at[i][j] += weight * left[i] * right[j];
}

void BlockMatrix::factor() {
    for (std::size_t k = 0; k < diagonal_.size(); ++k) {
        factor_block(diagonal_[k]);
        const std::size_t first = column_[k], last = column_[k + 1];
        scaled_.assign(blocks_.begin() + static_cast<std::ptrdiff_t>(first),
                       blocks_.begin() + static_cast<std::ptrdiff_t>(last));
        for (Block& block : scaled_)
            for (auto& row : block.at) solve_block(diagonal_[k], row);
        for (std::size_t q = first; q < last; ++q) {
            const std::uint32_t j = below_[q];
            subtract(diagonal_[j], scaled_[q - first], blocks_[q]);
            std::size_t at = column_[j];
            for (std::size_t p = q + 1; p < last; ++p) {
                while (below_[at] != below_[p]) ++at;
                subtract(blocks_[at], scaled_[p - first], blocks_[q]);
            }
        }
        std::copy(scaled_.begin(), scaled_.end(), blocks_.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

void BlockMatrix::solve(std::vector<double>& x) {
    const std::size_t n = diagonal_.size();
    auto& y = ordered_;
    y.resize(3 * n);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < 3; ++i) y[3 * k + i] = x[3 * row_at_[k] + i];
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t p = column_[k]; p < column_[k + 1]; ++p)
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) y[3 * below_[p] + i] -= blocks_[p].at[i][j] * y[3 * k + j];
    for (std::size_t k = n; k-- > 0;) {
        double* z = &y[3 * k];
        solve_block(diagonal_[k], z);
        for (std::size_t p = column_[k]; p < column_[k + 1]; ++p)
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) z[j] -= blocks_[p].at[i][j] * y[3 * below_[p] + i];
    }
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < 3; ++i) x[3 * row_at_[k] + i] = y[3 * k + i];
}

}  // namespace carom
