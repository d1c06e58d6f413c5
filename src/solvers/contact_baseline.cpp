#include "solvers/contact_kernel.hpp"

namespace carom {
const ContactKernel baseline_contact_kernel = {write_block,  warm_start, foresee_bounces, sweep<true>,
                                               sweep<false>, part,       settle,          sum_held};
}
