#pragma once
// How kernels go through rows, and how they sum.

#include "simd/chunks.hpp"
#include "simd/lanes.hpp"

namespace carom {
namespace {

/// As many consecutive bodies of a chunk as there are lanes. At the end of the rows there may be fewer: then the lanes
/// that are left over repeat the last body, and what they compute is dropped.
struct Group {
    size_t row;    ///< of the first
    size_t part;   ///< its place in the chunk
    size_t count;  ///< of bodies from here to the end of the rows

    bool full() const { return count >= static_cast<size_t>(lanes); }
    /// The same bodies in an array that begins with the body in row `first`.
    Group in_block(size_t first) const { return {row - first, part, count}; }
    Lanes2 of(const double* xy) const {
        if (full()) return pairs_from(xy + 2 * row);
        return pairs(xy, [this](int lane) { return row + (static_cast<size_t>(lane) < count ? lane : count - 1); });
    }
    Lanes of_numbers(const double* numbers) const {
        if (full()) return load(numbers + row);
        Lanes out{};
        for (size_t lane = 0; lane < static_cast<size_t>(lanes); ++lane)
            out[lane] = numbers[row + (lane < count ? lane : count - 1)];
        return out;
    }
    Lanes without_left_over(Lanes a) const {
        return full() ? a : select(places() < all(static_cast<double>(count)), a, Lanes{});
    }
};

/// Calls work(group) for the rows from first, a multiple of chunk_rows, to last − 1, of as many as there are.
template <class Work>
inline void for_each_group(size_t first, size_t last, size_t rows, Work work) {
    for (size_t chunk = first; chunk < last; chunk += chunk_rows)
        for (size_t part = 0; part < chunk_rows; part += static_cast<size_t>(lanes))
            if (chunk + part < rows) work(Group{chunk + part, part, rows - chunk - part});
}

/// A sum for each place in a chunk, added up at the end: an order that does not depend on the number of lanes.
struct Sums {
    Lanes of[chunk_rows / lanes] = {};

    void add(const Group& g, Lanes a) { of[g.part / lanes] += g.without_left_over(a); }
    double total() const {
        double sum = 0;
        for (const Lanes& some : of)
            for (int lane = 0; lane < lanes; ++lane) sum += some[lane];
        return sum;
    }
};

// The same for worlds of a few bodies, one after the other without lanes: kernels that say auto do both. In one chunk
// places are added up in the order of the rows.

struct Single2 {
    double x, y;
};
struct Single {
    size_t row, part, count = 1;

    Single in_block(size_t first) const { return {row - first, part}; }
    Single2 of(const double* xy) const { return {xy[2 * row], xy[2 * row + 1]}; }
    double of_numbers(const double* numbers) const { return numbers[row]; }
};
inline double select(bool where, double yes, double no) { return where ? yes : no; }
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
