#pragma once
// Which discs are in which cell.

#include <array>

#include "simd/prefetch.hpp"
#include "solvers/events/grid.hpp"

namespace carom {

/// The first discs of a cell; those that do not fit hang on the last of them, linked by `next_in_cell`.
struct alignas(16) GasCrowd {
    static constexpr std::uint32_t at_hand = 3;

    std::array<Slot, at_hand> slot{no_slot, no_slot, no_slot};
    std::uint32_t count = 0;  ///< of all

    void put(GasDisc* discs, Slot i) {
        if (count < at_hand) {
            slot[count] = i;
            discs[i].next_in_cell = no_slot;
        } else {
            discs[i].next_in_cell = discs[slot.back()].next_in_cell;
            discs[slot.back()].next_in_cell = i;
        }
        ++count;
    }
    void take(GasDisc* discs, Slot i) {
        --count;
        if (count >= at_hand) return take_from_many(discs, i);
        for (Slot& s : slot)
            if (s == i) s = slot[count];
    }

  private:
    void take_from_many(GasDisc* discs, Slot i) {
        const Slot last = slot.back(), behind = discs[last].next_in_cell;
        for (Slot& s : slot) {
            if (s != i) continue;
            s = behind;
            if (i != last) discs[last].next_in_cell = discs[behind].next_in_cell;
            return;
        }
        Slot before = last;
        while (discs[before].next_in_cell != i) before = discs[before].next_in_cell;
        discs[before].next_in_cell = discs[i].next_in_cell;
    }
};
static_assert(sizeof(GasCrowd) == 16);

/// A cell and those around it are numbered by rows, from below left to above right.
inline constexpr std::size_t cells_around = 9;
constexpr std::int32_t column_around(std::size_t k) { return static_cast<std::int32_t>(k % 3) - 1; }
constexpr std::int32_t row_around(std::size_t k) { return static_cast<std::int32_t>(k / 3) - 1; }

/// The crowds of a window's cells.
class GasCells {
  public:
    using Rim = std::array<GasCrowd, cells_around>;
    /// Three rows of three.
    struct Around {
        const GasCrowd* first;
        std::ptrdiff_t row;
        const GasCrowd& at(std::size_t k) const {
            return first[static_cast<std::ptrdiff_t>(k / 3) * row + static_cast<std::ptrdiff_t>(k % 3)];
        }
    };
    /// Without discs.
    void begin(const GasWindow& window);
    GasCrowd& at(Cell c) { return crowd_[window_.index(c)]; }

    /// Asks for the memory of those around a cell; not at the rim of the window.
    void fetch_around(Cell at) const {
        if (is_at_rim(at)) return;
        const GasCrowd* const middle = &crowd_[window_.index(at)];
        for (std::ptrdiff_t row = -1; row <= 1; ++row) {
            prefetch(middle + row * window_.nx - 1);
            prefetch(middle + row * window_.nx + 1);
        }
    }
    /// Calls f with the first disc of each cell around one, or what was there; not at the rim of the window.
    template <class F>
    void for_first_around(Cell at, F f) const {
        if (is_at_rim(at)) return;
        const GasCrowd* const middle = &crowd_[window_.index(at)];
        for (std::ptrdiff_t row = -1; row <= 1; ++row)
            for (std::ptrdiff_t column = -1; column <= 1; ++column) f(middle[row * window_.nx + column].slot[0]);
    }

    /// Those around a cell; at the rim of the window they are copied to one place.
    Around around(Cell at, Rim& rim) const {
        if (is_at_rim(at)) return around_the_rim(window_.column(at), window_.row(at), rim);
        return {&crowd_[window_.index(at)] - window_.nx - 1, window_.nx};
    }

  private:
    bool is_at_rim(Cell at) const {
        const std::int32_t x = window_.column(at), y = window_.row(at);
        return x <= 0 || x + 1 >= window_.nx || y <= 0 || y + 1 >= window_.ny;
    }
    Around around_the_rim(std::int32_t x, std::int32_t y, Rim& rim) const;

    GasWindow window_;
    std::vector<GasCrowd> crowd_;
};

}  // namespace carom
