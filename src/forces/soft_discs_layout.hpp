#pragma once
// What the kernels of soft discs see: plain data (simd/lanes.hpp).

#include <stddef.h>
#include <stdint.h>

#include "simd/chunks.hpp"

namespace carom {

/// Who may touch whom, chunk by chunk as in a SpringNetwork: a column names one neighbour of each body of a chunk, in
/// the order of their rows, and a body with fewer than its fellows names itself.
struct SoftLayout {
    size_t rows;
    const uint32_t* first_column;  ///< of each chunk, and the end
    const uint32_t* neighbours;    ///< chunk_rows a column
    const double *radius, *inverse_mass;
    double stiffness, damping;
    double width, height, inverse_width, inverse_height;  ///< of the periodic box; all 0 without one
};

struct SoftPowers {
    double elastic = 0;  ///< Σ F·v of the elastic forces [W]
    double damping = 0;  ///< heat that flows [W]
};

/// For the rows from first, a multiple of chunk_rows, to last − 1. x and v are arrays of x, y, of all rows.
struct SoftKernel {
    /// Adds the forces on these bodies to force[0], force[1] …
    SoftPowers (*forces)(const SoftLayout&, const double* x, const double* v, double* force, size_t first, size_t last);
    /// Half of each pair's potential energy at either disc.
    double (*energy)(const SoftLayout&, const double* x, size_t first, size_t last);
    /// The largest squared distance of a body from where it was.
    double (*farthest)(const double* x, const double* was, size_t rows);
};
extern const SoftKernel baseline_soft_kernel, avx2_soft_kernel, avx512_soft_kernel;

}  // namespace carom
