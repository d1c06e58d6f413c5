#pragma once
// What threads share in the serial parts of a step: they look, and one of them acts on what was found, in order.

#include <bit>
#include <cstdint>

#include "forces/parts.hpp"
#include "math/scratch.hpp"
#include "state/row_ranges.hpp"
#include "threads/parallel.hpp"

namespace carom {

/// How many threads share the rows that move: one where they are no more than a grain, among however many sleepers.
inline int sharing(int threads, const RowRanges& moving, std::size_t grain = rows_at_once) {
    return moving.count() > grain ? threads : 1;
}

/// Calls act(first, last) for the rows that move, of so many.
template <class Act>
void for_each_moving(int threads, const RowRanges& moving, std::size_t rows, const Act& act,
                     std::size_t grain = rows_at_once) {
    parallel_ranges(sharing(threads, moving, grain), rows, grain,
                    [&](std::size_t first, std::size_t last) { moving.within(first, last, act); });
}

/// Calls act(block, row) for the rows of blocks that look(block) has set as bits, in order. A grain of blocks is worth
/// sharing.
template <class Look, class Act>
void each_row_where(int threads, std::size_t blocks, const Look& look, const Act& act, std::size_t grain = 128) {
    Scratch<std::uint32_t> found(blocks);
    parallel_ranges(threads, blocks, grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) found[k] = look(k);
    });
    for (std::size_t k = 0; k < blocks; ++k)
        for (std::uint32_t left = found[k]; left != 0; left &= left - 1)
            act(k, static_cast<std::uint32_t>(std::countr_zero(left)));
}

/// Those of a list for which is_one(one) is true, in order.
template <class IsOne>
Scratch<std::uint32_t> those_of(int threads, const Scratch<std::uint32_t>& list, const IsOne& is_one) {
    constexpr std::size_t some = 32;
    Scratch<std::uint32_t> found;
    const auto look = [&](std::size_t block) {
        std::uint32_t those = 0;
        for (std::size_t k = some * block; k < std::min(some * (block + 1), list.size()); ++k)
            those |= std::uint32_t{is_one(list[k])} << k % some;
        return those;
    };
    const auto note = [&](std::size_t block, std::uint32_t k) { found.push_back(list[some * block + k]); };
    each_row_where(threads, (list.size() + some - 1) / some, look, note, 8);
    return found;
}

/// Calls act(one) for all of a list, in no order.
template <class List, class Act>
void act_on_all(int threads, List& list, const Act& act) {
    for_each_rows(threads, list.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) act(list[i]);
    });
}

/// Whether is_one(index) is true of any of so many.
template <class IsOne>
bool is_any(int threads, std::size_t count, const IsOne& is_one) {
    struct Found {
        bool any = false;
        void operator+=(Found other) { any |= other.any; }
    };
    const auto look = [&](std::size_t first, std::size_t last, Found& found) {
        for (std::size_t i = first; i < last && !found.any; ++i) found.any = is_one(i);
    };
    return sum_over_rows<Found>(threads, count, look).any;
}

}  // namespace carom
