#pragma once
// Without std and in an unnamed namespace, for wide kernels include it (src/simd/lanes.hpp).

namespace carom {
namespace {

template <class V>
struct SmallTurn {
    V sine, versine;  ///< 1 − cos
};
inline constexpr double small_turn_most = 0.25;  ///< [rad]
/// The sine and versine of an angle of no more than `small_turn_most`, of a number or of lanes, by their series to
/// rounding: without the branches of portable::sincos.
template <class V>
[[gnu::always_inline]] inline SmallTurn<V> small_turn(V angle) {
    constexpr double sines[] = {-1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800};
    constexpr double versines[] = {1.0 / 2, -1.0 / 24, 1.0 / 720, -1.0 / 40320, 1.0 / 3628800, -1.0 / 479001600};
    const V q = angle * angle;
    V s = sines[3] + q * sines[4], v = versines[4] + q * versines[5];
    for (int i = 3; i-- > 0;) s = sines[i] + q * s;
    for (int i = 4; i-- > 0;) v = versines[i] + q * v;
    return {angle + angle * (q * s), v * q};
}

}  // namespace
}  // namespace carom
