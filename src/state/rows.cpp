#include "state/rows.hpp"

#include "simd/isa.hpp"

namespace carom {

const RowsKernel& rows_kernel() {
#if defined(CAROM_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512_rows_kernel;
    if (isa() == Isa::avx2) return avx2_rows_kernel;
#endif
    return baseline_rows_kernel;
}

}  // namespace carom
