#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "math/scratch.hpp"

namespace carom {

/// Of each row of a matrix, those that it is coupled with, ascending.
using Neighbours = Scratch<Scratch<std::uint32_t>>;

/// An order in which the rows of a symmetric matrix are eliminated, and what that leaves.
struct Elimination {
    Scratch<std::uint32_t> rows{};  ///< in order
    Neighbours later{};             ///< of each row, those that are coupled with it when it goes

    std::size_t count() const { return rows.size(); }
    /// Products of blocks in a factor, about.
    std::size_t work() const;
};

/// By least degree, which brings no fill into chains and trees: their ends go by turns, other ties by number. Where
/// that brings much, as in a large sheet, the graph is dissected.
Elimination eliminate(std::size_t rows, std::span<const std::pair<std::uint32_t, std::uint32_t>> couplings);

}  // namespace carom
