#pragma once
// Two doubles at once, which every processor has: for code that is compiled once. What wider registers are worth the
// kernels know (simd/lanes.hpp).

namespace carom {

using Duo = double __attribute__((vector_size(16)));

namespace {

inline Duo load_duo(const double* from) {
    Duo out;
    __builtin_memcpy(&out, from, sizeof out);
    return out;
}
inline void store(Duo in, double* to) { __builtin_memcpy(to, &in, sizeof in); }

/// Where those of simd/single.hpp are, which would hide it elsewhere.
template <class Mask>
inline Duo select(Mask where, Duo yes, Duo no) {
    return where ? yes : no;
}

}  // namespace

}  // namespace carom
