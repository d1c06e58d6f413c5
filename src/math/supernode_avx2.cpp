#if defined(CAROM_X86_KERNELS)
#include "math/supernode_kernel.hpp"

namespace carom {
const SupernodeKernel avx2_supernode_kernel = kernel;
}
#endif
