#include "collision/outlines.hpp"

#include "simd/isa.hpp"

namespace carom {

const OutlinesKernel baseline_outlines_kernel = {nullptr};

const OutlinesKernel& outlines_kernel() {
    return kernel_in_use<baseline_outlines_kernel, avx2_outlines_kernel, avx512_outlines_kernel>();
}

}  // namespace carom
