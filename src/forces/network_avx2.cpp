#if defined(CAROM_X86_KERNELS)
#include "forces/network_kernel.hpp"

namespace carom {
const NetworkKernel avx2_network_kernel = {forces, energy, stiffness};
}
#endif
