#pragma once
// The factor L D Lᵀ of a symmetric matrix of N × N blocks, and solves with it, for numbers or for lanes of them.
// Without std and with its functions in an unnamed namespace, for wide kernels include it (src/simd/lanes.hpp).

#include <stddef.h>
#include <stdint.h>

#include "simd/duo.hpp"

namespace carom {

template <class V, int N>
struct BlockOf {
    V at[N][N];  ///< by columns: at[1][0] is the first number of the second one
};

/// Which blocks there are: in each column, in the order of elimination, those below the diagonal.
struct BlockOrder {
    size_t rows;
    const size_t* column;   ///< where its blocks begin
    const uint32_t* below;  ///< the rows of these, ascending in each column
};

namespace {

template <class Group, class V>
[[gnu::always_inline]] inline Group group_at(const V* from) {
    Group out;
    __builtin_memcpy(&out, from, sizeof out);
    return out;
}
template <class Group, class V>
[[gnu::always_inline]] inline void put(Group in, V* to) {
    __builtin_memcpy(to, &in, sizeof in);
}
/// Calls act(row, group) for N rows from the first on that are computed alike: two numbers at a time, which every
/// processor has a register for, or one by one.
template <int N, class V, class Act>
[[gnu::always_inline]] inline void each_group(size_t first, Act act) {
    if constexpr (sizeof(V) == sizeof(double) && N > 1)
        for (; first + 2 <= N; first += 2) act(first, Duo{});
    for (; first < N; ++first) act(first, V{});
}

/// In place: L below the diagonal and 1 / D on it, of L D Lᵀ.
template <class V, int N>
inline void factor_block(V (&a)[N][N]) {
    V c[N][N];  // L D
    for (int j = 0; j < N; ++j) {
        for (int k = 0; k < j; ++k) {
            c[k][j] = a[k][j];
            for (int l = 0; l < k; ++l) c[k][j] -= a[l][j] * c[l][k];
            a[k][j] = c[k][j] * a[k][k];
        }
        V d = a[j][j];
        for (int k = 0; k < j; ++k) d -= a[k][j] * c[k][j];
        a[j][j] = 1.0 / d;
    }
}
/// x = (L D Lᵀ)⁻¹ x, for one or for several side by side.
template <class V, int N, class Group>
inline void solve_block(const V (&a)[N][N], Group* x) {
    for (int i = 1; i < N; ++i) {
        Group sum = x[0] * a[0][i];
        for (int k = 1; k < i; ++k) sum += x[k] * a[k][i];
        x[i] -= sum;
    }
    for (int i = 0; i < N; ++i) x[i] *= a[i][i];
    for (int i = N - 2; i >= 0; --i) {
        Group sum = x[i + 1] * a[i][i + 1];
        for (int k = i + 2; k < N; ++k) sum += x[k] * a[i][k];
        x[i] -= sum;
    }
}
/// All rows of a block by that.
template <class V, int N>
inline void scale(const V (&a)[N][N], V (&rows)[N][N]) {
    each_group<N, V>(0, [&]<class Group>(size_t i, Group) {
        Group x[N];
        for (int k = 0; k < N; ++k) x[k] = group_at<Group>(&rows[k][i]);
        solve_block(a, x);
        for (int k = 0; k < N; ++k) put(x[k], &rows[k][i]);
    });
}
/// c −= a bᵀ, or the lower half of it.
template <bool all, class V, int N>
inline void subtract(V (&c)[N][N], const V (&a)[N][N], const V (&b)[N][N]) {
    for (size_t j = 0; j < N; ++j)
        each_group<N, V>(all ? 0 : j, [&]<class Group>(size_t i, Group) {
            Group sum = group_at<Group>(&a[0][i]) * b[0][j];
            for (int k = 1; k < N; ++k) sum += group_at<Group>(&a[k][i]) * b[k][j];
            put(group_at<Group>(&c[j][i]) - sum, &c[j][i]);
        });
}

/// Eliminates row k of a matrix, of which blocks on the diagonal need their lower half alone: its column becomes that
/// of the factor. There is room for a column of blocks in `given`.
template <class V, int N>
inline void factor_column(const BlockOrder& order, size_t k, BlockOf<V, N>* diagonal, BlockOf<V, N>* blocks,
                          BlockOf<V, N>* given) {
    factor_block(diagonal[k].at);
    const size_t first = order.column[k], last = order.column[k + 1];
    for (size_t q = first; q < last; ++q) given[q - first] = blocks[q], scale(diagonal[k].at, blocks[q].at);
    for (size_t q = first; q < last; ++q) {
        const uint32_t j = order.below[q];
        subtract<false>(diagonal[j].at, blocks[q].at, given[q - first].at);
        size_t at = order.column[j];
        for (size_t p = q + 1; p < last; ++p) {
            while (order.below[at] != order.below[p]) ++at;
            subtract<true>(blocks[at].at, blocks[p].at, given[q - first].at);
        }
    }
}
/// Replaces a matrix by its factor.
template <class V, int N>
inline void factor_blocks(const BlockOrder& order, BlockOf<V, N>* diagonal, BlockOf<V, N>* blocks,
                          BlockOf<V, N>* given) {
    for (size_t k = 0; k < order.rows; ++k) factor_column(order, k, diagonal, blocks, given);
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
            each_group<N, V>(0, [&]<class Group>(size_t i, Group) {
                Group sum = group_at<Group>(&block[0][i]) * z[0];
                for (int j = 1; j < N; ++j) sum += group_at<Group>(&block[j][i]) * z[j];
                put(group_at<Group>(&to[i]) - sum, &to[i]);
            });
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
                V sum = block[j][0] * from[0];
                for (int i = 1; i < N; ++i) sum += block[j][i] * from[i];
                z[j] -= sum;
            }
        }
        for (int i = 0; i < N; ++i) own[i] = z[i];
    }
}

}  // namespace
}  // namespace carom
