#include "state/rows_kernel.hpp"

namespace carom {
const RowsKernel baseline_rows_kernel = {accelerate, kick, drift, combine, finite, zero};
}
