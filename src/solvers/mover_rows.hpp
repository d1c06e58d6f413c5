#pragma once
// What all bodies do in a substep, row by row, for the machine: see simd/lanes.hpp.

#include <stddef.h>

namespace carom {

/// Arrays of a number, of x, y, or of four numbers a row: of movers their velocities and inverse mass, of frames x, y,
/// cosine, sine.
struct MoverRows {
    double *movers, *before, *means, *given, *frames;
    double *x, *angle, *v, *turning;  ///< of the state
    struct Then {
        const double *x, *angle, *v, *turning;
    } start, proposed;
    double* leads;  ///< null if nobody has any
    const unsigned char* asleep;
    const unsigned char* carried;  ///< drift and kick leave them alone; null if there are none
    bool gives_again;              ///< what was given in the substep before is given again
    size_t rows;
};

/// What changed from `proposed` to the state: ½ m dv·(v − v at the start) and alike for turning, and Σ m dv and its
/// moment about the origin.
struct MoverSums {
    double work, momentum_x, momentum_y, angular;
};

/// For the rows from first to last − 1; of sums the first is a multiple of chunk_rows.
struct MoverKernel {
    /// Movers without velocities, in their frames.
    void (*place)(const MoverRows&, const double* inverse_mass, size_t first, size_t last);
    /// Puts sleepers back where they were, and gives all the velocities that carry them from `start` to the state in
    /// h [s], with a share of what they were given.
    void (*take_drift)(const MoverRows&, double h, double share, size_t first, size_t last);
    /// Moves them on by what the solver changed their velocity, for h [s]: as they are, they are where the integrator
    /// put them.
    void (*drift)(const MoverRows&, double h, size_t first, size_t last);
    /// The rest of the kick: the velocity at the end, with what the solver changed, and with a share of what they were
    /// given. That of a free body stays as it is.
    void (*kick)(const MoverRows&, double share, size_t first, size_t last);
    /// Takes the velocities of those that can be moved, and notes what they were given, and the means.
    void (*take_velocities)(const MoverRows&, size_t first, size_t last);
    MoverSums (*sum)(const MoverRows&, const double* mass, const double* inertia, size_t first, size_t last);
};
extern const MoverKernel baseline_mover_kernel, avx2_mover_kernel, avx512_mover_kernel;
/// The one for this machine.
const MoverKernel& mover_kernel();

}  // namespace carom
