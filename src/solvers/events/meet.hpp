#pragma once
// When discs in flight touch, eight at once: see simd/lanes.hpp.

#include <stddef.h>
#include <stdint.h>

namespace carom {

/// One disc, at its own time, and how others are reached from it.
struct GasView {
    double x, y, vx, vy, clock, radius;
    double gravity_x, gravity_y;
    const double* discs;   ///< the records, eight numbers each: x, y, vx, vy, clock and what is none
    const double* radii;   ///< of the others
    uint32_t radius_mask;  ///< 0 if there is but one
};

constexpr size_t cells_around = 8;

struct MeetKernel {
    /// The times at which the disc touches others whose cells are at these offsets; infinity for never.
    void (*times)(const GasView&, const uint32_t* slots, const double* offset_x, const double* offset_y, double* times);
};
extern const MeetKernel baseline_meet_kernel, avx2_meet_kernel, avx512_meet_kernel;
/// The one for this machine.
const MeetKernel& meet_kernel();

}  // namespace carom
