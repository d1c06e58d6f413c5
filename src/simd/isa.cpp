#include "simd/isa.hpp"

namespace carom {

std::vector<Isa> available_isas() {
    std::vector<Isa> all{Isa::baseline};
#if defined(CAROM_X86_KERNELS)
    if (__builtin_cpu_supports("avx2")) all.push_back(Isa::avx2);
    if (__builtin_cpu_supports("avx512f")) all.push_back(Isa::avx512);
#endif
    return all;
}

namespace {

Isa widest() {
    static const Isa found = available_isas().back();
    return found;
}

std::optional<Isa> forced;

}  // namespace

Isa isa() { return forced ? *forced : widest(); }
void use_isa(std::optional<Isa> which) { forced = which; }

}  // namespace carom
