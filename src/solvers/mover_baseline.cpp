#include "solvers/mover_kernel.hpp"

namespace carom {
const MoverKernel baseline_mover_kernel = {place, take_drift, drift, kick, take_velocities, sum};
}
