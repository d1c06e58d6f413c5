#pragma once
// Columns of a factor that have the same rows below them, side by side as dense columns of numbers: what fill makes of
// a large matrix is mostly such. Without std, for wide kernels include it.

#include <stddef.h>

namespace carom {

/// Columns are as long as a multiple of so many rows: whole lanes of any width.
constexpr size_t supernode_rows = 8;

/// As many columns as N for each block column, `stride` numbers apart.
struct Supernode {
    double* given;   ///< L D, as it is
    double* scaled;  ///< L
    size_t stride;
};

struct SupernodeKernel {
    /// Takes from N columns of the matrix what the first `count` block columns have for them, one after the other:
    /// to[r + j stride] −= Σ scaled[r] given[at + j] over the numbers of a block's row. For rows from `first`, a
    /// multiple of supernode_rows, on, and blocks of N = 1 to 4.
    void (*subtract[4])(const Supernode&, size_t count, size_t at, size_t first, double* to);
    /// Divides block column `k` by the factor of its block on the diagonal.
    void (*scale[4])(const Supernode&, const double* diagonal, size_t k, size_t first);
};
extern const SupernodeKernel baseline_supernode_kernel, avx2_supernode_kernel, avx512_supernode_kernel;

}  // namespace carom
