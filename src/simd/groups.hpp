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
    /// Of an array of x, y, z, w.
    Lanes4 of_fours(const double* xyzw) const {
        return quads_of(xyzw, [this](int lane) {
            return row + (full() || static_cast<size_t>(lane) < count ? static_cast<size_t>(lane) : count - 1);
        });
    }
    /// Where a flag is set; in no lane if there are none.
    Mask flagged(const unsigned char* flags) const {
        Mask out{};
        if (!flags) return out;
        if (full()) {
            using Some = char __attribute__((vector_size(lanes)));
            const Some some = load_as<Some>(flags + row), none{};
            if (__builtin_memcmp(&some, &none, sizeof some) == 0) return out;
        }
        for (size_t lane = 0; lane < static_cast<size_t>(lanes) && lane < count; ++lane)
            out[lane] = flags[row + lane] != 0 ? -1 : 0;
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

}  // namespace
}  // namespace carom
