#include "state/rows.hpp"

#include "simd/isa.hpp"

namespace carom {

const RowsKernel& rows_kernel() { return kernel_in_use<baseline_rows_kernel, avx2_rows_kernel, avx512_rows_kernel>(); }

}  // namespace carom
