#if defined(CAROM_X86_KERNELS)
#include "solvers/contact_kernel.hpp"

namespace carom {
const ContactKernel avx2_contact_kernel = {warm_start, foresee_bounces, sweep<true>, sweep<false>,
                                           part,       settle,          sum_held};
}
#endif
