#if defined(CAROM_X86_KERNELS)
#include "math/supernode_kernel.hpp"

namespace carom {
const SupernodeKernel avx512_supernode_kernel = kernel;
}
#endif
