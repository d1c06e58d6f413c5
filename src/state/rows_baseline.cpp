#include "state/rows_kernel.hpp"

namespace carom {
const RowsKernel baseline_rows_kernel = {accelerate<Sums>, accelerate<NoSum>, kick,   drift,
                                         combine,          largest,           finite, zero};
}
