#include "solvers/desk_kernel.hpp"

namespace carom {
const DeskKernel baseline_desk_kernel = {lanes, lay,       lay_drifted, {iterate<2>, iterate<3>, iterate<4>},
                                         calm,  look_ahead};
}
