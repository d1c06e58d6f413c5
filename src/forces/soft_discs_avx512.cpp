#if defined(CAROM_X86_KERNELS)
#include "forces/soft_discs_kernel.hpp"

namespace carom {
const SoftKernel avx512_soft_kernel = {forces, energy, farthest};
}
#endif
