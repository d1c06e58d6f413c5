#if defined(CAROM_X86_KERNELS)
#include "solvers/mover_kernel.hpp"

namespace carom {
const MoverKernel avx2_mover_kernel = {place, take_drift, drift, kick, take_velocities, sum};
}
#endif
