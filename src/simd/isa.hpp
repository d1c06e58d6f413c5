#pragma once
// Which instruction set the kernels use: the widest that the processor has. The bits do not depend on it.

#include <optional>
#include <vector>

namespace carom {

enum class Isa { baseline, avx2, avx512 };

/// Those this build has kernels for and this processor can run, the widest last.
std::vector<Isa> available_isas();
/// The one in use.
Isa isa();
/// For tests: this one from now on, which must be available; without an argument the widest again.
void use_isa(std::optional<Isa> which);

/// Of the kernels for each set the one for that in use. A build without kernels for x86 has the first one alone.
template <const auto& baseline, const auto& avx2, const auto& avx512>
const auto& kernel_in_use() {
#if defined(CAROM_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512;
    if (isa() == Isa::avx2) return avx2;
#endif
    return baseline;
}

}  // namespace carom
