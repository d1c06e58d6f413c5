#pragma once
// When discs in flight touch, several at once: see simd/lanes.hpp.

#include <stddef.h>
#include <stdint.h>

namespace carom {

/// All discs, as others see them.
struct GasView {
    const double* discs;  ///< the records, eight numbers each: x, y, vx, vy, clock and what is none
    const double* radii;
    uint32_t radius_mask;  ///< 0 if there is but one
    double gravity_x, gravity_y;
};

/// Whom it may touch. The arrays go on to a multiple of eight, with discs that nobody meets.
struct GasOthers {
    static constexpr size_t most = 64;

    uint32_t slot[most + 8];
    uint8_t cell[most + 8];  ///< which of the cells around
    double time[most + 8];   ///< when it touches them, infinity for never: what the kernel finds
    size_t count;
};

/// When the first of them is touched, and which they are at that time: a bit for each.
struct GasSoonest {
    double time;
    uint64_t which;
};

struct MeetKernel {
    /// The cells of the others are at these offsets, pairs of x and y.
    GasSoonest (*soonest)(const GasView&, uint32_t disc, GasOthers&, const double* offsets);
};
extern const MeetKernel baseline_meet_kernel, avx2_meet_kernel;
/// The one for this machine.
const MeetKernel& meet_kernel();

}  // namespace carom
