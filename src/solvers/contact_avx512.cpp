#if defined(CAROM_X86_KERNELS)
#include "solvers/contact_kernel.hpp"

namespace carom {
const ContactKernel avx512_contact_kernel = {write_block,  warm_start, foresee_bounces, sweep<true>,
                                             sweep<false>, part,       settle,          sum_held};
}
#endif
