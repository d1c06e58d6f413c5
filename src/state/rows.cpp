#include "state/rows.hpp"

#include "simd/isa.hpp"

namespace carom {

const RowsKernel& rows_kernel([[maybe_unused]] size_t rows) {
#if defined(CAROM_X86_KERNELS)
    const Isa most = isa_for(rows);
    if (most == Isa::avx512) return avx512_rows_kernel;
    if (most == Isa::avx2) return avx2_rows_kernel;
#endif
    return baseline_rows_kernel;
}

}  // namespace carom
