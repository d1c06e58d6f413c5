#include "solvers/events/meet.hpp"

#include "simd/isa.hpp"

namespace carom {

const MeetKernel& meet_kernel() {
#if defined(CAROM_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512_meet_kernel;
    if (isa() == Isa::avx2) return avx2_meet_kernel;
#endif
    return baseline_meet_kernel;
}

}  // namespace carom
