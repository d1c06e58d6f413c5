#include "forces/network_kernel.hpp"

namespace carom {
const NetworkKernel baseline_network_kernel = {forces, energy, stiffness};
}
