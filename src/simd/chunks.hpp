#pragma once
#include <stddef.h>

namespace carom {

/// Kernels go through rows in chunks of this many, whatever the number of lanes of the machine: a layout by chunks, and
/// with it the order of every sum, is the same on all of them.
constexpr size_t chunk_rows = 8;

}  // namespace carom
