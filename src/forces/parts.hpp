#pragma once
// How rows are shared between threads: in parts that depend on the number of rows alone, so that what each part adds
// up, and the order in which the parts are added, are the same for every number of threads.

#include <algorithm>
#include <array>

#include "forces/network_layout.hpp"
#include "threads/parallel.hpp"

namespace carom {

constexpr std::size_t most_parts = 64, rows_at_once = 1024;

struct Parts {
    std::size_t rows, count;

    explicit Parts(std::size_t all_rows)
        : rows(all_rows), count(std::clamp<std::size_t>(all_rows / rows_at_once, 1, most_parts)) {}
    std::size_t begin(std::size_t part) const {
        return part == count ? rows : rows * part / count / chunk_rows * chunk_rows;
    }
};

template <class Sum, class Work>
void add_over_parts(int threads, std::size_t rows, Sum& total, const Work& work) {
    const Parts parts(rows);
    const auto add_part = [&](std::size_t part, Sum& sum) {
        for (std::size_t first = parts.begin(part), end = parts.begin(part + 1); first < end; first += rows_at_once)
            work(first, std::min(first + rows_at_once, end), sum);
    };
    if (parts.count == 1) return add_part(0, total);
    std::array<Sum, most_parts> sums{};
    parallel_for(threads, parts.count, [&](std::size_t part) { add_part(part, sums[part]); });
    for (std::size_t part = 0; part < parts.count; ++part) total += sums[part];
}
/// Calls work(first, last, sum) for blocks of rows that fit into a cache, the first of them a multiple of chunk_rows.
/// Every part has a sum of its own, which its blocks go through in order; the total += each of them.
template <class Sum, class Work>
void add_over_rows(int threads, std::size_t rows, Sum& total, const Work& work) {
    if (rows > rows_at_once)
        add_over_parts(threads, rows, total, work);
    else if (rows > 0)
        work(0, rows, total);
}
template <class Sum, class Work>
Sum sum_over_rows(int threads, std::size_t rows, const Work& work) {
    Sum total{};
    add_over_rows(threads, rows, total, work);
    return total;
}

/// The same without a sum.
template <class Work>
void for_each_rows(int threads, std::size_t rows, const Work& work) {
    struct Nothing {
        void operator+=(Nothing) {}
    };
    sum_over_rows<Nothing>(threads, rows, [&](std::size_t first, std::size_t last, Nothing&) { work(first, last); });
}

}  // namespace carom
