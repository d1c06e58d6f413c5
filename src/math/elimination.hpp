#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "math/scratch.hpp"

namespace carom {

/// An order in which the rows of a symmetric matrix are eliminated, and what that leaves.
struct Elimination {
    Scratch<std::uint32_t> rows{};   ///< in order
    Scratch<std::size_t> column{};   ///< of each place in it, where its part of `below` begins; and the end of the last
    Scratch<std::uint32_t> below{};  ///< places of those that are coupled with a row when it goes, ascending

    std::size_t count_below(std::size_t place) const { return column[place + 1] - column[place]; }
    /// Products of blocks in a factor, about.
    std::size_t work() const;
};

/// By least degree, which brings no fill into chains and trees: their ends go by turns, other ties by number. Where
/// that brings much, as in a large sheet, the graph is dissected.
Elimination eliminate(std::size_t rows, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings);

}  // namespace carom
