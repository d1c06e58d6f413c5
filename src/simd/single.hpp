#pragma once
// What simd/groups.hpp is for lanes, for the bodies of a small world one after the other: kernels that say auto do
// both. In one chunk places are added up in the order of the rows. Nothing here depends on the instruction set, so that
// such a text may also be compiled where it is wanted, without a call through a table.

#include <stddef.h>
#include <stdint.h>

namespace carom {
namespace {

struct Single2 {
    double x, y;
};
using Two = double __attribute__((vector_size(16)));  ///< a vector's x and y at once: every machine has that
using Two_anywhere = double __attribute__((vector_size(16), aligned(8)));  ///< the same where no address is even
/// The size of each.
inline Two size_of(Two a) {
    using Bits = int64_t __attribute__((vector_size(16)));
    return reinterpret_cast<Two>(reinterpret_cast<Bits>(a) & INT64_MAX);
}
struct Single4 {
    double x, y, z, w;
};
struct Single {
    size_t row, part, count = 1;

    Single in_block(size_t first) const { return {row - first, part}; }
    Single2 of(const double* xy) const { return {xy[2 * row], xy[2 * row + 1]}; }
    double of_numbers(const double* numbers) const { return numbers[row]; }
    Single4 of_fours(const double* xyzw) const {
        const double* const four = xyzw + 4 * row;
        return {four[0], four[1], four[2], four[3]};
    }
    bool flagged(const unsigned char* flags) const { return flags && flags[row] != 0; }
};
inline double select(bool where, double yes, double no) { return where ? yes : no; }
inline bool any(bool where) { return where; }
inline bool every(bool where) { return where; }
inline double square_root(double a) { return __builtin_sqrt(a); }
/// In one piece: who loads both at once would wait for two halves until they are in the cache.
inline void store_pairs(double* xy, Single2 a, size_t) {
    const Two both{a.x, a.y};
    __builtin_memcpy(xy, &both, sizeof both);
}

inline void store_fours(double* xyzw, const Single4& a, size_t) {
    xyzw[0] = a.x, xyzw[1] = a.y, xyzw[2] = a.z, xyzw[3] = a.w;
}
inline void store_numbers(double* to, double a, size_t) { *to = a; }

struct SingleSum {
    double sum = 0;

    void add(const Single&, double a) { sum += a; }
    double total() const { return sum; }
};

constexpr size_t most_few = 4;
inline bool are_few(size_t rows) { return rows <= most_few; }
template <class Work>
inline void for_each_single(size_t first, size_t last, Work work) {
    for (size_t row = first; row < last; ++row) work(Single{row, row});
}

}  // namespace
}  // namespace carom
