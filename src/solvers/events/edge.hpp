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

/// A block foretells the course of its inner cells from a window around them; of what happens beyond the window it
/// knows nothing, and the error comes nearer from event to event. Whether it came too near is known afterwards: see
/// blocks.hpp.
struct GasEdge {
    /// An event reads the cells around it and around its partner's.
    static constexpr std::int32_t reach = 2;
    /// Cells around the inner ones whose events are foretold.
    static constexpr std::int32_t width = 6;

    std::int32_t left = 0, right = 0, bottom = 0, top = 0;  ///< of the inner cells, in the window
    double from = 0;                                        ///< the time in question
    std::vector<std::uint64_t> history;  ///< of each cell of the window: a hash of all that came into it
    std::vector<std::uint8_t> changed;   ///< of each disc of the window: whether anything happened to it
    GasBooks beyond;                     ///< what other blocks book

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
    /// Which of the inner cells that are disputed, of a block of so many columns and rows; and how many these are.
    static std::size_t rim_index(std::int32_t column, std::int32_t row, std::int32_t columns, std::int32_t rows) {
        if (row < reach) return static_cast<std::size_t>(row * columns + column);
        if (row >= rows - reach) return static_cast<std::size_t>((row - rows + 2 * reach) * columns + column);
        return static_cast<std::size_t>(2 * reach * (columns + row - reach) +
                                        (column < reach ? column : column - columns + 2 * reach));
    }
    static std::size_t rim_size(std::int32_t columns, std::int32_t rows) {
        return static_cast<std::size_t>(2 * reach * (columns + rows - 2 * reach));
    }
    /// A disc's flight as it is from now on, in a cell.
    void note(std::size_t cell, const GasDisc& d, std::uint32_t row) {
        std::uint64_t hash = history[cell];
        for (const double x : {d.x.x, d.x.y, d.v.x, d.v.y, d.clock}) hash = mixed(hash, to_bits(x));
        hash = mixed(hash, row);
        history[cell] = hash;
    }
};

}  // namespace carom
