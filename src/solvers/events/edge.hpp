#pragma once
// Where a block of a gas ends.

#include <algorithm>
#include <carom/solver.hpp>
#include <cstdint>
#include <vector>

#include "math/bits.hpp"
#include "solvers/events/grid.hpp"
#include "state/motion.hpp"

namespace carom {

/// What events add to, in a step or in a part of one.
struct GasBooks {
    Flows account;
    GasTally tally;

    void operator+=(const GasBooks& other) {
        account += other.account;
        tally += other.tally;
    }
};

/// Around the inner cells of a block.
struct GasBorder {
    /// An event reads the cells around it and around its partner's.
    static constexpr std::int32_t reach = 2;

    std::int32_t left = 0, right = 0, bottom = 0, top = 0;  ///< of the inner cells

    /// How many cells away from the inner ones.
    std::int32_t distance(std::int32_t column, std::int32_t row) const {
        return std::max({left - column, column - right + 1, bottom - row, row - top + 1, 0});
    }
    /// Whether another block can have a say in what happens in a cell, or this one in what another block says of it.
    bool disputed(std::int32_t column, std::int32_t row) const {
        const bool deep =
            column >= left + reach && column < right - reach && row >= bottom + reach && row < top - reach;
        return !deep && distance(column, row) <= reach;
    }
    /// Of a disputed cell among all that are: those below, those above, then left and right.
    std::size_t index(std::int32_t column, std::int32_t row) const {
        const std::int32_t x = column - left + reach, y = row - bottom + reach;
        if (y < frame) return static_cast<std::size_t>(y * columns() + x);
        if (y >= rows() - frame) return static_cast<std::size_t>((y - rows() + 2 * frame) * columns() + x);
        return static_cast<std::size_t>(2 * frame * (columns() + y - frame) +
                                        (x < frame ? x : x - columns() + 2 * frame));
    }
    std::size_t size() const { return static_cast<std::size_t>(2 * frame * (columns() + rows() - 2 * frame)); }
    /// Whether f(column, row) is true of all that another block has and this one has a say in.
    template <class F>
    bool all_beyond(F f) const {
        for (std::int32_t row = bottom - reach; row < top + reach; ++row) {
            const bool beside = row >= bottom && row < top;
            for (std::int32_t column = left - reach; column < right + reach; ++column) {
                if (beside && column == left) column = right;
                if (!f(column, row)) return false;
            }
        }
        return true;
    }

  private:
    static constexpr std::int32_t frame = 2 * reach;
    std::int32_t columns() const { return right - left + frame; }
    std::int32_t rows() const { return top - bottom + frame; }
};

/// A block foretells the course of its inner cells from a window around them; of what happens beyond the window it
/// knows nothing, and the error comes nearer from event to event. Whether it came too near is known afterwards: see
/// blocks.hpp.
struct GasEdge {
    /// Cells around the inner ones whose events are foretold.
    static constexpr std::int32_t width = 6;

    GasBorder border;                    ///< in the window
    double from = 0;                     ///< the time in question
    std::vector<std::uint64_t> history;  ///< of each disputed cell: a hash of all that came into it
    std::vector<std::uint8_t> changed;   ///< of each disc of the window: whether anything happened to it
    GasBooks beyond;                     ///< what other blocks book

    /// A disc's flight as it is from now on, in a cell.
    void note(std::int32_t column, std::int32_t row, const GasDisc& d, std::uint32_t of) {
        if (!border.disputed(column, row)) return;
        std::uint64_t& hash = history[border.index(column, row)];
        for (const double x : {d.x.x, d.x.y, d.v.x, d.v.y, d.clock}) hash = mixed(hash, to_bits(x));
        hash = mixed(hash, of);
    }
};

}  // namespace carom
