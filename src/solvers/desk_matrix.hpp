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
    /// Who is asked for where there is somebody: one that is alone is, which loops then need not ask.
    static Mask some(Mask) { return true; }
    static double select(bool where, double yes, double no) { return where ? yes : no; }
    static bool any(bool where) { return where; }
    static bool both(bool a, bool b) { return a && b; }
    static bool either(bool a, bool b) { return a || b; }
    static bool no(bool a) { return !a; }
    static double at(double a, int) { return a; }
    static void put(double& a, int, double x) { a = x; }
    static double all(double a) { return a; }
    /// Of two that are not below 0; what is no number is larger than any. By their bits, so that no jump is guessed.
    static double larger(double a, double b) {
        const auto of_a = __builtin_bit_cast(uint64_t, a), of_b = __builtin_bit_cast(uint64_t, b);
        return __builtin_bit_cast(double, of_a > of_b ? of_a : of_b);
    }
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
inline double magnitude(double a) { return __builtin_fabs(a); }

/// What the rows of a joint do to its body a or b.
template <class V, class Source>
struct Pull {
    const Source& from;
    const JointShape& k;
    bool is_b;

    auto kept(uint32_t r) const { return r < k.rigid ? Ops<V>::everywhere() : from.kept(k.line + r); }
    [[gnu::always_inline]] const V* row(uint32_t r) const { return is_b ? from.b(k.line + r) : from.a(k.line + r); }
    /// j_r M⁻¹ l_s of rows on the same part.
    V gain(const V* ease, uint32_t r, const Pull& l, uint32_t s) const {
        const V *const j = row(r), *const other = l.row(s);
        return ease[0] * j[0] * other[0] + ease[1] * j[1] * other[1] + ease[2] * j[2] * other[2];
    }
};
/// The same of a hinge, whose rows are along x, along y and of the angle: two points are one, and these rows are always
/// kept. Others that are not have no lever, so that nobody need ask for them.
template <class V, int N, class Source>
struct HingePull {
    V lever[N], eased[N];  ///< by which rows turn the part, and how fast it turns then
    bool is_b;

    [[gnu::always_inline]] HingePull(const Pull<V, Source>& rows, const V* ease) : is_b(rows.is_b) {
        const V none = Ops<V>::all(0), whole = Ops<V>::all(is_b ? 1 : -1);
        for (uint32_t r = 0; r < N; ++r) {
            if (r < 2)
                lever[r] = rows.row(r)[2];
            else
                lever[r] = r < rows.k.lines ? Ops<V>::select(rows.kept(r), whole, none) : none;
            eased[r] = ease[2] * lever[r];
        }
    }
    [[gnu::always_inline]] V gain(const V* ease, uint32_t r, const HingePull& l, uint32_t s) const {
        const V turning = eased[r] * l.lever[s];
        if (r != s || r >= 2) return turning;
        return is_b == l.is_b ? ease[r] + turning : turning - ease[r];
    }
};

/// A block on the diagonal, of which a factor needs the lower half. Of a hinge `sure` rows are always there and kept.
template <uint32_t sure, class V, int N, class Source, class Gain>
inline void assemble_own(const Source& from, const JointShape& k, double share, Gain gain, V (&block)[N][N]) {
    using O = Ops<V>;
    const V none = O::all(0), one = O::all(1);
    const auto kept = [&](uint32_t r) { return r < sure || r < k.rigid ? O::everywhere() : from.kept(k.line + r); };
    for (uint32_t r = 0; r < N; ++r) {
        const bool is_there = r < sure || r < k.lines;
        for (uint32_t c = 0; c < r; ++c)
            if (sure > 0)
                block[c][r] = gain(r, c);
            else
                block[c][r] = is_there ? O::select(O::both(kept(r), kept(c)), gain(r, c), none) : none;
        block[r][r] = one;
        if (!is_there) continue;
        V own = gain(r, r);
        // A motor may contradict what is rigid: then it is to come to its bounds without pushing very hard.
        constexpr double slack_of_stops = 1e-6;
        const bool yields = r >= sure && share < slack_of_stops && from.is_stop(k.line + r);
        const V more = yields ? slack_of_stops * own : share * from.common(k.line + r, own);
        own += r < sure ? more : more + from.softness(k.line + r);
        own = O::select(own > 0.0, own, O::all(1e300));  // of what nothing moves: no impulse, and not any
        block[r][r] = r < sure ? own : O::select(kept(r), own, one);
    }
}
template <class V, int N, class Source>
inline void assemble_diagonal(const Source& from, double share, BlockOf<V, N>* diagonal) {
    for (size_t i = 0; i < from.shape.joints; ++i) {
        const JointShape& k = from.shape.joint[i];
        const Pull<V, Source> a{from, k, false}, b{from, k, true};
        const V *const ease_a = from.ease(k.a), *const ease_b = from.ease(k.b);
        auto& block = diagonal[k.place].at;
        const auto sum = [&](const auto& of_a, const auto& of_b) {
            return
                [&](uint32_t r, uint32_t c) { return of_a.gain(ease_a, r, of_a, c) + of_b.gain(ease_b, r, of_b, c); };
        };
        if (N > 1 && from.is_hinge(k)) {
            constexpr uint32_t points = N < 2 ? N : 2;
            const HingePull<V, N, Source> turn_a(a, ease_a), turn_b(b, ease_b);
            assemble_own<points>(from, k, share, sum(turn_a, turn_b), block);
        } else {
            assemble_own<0>(from, k, share, sum(a, b), block);
        }
    }
}
/// Adds to a block what two joints do to one another through the part on which both pull; the first of those that do
/// finds nothing there. Inlined, for it is short: what it is told is at hand where it is called.
template <bool is_first, class V, int N, class Source>
[[gnu::always_inline]] inline void couple(const Source& from, const Coupling& c, V (&block)[N][N]) {
    using O = Ops<V>;
    const V none = O::all(0);
    const JointShape &k = from.shape.joint[c.k], &l = from.shape.joint[c.l];
    const Pull<V, Source> left{from, k, c.k_is_b}, right{from, l, c.l_is_b};
    const V* const ease = from.ease(c.part);
    if (N > 1 && from.is_hinge(k) && from.is_hinge(l)) {
        const HingePull<V, N, Source> turn_left(left, ease), turn_right(right, ease);
        for (uint32_t s = 0; s < N; ++s)
            for (uint32_t r = 0; r < N; ++r)
                block[s][r] = (is_first ? none : block[s][r]) + turn_left.gain(ease, r, turn_right, s);
        return;
    }
    for (uint32_t s = 0; s < N; ++s)
        for (uint32_t r = 0; r < N; ++r) {
            if (is_first) block[s][r] = none;
            if (r >= k.lines || s >= l.lines) continue;
            block[s][r] += O::select(O::both(left.kept(r), right.kept(s)), left.gain(ease, r, right, s), none);
        }
}
/// Fills the blocks of S for rows that are kept, with their softnesses and a share of the diagonal more on it. The
/// others are rows of 1.
template <class V, int N, class Source>
inline void assemble(const Source& from, double share, BlockOf<V, N>* diagonal, BlockOf<V, N>* blocks) {
    assemble_diagonal<V, N>(from, share, diagonal);
    const Coupling *c = from.shape.coupling, *const end = c + from.shape.couplings;
    for (size_t i = 0; i < from.shape.blocks; ++i) {
        auto& block = blocks[i].at;
        if (c != end && c->index == i)
            couple<true>(from, *c++, block);
        else
            for (auto& row : block)
                for (V& x : row) x = Ops<V>::all(0);
        for (; c != end && c->index == i; ++c) couple<false>(from, *c, block);
    }
}

}  // namespace
}  // namespace carom
