#pragma once
// The text of the kernels in math/supernode_rows.hpp, compiled once for each instruction set.

#include "math/block_factor.hpp"
#include "math/supernode_rows.hpp"
#include "simd/lanes.hpp"

namespace carom {
namespace {

constexpr size_t width = static_cast<size_t>(lanes);

/// As many rows as K registers hold.
template <int N, size_t K>
inline void subtract_rows(const Supernode& s, size_t count, size_t at, size_t row, double* to) {
    Lanes left[N][K];
    const auto columns = [&](int j) { return to + row + static_cast<size_t>(j) * s.stride; };
    for (int j = 0; j < N; ++j) __builtin_memcpy(left[j], columns(j), sizeof left[j]);
    const double *scaled = s.scaled + row, *given = s.given + at;
    for (size_t c = 0; c < count; ++c) {
        Lanes sum[N][K];
        for (int i = 0; i < N; ++i, scaled += s.stride, given += s.stride)
            for (int j = 0; j < N; ++j)
                for (size_t k = 0; k < K; ++k) {
                    const Lanes product = load(scaled + k * width) * all(given[j]);
                    sum[j][k] = i == 0 ? product : sum[j][k] + product;
                }
        for (int j = 0; j < N; ++j)
            for (size_t k = 0; k < K; ++k) left[j][k] -= sum[j][k];
    }
    for (int j = 0; j < N; ++j) __builtin_memcpy(columns(j), left[j], sizeof left[j]);
}

template <int N>
void subtract_columns(const Supernode& s, size_t count, size_t at, size_t first, double* to) {
    constexpr size_t many = N < 3 ? 4 : 2;
    size_t row = first;
    for (; row + many * width <= s.stride; row += many * width) subtract_rows<N, many>(s, count, at, row, to);
    for (; row < s.stride; row += width) subtract_rows<N, 1>(s, count, at, row, to);
}

template <int N>
void scale(const Supernode& s, const double* diagonal, size_t k, size_t first) {
    BlockOf<Lanes, N> own;
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) own.at[i][j] = all(diagonal[i * N + j]);
    for (size_t row = first; row < s.stride; row += width) {
        Lanes x[N];
        for (size_t i = 0; i < N; ++i) x[i] = load(s.given + (N * k + i) * s.stride + row);
        solve_block(own.at, x);
        for (size_t i = 0; i < N; ++i) __builtin_memcpy(s.scaled + (N * k + i) * s.stride + row, &x[i], sizeof x[i]);
    }
}

constexpr SupernodeKernel kernel{{subtract_columns<1>, subtract_columns<2>, subtract_columns<3>, subtract_columns<4>},
                                 {scale<1>, scale<2>, scale<3>, scale<4>}};

}  // namespace
}  // namespace carom
