#include "solvers/events/meet_kernel.hpp"

namespace carom {
const MeetKernel baseline_meet_kernel = {soonest};
}
