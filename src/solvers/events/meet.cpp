#include "solvers/events/meet.hpp"

#include "simd/isa.hpp"

namespace carom {

const MeetKernel& meet_kernel() {
#if defined(CAROM_X86_KERNELS)
    // Around a disc there are some five others: eight at once take longer than four and four.
    if (isa() != Isa::baseline) return avx2_meet_kernel;
#endif
    return baseline_meet_kernel;
}

}  // namespace carom
