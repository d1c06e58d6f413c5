#pragma once
// What simd/groups.hpp is for lanes, for the bodies of a small world one after the other: kernels that say auto do
// both. In one chunk places are added up in the order of the rows. Nothing here depends on the instruction set, so that
// such a text may also be compiled where it is wanted, without a call through a table.

#include <stddef.h>

namespace carom {
namespace {

struct Single2 {
    double x, y;
};
using Two = double __attribute__((vector_size(16)));  ///< a vector's x and y at once: every machine has that
struct Single {
    size_t row, part, count = 1;

    Single in_block(size_t first) const { return {row - first, part}; }
    Single2 of(const double* xy) const { return {xy[2 * row], xy[2 * row + 1]}; }
    double of_numbers(const double* numbers) const { return numbers[row]; }
};
inline double select(bool where, double yes, double no) { return where ? yes : no; }
inline bool any(bool where) { return where; }
inline double square_root(double a) { return __builtin_sqrt(a); }
inline void store_pairs(double* xy, Single2 a, size_t) { xy[0] = a.x, xy[1] = a.y; }

struct SingleSum {
    double sum = 0;

    void add(const Single&, double a) { sum += a; }
    double total() const { return sum; }
};

inline bool are_few(size_t rows) { return rows <= 4; }
template <class Work>
inline void for_each_single(size_t first, size_t last, Work work) {
    for (size_t row = first; row < last; ++row) work(Single{row, row});
}

}  // namespace
}  // namespace carom
