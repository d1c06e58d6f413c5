#include "math/block_matrix.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

namespace carom {

namespace {

using Neighbours = Scratch<Scratch<std::uint32_t>>;

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
    Scratch<std::uint32_t> joined;
    for (const std::uint32_t i : near[row]) {
        joined.clear();
        std::set_union(near[i].begin(), near[i].end(), near[row].begin(), near[row].end(), std::back_inserter(joined));
        std::erase_if(joined, [i, row](std::uint32_t j) { return j == i || j == row; });
        near[i].swap(joined);
    }
}

}  // namespace

template <int N>
void BlockMatrix<N>::analyse(std::size_t n, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    Neighbours near = neighbours(n, couplings);
    // Rows of no more than one neighbour bring no fill, in whatever order: they are taken by turns, as they come to be
    // so, from all ends of a chain or a tree. What one end waits for in a factor or a solve, another uses.
    using Left = std::tuple<std::size_t, std::uint32_t, std::uint32_t>;  // by degree, by turn, by number
    std::set<Left, std::less<>, ScratchAllocator<Left>> left;
    Scratch<std::uint32_t> turn(n, 0);
    std::uint32_t turns = 0;
    const auto line_up = [&](std::uint32_t i) {
        if (near[i].size() <= 1) turn[i] = ++turns;
        left.emplace(near[i].size(), turn[i], i);
    };
    for (std::uint32_t i = 0; i < n; ++i) line_up(i);
    place_.assign(n, 0);
    row_at_.clear();
    while (!left.empty()) {
        const std::uint32_t least = std::get<2>(*left.begin());
        left.erase(left.begin());
        place_[least] = static_cast<std::uint32_t>(row_at_.size());
        row_at_.push_back(least);
        for (const std::uint32_t i : near[least]) left.erase({near[i].size(), turn[i], i});
        eliminate(least, near);  // what is left in its own list are those eliminated later
        for (const std::uint32_t i : near[least]) line_up(i);
    }
    column_.assign(1, 0);
    below_.clear();
    std::size_t most = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const auto first = static_cast<std::ptrdiff_t>(below_.size());
        for (const std::uint32_t i : near[row_at_[k]]) below_.push_back(place_[i]);
        std::sort(below_.begin() + first, below_.end());
        column_.push_back(below_.size());
        most = std::max(most, near[row_at_[k]].size());
    }
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
std::size_t BlockMatrix<N>::work_per_row() const {
    std::size_t sum = 0;
    for (std::size_t k = 0; k < diagonal_.size(); ++k) {
        const std::size_t below = column_[k + 1] - column_[k];
        sum += below * (below + 1) / 2;
    }
    return sum / std::max<std::size_t>(diagonal_.size(), 1);
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
