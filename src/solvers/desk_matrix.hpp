#pragma once
// The matrix of a mechanism's solve, S = J M⁻¹ Jᵀ, for numbers or for lanes of them.
//
// Without std and in an unnamed namespace, for wide kernels include it (src/simd/lanes.hpp).

#include "solvers/desk_rows.hpp"

namespace carom {
namespace {

/// What numbers and lanes do by other names.
template <class V>
struct Ops;
template <>
struct Ops<double> {
    using Mask = bool;
    static constexpr int lanes = 1;
    static Mask everywhere() { return true; }
    static Mask nowhere() { return false; }
    static double select(bool where, double yes, double no) { return where ? yes : no; }
    static bool any(bool where) { return where; }
    static bool both(bool a, bool b) { return a && b; }
    static bool either(bool a, bool b) { return a || b; }
    static bool no(bool a) { return !a; }
    static double at(double a, int) { return a; }
    static void put(double& a, int, double x) { a = x; }
    static double all(double a) { return a; }
};

constexpr double number_of(Step step) { return static_cast<double>(static_cast<uint8_t>(step)); }
template <class V>
inline auto is_in(V step) {
    static_assert(static_cast<int>(Step::upper) == 2 && static_cast<int>(Step::pushing) == 3);
    return step <= number_of(Step::upper);
}
template <class V>
inline V magnitude(V a) {
    return Ops<V>::select(a < 0.0, -a, a);
}

/// What the rows of a joint do to its body a or b.
template <class V, class Source>
struct Pull {
    const Source& from;
    const JointShape& k;
    bool is_b, is_hinge;

    auto kept(uint32_t r) const { return r < k.rigid ? Ops<V>::everywhere() : from.kept(k.line + r); }
    const V* row(uint32_t r) const { return is_b ? from.b(k.line + r) : from.a(k.line + r); }
    /// j_r M⁻¹ l_s of rows on the same part. Those of a hinge are along x, along y and of the angle.
    V gain(const V* ease, uint32_t r, const Pull& l, uint32_t s) const {
        const V *const j = row(r), *const other = l.row(s);
        const V turning = ease[2] * j[2] * other[2];
        if (!(is_hinge && l.is_hinge)) return ease[0] * j[0] * other[0] + ease[1] * j[1] * other[1] + turning;
        if (r != s || r >= 2) return turning;
        return is_b == l.is_b ? ease[r] + turning : turning - ease[r];
    }
};

/// Fills the blocks of S on the diagonal, of which a factor needs the lower half.
template <class V, int N, class Source>
inline void assemble_diagonal(const Source& from, double share, BlockOf<V, N>* diagonal) {
    using O = Ops<V>;
    const V none = O::all(0), one = O::all(1);
    for (size_t i = 0; i < from.shape.joints; ++i) {
        const JointShape& k = from.shape.joint[i];
        const bool is_hinge = from.is_hinge(k);
        const Pull<V, Source> a{from, k, false, is_hinge}, b{from, k, true, is_hinge};
        auto& block = diagonal[k.place].at;
        for (uint32_t r = 0; r < N; ++r) {
            for (uint32_t c = 0; c < r; ++c) {
                block[r][c] = none;
                if (r >= k.lines) continue;
                const V all = a.gain(from.ease(k.a), r, a, c) + b.gain(from.ease(k.b), r, b, c);
                block[r][c] = O::select(O::both(a.kept(r), a.kept(c)), all, none);
            }
            block[r][r] = one;
            if (r >= k.lines) continue;
            V own = a.gain(from.ease(k.a), r, a, r) + b.gain(from.ease(k.b), r, b, r);
            // A motor may contradict what is rigid: then it is to come to its bounds without pushing very hard.
            constexpr double slack_of_stops = 1e-6;
            const double part = from.is_stop(k.line + r) && share < slack_of_stops ? slack_of_stops : share;
            own += part * own + from.softness(k.line + r);
            own = O::select(own > 0.0, own, O::all(1e300));  // of what nothing moves: no impulse, and not any
            block[r][r] = O::select(a.kept(r), own, one);
        }
    }
}
/// Fills the blocks of S for rows that are kept, with their softnesses and a share of the diagonal more on it. The
/// others are rows of 1.
template <class V, int N, class Source>
inline void assemble(const Source& from, double share, BlockOf<V, N>* diagonal, BlockOf<V, N>* blocks) {
    using O = Ops<V>;
    const V none = O::all(0);
    assemble_diagonal<V, N>(from, share, diagonal);
    for (size_t i = 0; i < from.shape.blocks; ++i)
        for (auto& row : blocks[i].at)
            for (V& x : row) x = none;
    for (size_t i = 0; i < from.shape.couplings; ++i) {
        const Coupling& c = from.shape.coupling[i];
        const JointShape &k = from.shape.joint[c.k], &l = from.shape.joint[c.l];
        const Pull<V, Source> left{from, k, c.k_is_b, from.is_hinge(k)}, right{from, l, c.l_is_b, from.is_hinge(l)};
        auto& block = blocks[c.index].at;
        typename O::Mask kept[2][N];
        for (uint32_t r = 0; r < N; ++r) {
            kept[0][r] = r < k.lines ? left.kept(r) : O::nowhere();
            kept[1][r] = r < l.lines ? right.kept(r) : O::nowhere();
        }
        for (uint32_t r = 0; r < N; ++r)
            for (uint32_t s = 0; s < N; ++s) {
                if (r >= k.lines || s >= l.lines) continue;
                const V all = left.gain(from.ease(c.part), r, right, s);
                block[r][s] += O::select(O::both(kept[0][r], kept[1][s]), all, none);
            }
    }
}

}  // namespace
}  // namespace carom
