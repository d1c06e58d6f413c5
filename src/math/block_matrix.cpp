#include "math/block_matrix.hpp"

#include <algorithm>
#include <iterator>
#include <set>

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

/// In place: L below the diagonal and 1 / D on it, of L D Lᵀ.
template <int N>
void factor_block(double (&a)[N][N]) {
    double c[N][N];  // L D
    for (int j = 0; j < N; ++j) {
        for (int k = 0; k < j; ++k) {
            c[j][k] = a[j][k];
            for (int l = 0; l < k; ++l) c[j][k] -= a[j][l] * c[k][l];
            a[j][k] = c[j][k] * a[k][k];
        }
        double d = a[j][j];
        for (int k = 0; k < j; ++k) d -= a[j][k] * c[j][k];
        a[j][j] = 1 / d;
    }
}
/// x = (L D Lᵀ)⁻¹ x
template <int N>
void solve_block(const double (&a)[N][N], double* x) {
    for (int i = 1; i < N; ++i) {
        double sum = a[i][0] * x[0];
        for (int k = 1; k < i; ++k) sum += a[i][k] * x[k];
        x[i] -= sum;
    }
    for (int i = 0; i < N; ++i) x[i] *= a[i][i];
    for (int i = N - 2; i >= 0; --i) {
        double sum = a[i + 1][i] * x[i + 1];
        for (int k = i + 2; k < N; ++k) sum += a[k][i] * x[k];
        x[i] -= sum;
    }
}
/// c −= a bᵀ
template <int N>
void subtract(double (&c)[N][N], const double (&a)[N][N], const double (&b)[N][N]) {
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) {
            double sum = a[i][0] * b[j][0];
            for (int k = 1; k < N; ++k) sum += a[i][k] * b[j][k];
            c[i][j] -= sum;
        }
}

}  // namespace

template <int N>
void BlockMatrix<N>::analyse(std::size_t n, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings) {
    Neighbours near = neighbours(n, couplings);
    using Left = std::pair<std::size_t, std::uint32_t>;  // by degree
    std::set<Left, std::less<>, ScratchAllocator<Left>> left;
    for (std::uint32_t i = 0; i < n; ++i) left.emplace(near[i].size(), i);
    place_.assign(n, 0);
    row_at_.clear();
    while (!left.empty()) {
        const std::uint32_t least = left.begin()->second;
        left.erase(left.begin());
        place_[least] = static_cast<std::uint32_t>(row_at_.size());
        row_at_.push_back(least);
        for (const std::uint32_t i : near[least]) left.erase({near[i].size(), i});
        eliminate(least, near);  // what is left in its own list are those eliminated later
        for (const std::uint32_t i : near[least]) left.emplace(near[i].size(), i);
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
    for (std::size_t k = 0; k < diagonal_.size(); ++k) {
        factor_block(diagonal_[k].at);
        const std::size_t first = column_[k], last = column_[k + 1];
        scaled_.resize(last - first);
        for (std::size_t q = first; q < last; ++q) {
            scaled_[q - first] = blocks_[q];
            for (auto& row : scaled_[q - first].at) solve_block(diagonal_[k].at, row);
        }
        for (std::size_t q = first; q < last; ++q) {
            const std::uint32_t j = below_[q];
            subtract(diagonal_[j].at, scaled_[q - first].at, blocks_[q].at);
            std::size_t at = column_[j];
            for (std::size_t p = q + 1; p < last; ++p) {
                while (below_[at] != below_[p]) ++at;
                subtract(blocks_[at].at, scaled_[p - first].at, blocks_[q].at);
            }
        }
        std::copy(scaled_.begin(), scaled_.end(), blocks_.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

template <int N>
void BlockMatrix<N>::solve(std::span<double> x) {
    const std::size_t n = diagonal_.size();
    auto& y = ordered_;
    y.resize(N * n);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < N; ++i) y[N * k + i] = x[N * row_at_[k] + i];
    double z[N];
    for (std::size_t k = 0; k < n; ++k) {
        double* const own = &y[N * k];
        std::copy(own, own + N, z);
        for (std::size_t p = column_[k]; p < column_[k + 1]; ++p) {
            const auto& block = blocks_[p].at;
            double* const to = &y[N * below_[p]];
            for (int i = 0; i < N; ++i) {
                double sum = block[i][0] * z[0];
                for (int j = 1; j < N; ++j) sum += block[i][j] * z[j];
                to[i] -= sum;
            }
        }
        solve_block(diagonal_[k].at, own);
    }
    for (std::size_t k = n; k-- > 0;) {
        double* const own = &y[N * k];
        std::copy(own, own + N, z);
        for (std::size_t p = column_[k]; p < column_[k + 1]; ++p) {
            const auto& block = blocks_[p].at;
            const double* const from = &y[N * below_[p]];
            for (int j = 0; j < N; ++j) {
                double sum = block[0][j] * from[0];
                for (int i = 1; i < N; ++i) sum += block[i][j] * from[i];
                z[j] -= sum;
            }
        }
        std::copy(z, z + N, own);
    }
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < N; ++i) x[N * row_at_[k] + i] = y[N * k + i];
}

template class BlockMatrix<1>;
template class BlockMatrix<2>;
template class BlockMatrix<3>;
template class BlockMatrix<4>;

}  // namespace carom
