#if defined(CAROM_X86_KERNELS)
#include "state/rows_kernel.hpp"

namespace carom {
const RowsKernel avx512_rows_kernel = {accelerate<Sums>, accelerate<NoSum>, kick,   drift,
                                       combine,          largest,           finite, zero};
}
#endif
