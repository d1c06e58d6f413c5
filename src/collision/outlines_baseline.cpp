#include "collision/outlines_kernel.hpp"

namespace carom {
const OutlinesKernel baseline_outlines_kernel = {cut};
}
