#include "math/block_matrix.hpp"

#include <algorithm>

#include "math/elimination.hpp"

namespace carom {

template <int N>
void BlockMatrix<N>::analyse(std::size_t n, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    const Elimination elimination = eliminate(n, couplings);
    row_at_ = elimination.rows;
    place_.resize(n);
    for (std::uint32_t k = 0; k < n; ++k) place_[row_at_[k]] = k;
    column_.assign(1, 0);
    below_.clear();
    std::size_t most = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const auto first = static_cast<std::ptrdiff_t>(below_.size());
        for (const std::uint32_t i : elimination.later[row_at_[k]]) below_.push_back(place_[i]);
        std::sort(below_.begin() + first, below_.end());
        column_.push_back(below_.size());
        most = std::max(most, elimination.later[row_at_[k]].size());
    }
    work_ = elimination.work();
    scaled_.resize(most);
    diagonal_.resize(n);
    blocks_.resize(below_.size());
    clear();
}

template <int N>
void BlockMatrix<N>::clear() {
    std::fill(diagonal_.begin(), diagonal_.end(), Block{});
    std::fill(blocks_.begin(), blocks_.end(), Block{});
}

template <int N>
void BlockMatrix<N>::add(std::uint32_t a, std::uint32_t b, double weight, const double* left, const double* right) {
    const Place place = a == b ? Place{} : place_of(a, b);
    if (place.mirrored) std::swap(left, right);
    Block& to = a == b ? diagonal(a) : block(place);
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) to.at[i][j] += weight * left[i] * right[j];
}

template <int N>
typename BlockMatrix<N>::Place BlockMatrix<N>::place_of(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t row = std::max(place_[a], place_[b]), column = std::min(place_[a], place_[b]);
    const auto first = below_.begin() + static_cast<std::ptrdiff_t>(column_[column]);
    const auto last = below_.begin() + static_cast<std::ptrdiff_t>(column_[column + 1]);
    return {static_cast<std::uint32_t>(std::lower_bound(first, last, row) - below_.begin()), place_[a] < place_[b]};
}

template <int N>
void BlockMatrix<N>::factor() {
    factor_blocks(order(), diagonal_.data(), blocks_.data(), scaled_.data());
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
