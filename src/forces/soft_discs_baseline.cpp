#include "forces/soft_discs_kernel.hpp"

namespace carom {
const SoftKernel baseline_soft_kernel = {forces, energy, farthest};
}
