#include "math/supernode_kernel.hpp"

namespace carom {
const SupernodeKernel baseline_supernode_kernel = kernel;
}
