#include "solvers/events/meet.hpp"

#include "simd/isa.hpp"

namespace carom {

const MeetKernel& meet_kernel() {
    // Around a disc there are some five others: eight at once take longer than four and four.
    return kernel_in_use<baseline_meet_kernel, avx2_meet_kernel, avx2_meet_kernel>();
}

}  // namespace carom
