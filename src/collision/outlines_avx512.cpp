#if defined(CAROM_X86_KERNELS)
#include "collision/outlines_kernel.hpp"

namespace carom {
const OutlinesKernel avx512_outlines_kernel = {cut};
}
#endif
