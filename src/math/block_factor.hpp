#pragma once
// The factor L D Lᵀ of a symmetric matrix of N × N blocks, and solves with it, for numbers or for lanes of them.
// Without std and with its functions in an unnamed namespace, for wide kernels include it (src/simd/lanes.hpp).

#include <stddef.h>
#include <stdint.h>

namespace carom {

template <class V, int N>
struct BlockOf {
    V at[N][N];
};

/// Which blocks there are: in each column, in the order of elimination, those below the diagonal.
struct BlockOrder {
    size_t rows;
    const size_t* column;   ///< where its blocks begin
    const uint32_t* below;  ///< the rows of these, ascending in each column
};

namespace {

/// In place: L below the diagonal and 1 / D on it, of L D Lᵀ.
template <class V, int N>
inline void factor_block(V (&a)[N][N]) {
    V c[N][N];  // L D
    for (int j = 0; j < N; ++j) {
        for (int k = 0; k < j; ++k) {
            c[j][k] = a[j][k];
            for (int l = 0; l < k; ++l) c[j][k] -= a[j][l] * c[k][l];
            a[j][k] = c[j][k] * a[k][k];
        }
        V d = a[j][j];
        for (int k = 0; k < j; ++k) d -= a[j][k] * c[j][k];
        a[j][j] = 1.0 / d;
    }
}
/// x = (L D Lᵀ)⁻¹ x
template <class V, int N>
inline void solve_block(const V (&a)[N][N], V* x) {
    for (int i = 1; i < N; ++i) {
        V sum = a[i][0] * x[0];
        for (int k = 1; k < i; ++k) sum += a[i][k] * x[k];
        x[i] -= sum;
    }
    for (int i = 0; i < N; ++i) x[i] *= a[i][i];
    for (int i = N - 2; i >= 0; --i) {
        V sum = a[i + 1][i] * x[i + 1];
        for (int k = i + 2; k < N; ++k) sum += a[k][i] * x[k];
        x[i] -= sum;
    }
}
/// c −= a bᵀ, or the lower half of it.
template <bool all, class V, int N>
inline void subtract(V (&c)[N][N], const V (&a)[N][N], const V (&b)[N][N]) {
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < (all ? N : i + 1); ++j) {
            V sum = a[i][0] * b[j][0];
            for (int k = 1; k < N; ++k) sum += a[i][k] * b[j][k];
            c[i][j] -= sum;
        }
}

/// Eliminates row k of a matrix, of which blocks on the diagonal need their lower half alone: its column becomes that
/// of the factor. There is room for a column of blocks in `scaled`.
template <class V, int N>
inline void factor_column(const BlockOrder& order, size_t k, BlockOf<V, N>* diagonal, BlockOf<V, N>* blocks,
                          BlockOf<V, N>* scaled) {
    factor_block(diagonal[k].at);
    const size_t first = order.column[k], last = order.column[k + 1];
    for (size_t q = first; q < last; ++q) {
        BlockOf<V, N> block = blocks[q];
        for (auto& row : block.at) solve_block(diagonal[k].at, row);
        scaled[q - first] = block;
    }
    for (size_t q = first; q < last; ++q) {
        const uint32_t j = order.below[q];
        subtract<false>(diagonal[j].at, scaled[q - first].at, blocks[q].at);
        size_t at = order.column[j];
        for (size_t p = q + 1; p < last; ++p) {
            while (order.below[at] != order.below[p]) ++at;
            subtract<true>(blocks[at].at, scaled[p - first].at, blocks[q].at);
        }
    }
    for (size_t q = first; q < last; ++q) blocks[q] = scaled[q - first];
}
/// Replaces a matrix by its factor.
template <class V, int N>
inline void factor_blocks(const BlockOrder& order, BlockOf<V, N>* diagonal, BlockOf<V, N>* blocks,
                          BlockOf<V, N>* scaled) {
    for (size_t k = 0; k < order.rows; ++k) factor_column(order, k, diagonal, blocks, scaled);
}

/// y = A⁻¹ y with that factor, in the order of elimination.
template <class V, int N>
inline void solve_blocks(const BlockOrder& order, const BlockOf<V, N>* diagonal, const BlockOf<V, N>* blocks, V* y) {
    V z[N];
    for (size_t k = 0; k < order.rows; ++k) {
        V* const own = &y[N * k];
        for (int i = 0; i < N; ++i) z[i] = own[i];
        for (size_t p = order.column[k]; p < order.column[k + 1]; ++p) {
            const auto& block = blocks[p].at;
            V* const to = &y[N * order.below[p]];
            for (int i = 0; i < N; ++i) {
                V sum = block[i][0] * z[0];
                for (int j = 1; j < N; ++j) sum += block[i][j] * z[j];
                to[i] -= sum;
            }
        }
        solve_block(diagonal[k].at, z);
        for (int i = 0; i < N; ++i) own[i] = z[i];
    }
    for (size_t k = order.rows; k-- > 0;) {
        V* const own = &y[N * k];
        for (int i = 0; i < N; ++i) z[i] = own[i];
        for (size_t p = order.column[k]; p < order.column[k + 1]; ++p) {
            const auto& block = blocks[p].at;
            const V* const from = &y[N * order.below[p]];
            for (int j = 0; j < N; ++j) {
                V sum = block[0][j] * from[0];
                for (int i = 1; i < N; ++i) sum += block[i][j] * from[i];
                z[j] -= sum;
            }
        }
        for (int i = 0; i < N; ++i) own[i] = z[i];
    }
}

}  // namespace
}  // namespace carom
