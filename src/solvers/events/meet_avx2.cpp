#if defined(CAROM_X86_KERNELS)
#include "solvers/events/meet_kernel.hpp"

namespace carom {
const MeetKernel avx2_meet_kernel = {soonest};
}
#endif
