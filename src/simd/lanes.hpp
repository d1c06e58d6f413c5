#pragma once
// Several doubles at once, as many as the registers of the instruction set hold that the including file is compiled
// for: vector types of GCC and clang, whose +, −, ×, ÷ and comparisons are those of IEEE in every lane. No function
// here fuses, reorders or approximates, so that what a kernel computes a body does not depend on the number of lanes.
//
// Only the kernels, which are compiled once for each instruction set, include this file, and nothing of std beside it:
// the linker may keep any file's copy of an inline function, and so a processor might meet instructions it lacks.
// Hence the unnamed namespace.

#include <stddef.h>
#include <stdint.h>
#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace carom {
namespace {

#if defined(__AVX512F__)
constexpr int lanes = 8;
#elif defined(__AVX2__)
constexpr int lanes = 4;
#else
constexpr int lanes = 2;
#endif

using Lanes = double __attribute__((vector_size(8 * lanes)));
using Mask = int64_t __attribute__((vector_size(8 * lanes)));  ///< −1 or 0 in each lane: what a comparison gives
using Pair = double __attribute__((vector_size(16)));
#if defined(__AVX2__)
using Four = double __attribute__((vector_size(32)));
#else
struct Four {
    Pair low, high;
    double operator[](int i) const { return i < 2 ? low[i] : high[i - 2]; }
};
#endif

/// The x of several vectors and their y.
struct Lanes2 {
    Lanes x, y;
};

/// 0, 1, 2, …
inline Lanes places() {
#if defined(__AVX512F__)
    return Lanes{0, 1, 2, 3, 4, 5, 6, 7};
#elif defined(__AVX2__)
    return Lanes{0, 1, 2, 3};
#else
    return Lanes{0, 1};
#endif
}
inline Lanes all(double value) { return value - Lanes{}; }

template <class V>
inline V load_as(const void* from) {
    V out;
    __builtin_memcpy(&out, from, sizeof out);
    return out;
}
inline Lanes load(const double* from) { return load_as<Lanes>(from); }

inline Lanes select(Mask where, Lanes yes, Lanes no) { return where ? yes : no; }

inline bool any(Mask where) {
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask((__m512i)where, (__m512i)where) != 0;
#elif defined(__AVX2__)
    return _mm256_movemask_pd((__m256d)where) != 0;
#else
    return (where[0] | where[1]) != 0;
#endif
}

inline bool every(Mask where) { return !any(~where); }

/// A bit for each lane, that of the first the lowest.
inline uint64_t bits(Mask where) {
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask((__m512i)where, (__m512i)where);
#elif defined(__AVX2__)
    return static_cast<uint64_t>(_mm256_movemask_pd((__m256d)where));
#else
    return static_cast<uint64_t>(-where[0]) | (static_cast<uint64_t>(-where[1]) << 1);
#endif
}

/// The lowest of them.
inline double lowest(Lanes a) {
#if defined(__AVX512F__)
    const Four low4 = __builtin_shufflevector(a, a, 0, 1, 2, 3), high4 = __builtin_shufflevector(a, a, 4, 5, 6, 7);
    const Four b = low4 < high4 ? low4 : high4;
#elif defined(__AVX2__)
    const Four b = a;
#endif
#if defined(__AVX2__)
    const Pair low = __builtin_shufflevector(b, b, 0, 1), high = __builtin_shufflevector(b, b, 2, 3);
    const Pair c = low < high ? low : high;
#else
    const Pair c = a;
#endif
    return c[0] < c[1] ? c[0] : c[1];
}

inline Lanes square_root(Lanes a) {
#if defined(__AVX512F__)
    return _mm512_maskz_sqrt_pd(0xff, a);  // all lanes; g++ 12 warns falsely of _mm512_sqrt_pd (GCC bug 105593)
#elif defined(__AVX2__)
    return _mm256_sqrt_pd(a);
#elif defined(__SSE2__)
    return _mm_sqrt_pd(a);
#elif defined(__wasm_simd128__)
    return (Lanes)wasm_f64x2_sqrt((v128_t)a);
#else
    return Lanes{__builtin_sqrt(a[0]), __builtin_sqrt(a[1])};
#endif
}

/// From x₀ y₀ x₂ y₂ … and x₁ y₁ x₃ y₃ … to x₀ x₁ x₂ x₃ … and y₀ y₁ y₂ y₃ …
inline Lanes2 unzip(Lanes even, Lanes odd) {
#if defined(__AVX512F__)
    return {__builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14),
            __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15)};
#elif defined(__AVX2__)
    return {__builtin_shufflevector(even, odd, 0, 4, 2, 6), __builtin_shufflevector(even, odd, 1, 5, 3, 7)};
#else
    return {__builtin_shufflevector(even, odd, 0, 2), __builtin_shufflevector(even, odd, 1, 3)};
#endif
}

/// The vectors in these rows of an array of x, y. A load of 16 bytes each: on the processors of today that is faster
/// than their gather instructions.
template <class Row>
inline Lanes2 pairs(const double* xy, Row row) {
    const auto at = [xy, row](int lane) { return load_as<Pair>(xy + 2 * static_cast<size_t>(row(lane))); };
#if defined(__AVX512F__)
    const auto join = [](Pair a, Pair b, Pair c, Pair d) {
        const auto ab = __builtin_shufflevector(a, b, 0, 1, 2, 3), cd = __builtin_shufflevector(c, d, 0, 1, 2, 3);
        return __builtin_shufflevector(ab, cd, 0, 1, 2, 3, 4, 5, 6, 7);
    };
    return unzip(join(at(0), at(2), at(4), at(6)), join(at(1), at(3), at(5), at(7)));
#elif defined(__AVX2__)
    return unzip(__builtin_shufflevector(at(0), at(2), 0, 1, 2, 3), __builtin_shufflevector(at(1), at(3), 0, 1, 2, 3));
#else
    return unzip(at(0), at(1));
#endif
}
/// Those in consecutive rows.
inline Lanes2 pairs_from(const double* xy) {
#if defined(__AVX512F__)
    const Lanes low = load(xy), high = load(xy + lanes);
    return {__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14),
            __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15)};
#else
    return pairs(xy, [](int lane) { return lane; });
#endif
}

/// The first `count` of the vectors into consecutive rows.
inline void store_pairs(double* xy, Lanes2 a, size_t count) {
    if (count >= static_cast<size_t>(lanes)) {
#if defined(__AVX512F__)
        const Lanes low = __builtin_shufflevector(a.x, a.y, 0, 8, 1, 9, 2, 10, 3, 11);
        const Lanes high = __builtin_shufflevector(a.x, a.y, 4, 12, 5, 13, 6, 14, 7, 15);
#elif defined(__AVX2__)
        const Lanes low = __builtin_shufflevector(a.x, a.y, 0, 4, 1, 5);
        const Lanes high = __builtin_shufflevector(a.x, a.y, 2, 6, 3, 7);
#else
        const Lanes low = __builtin_shufflevector(a.x, a.y, 0, 2);
        const Lanes high = __builtin_shufflevector(a.x, a.y, 1, 3);
#endif
        __builtin_memcpy(xy, &low, sizeof low);
        __builtin_memcpy(xy + lanes, &high, sizeof high);
        return;
    }
    for (size_t lane = 0; lane < count; ++lane) xy[2 * lane] = a.x[lane], xy[2 * lane + 1] = a.y[lane];
}

struct Lanes4 {
    Lanes x, y, z, w;
};
#if defined(__AVX2__)
/// From rows of four numbers, as many to each of these vectors as fit, to columns; and back.
inline Lanes4 columns(Lanes a, Lanes b, Lanes c, Lanes d) {
#if defined(__AVX512F__)
    const auto even = [](Lanes x, Lanes y) { return __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14); };
    const auto odd = [](Lanes x, Lanes y) { return __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15); };
    const auto low = [](Lanes x, Lanes y) { return __builtin_shufflevector(x, y, 0, 1, 8, 9, 4, 5, 12, 13); };
    const auto high = [](Lanes x, Lanes y) { return __builtin_shufflevector(x, y, 2, 3, 10, 11, 6, 7, 14, 15); };
#else
    const auto even = [](Lanes x, Lanes y) { return __builtin_shufflevector(x, y, 0, 4, 2, 6); };
    const auto odd = [](Lanes x, Lanes y) { return __builtin_shufflevector(x, y, 1, 5, 3, 7); };
    const auto low = [](Lanes x, Lanes y) { return __builtin_shufflevector(x, y, 0, 1, 4, 5); };
    const auto high = [](Lanes x, Lanes y) { return __builtin_shufflevector(x, y, 2, 3, 6, 7); };
#endif
    const Lanes ab = even(a, b), cd = even(c, d), ab1 = odd(a, b), cd1 = odd(c, d);
    return {low(ab, cd), low(ab1, cd1), high(ab, cd), high(ab1, cd1)};
}
#endif
/// Calls store(lane, four) for the four numbers of every lane, without a way through memory.
template <class Store>
inline void each_four(const Lanes4& a, Store store) {
#if defined(__AVX2__)
    const Lanes4 back = columns(a.x, a.y, a.z, a.w);
#endif
#if defined(__AVX512F__)
    const auto low = [](Lanes v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); };
    const auto high = [](Lanes v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); };
    store(0, low(back.x)), store(1, low(back.y)), store(2, low(back.z)), store(3, low(back.w));
    store(4, high(back.x)), store(5, high(back.y)), store(6, high(back.z)), store(7, high(back.w));
#elif defined(__AVX2__)
    store(0, back.x), store(1, back.y), store(2, back.z), store(3, back.w);
#else
    const auto low = [](Lanes b, Lanes c) { return __builtin_shufflevector(b, c, 0, 2); };
    const auto high = [](Lanes b, Lanes c) { return __builtin_shufflevector(b, c, 1, 3); };
    store(0, Four{low(a.x, a.y), low(a.z, a.w)}), store(1, Four{high(a.x, a.y), high(a.z, a.w)});
#endif
}

/// Four numbers each from where at(lane) is: a load of 32 bytes each where there is one.
template <class At>
inline Lanes4 quads_at(At at) {
#if defined(__AVX2__)
    const auto four = [=](int lane) { return load_as<Four>(at(lane)); };
#if defined(__AVX512F__)
    const auto both = [=](int lane) {
        return __builtin_shufflevector(four(lane), four(lane + 4), 0, 1, 2, 3, 4, 5, 6, 7);
    };
    return columns(both(0), both(1), both(2), both(3));
#else
    return columns(four(0), four(1), four(2), four(3));
#endif
#else
    const auto half = [=](int k) { return unzip(load_as<Pair>(at(0) + k), load_as<Pair>(at(1) + k)); };
    const Lanes2 first = half(0), second = half(2);
    return {first.x, first.y, second.x, second.y};
#endif
}
/// The vectors in these rows of an array of x, y, z, w.
template <class Row>
inline Lanes4 quads_of(const double* xyzw, Row row) {
    return quads_at([=](int lane) { return xyzw + 4 * static_cast<size_t>(row(lane)); });
}
inline Lanes4 quads(const double* xyzw, const uint32_t* rows) {
    return quads_of(xyzw, [rows](int lane) { return rows[lane]; });
}
/// Writes them into their rows, but for those of the lanes whose w is 0.
inline void store_quads(double* xyzw, const uint32_t* rows, const Lanes4& a) {
    const bool all_of_them = !any(a.w == Lanes{});
    each_four(a, [&](int lane, Four four) {
        if (all_of_them || four[3] != 0)
            __builtin_memcpy(xyzw + 4 * static_cast<size_t>(rows[lane]), &four, sizeof four);
    });
}

/// The first `count` of them to where at(lane) is.
template <class At>
inline void store_fours_at(At at, const Lanes4& a, size_t count) {
    each_four(a, [&](int lane, Four four) {
        if (static_cast<size_t>(lane) < count) __builtin_memcpy(at(lane), &four, sizeof four);
    });
}
/// The first `count` of them into consecutive rows.
inline void store_fours(double* xyzw, const Lanes4& a, size_t count) {
    store_fours_at([=](int lane) { return xyzw + 4 * lane; }, a, count);
}
inline void store_numbers(double* to, Lanes a, size_t count) {
    if (count >= static_cast<size_t>(lanes))
        __builtin_memcpy(to, &a, sizeof a);
    else
        __builtin_memcpy(to, &a, count * sizeof(double));
}

/// The numbers in these rows of an array.
inline Lanes numbers(const double* from, const uint32_t* rows) {
    Lanes out{};
    for (size_t lane = 0; lane < static_cast<size_t>(lanes); ++lane) out[lane] = from[rows[lane]];
    return out;
}

/// Whole numbers below 2⁵² as integers of 64 bits are written.
inline Lanes as_integers(Lanes a) {
    constexpr double apart = 0x1p52;  // a number's last bit is worth 1 there
    return (Lanes)((Mask)(a + apart) ^ (Mask)all(apart));
}

/// Whole numbers below 2³¹.
inline Lanes whole_numbers(const uint32_t* from) {
    using Whole = int32_t __attribute__((vector_size(4 * lanes)));
    return __builtin_convertvector(load_as<Whole>(from), Lanes);
}

}  // namespace
}  // namespace carom
