#pragma once
// The cells of the exact gas. Places are relative to the middle of a cell, so that they are as precise far from the
// origin as near it.

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "collision/walls.hpp"
#include "solvers/events/disc.hpp"

namespace carom {

/// The cells that a part of the gas has lists of: a rectangle of the grid, which may reach around what is rolled up.
struct GasWindow {
    std::int32_t x = 0, y = 0;          ///< its first column and row
    std::int32_t nx = 1, ny = 1;        ///< how many it has
    std::int32_t all_x = 1, all_y = 1;  ///< how many there are

    std::int32_t column(Cell c) const { return c.x >= x ? c.x - x : c.x - x + all_x; }
    std::int32_t row(Cell c) const { return c.y >= y ? c.y - y : c.y - y + all_y; }
    bool has(Cell c) const { return column(c) < nx && row(c) < ny; }
    std::size_t cells() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
    std::size_t index(std::int32_t column, std::int32_t row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(column);
    }
    std::size_t index(Cell c) const { return index(column(c), row(c)); }
};

/// Cells in storage. What is beyond the last column is the first one again: in a periodic box that is the physics; in
/// the open plane `turns` tells the discs apart that share a cell of storage; a room that no disc leaves has a rim of
/// cells in which no disc ever is.
struct GasGrid {
    enum class Rim { periodic, open, closed };

    Rim rim = Rim::open;
    Vec2 low{};       ///< corner of cell (0, 0) [m]
    Vec2 side{1, 1};  ///< of a cell [m]
    std::int32_t nx = 1, ny = 1;

    std::size_t cells() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
    std::size_t index(Cell c) const { return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(nx) + c.x; }
    GasWindow all() const { return {0, 0, nx, ny, nx, ny}; }
    /// The middle of the cell a disc is in, with the times it went around.
    Vec2 middle(const GasDisc& d) const {
        return {low.x + (static_cast<double>(d.cell.x + static_cast<std::int64_t>(d.turns_x) * nx) + 0.5) * side.x,
                low.y + (static_cast<double>(d.cell.y + static_cast<std::int64_t>(d.turns_y) * ny) + 0.5) * side.y};
    }
    /// Puts a disc into the cell of a place.
    void put(GasDisc& d, Vec2 place) const;
    /// From the middle of a's cell to that of b's; in a periodic box to that of b's images whose cell is nearest.
    Vec2 between(const GasDisc& a, const GasDisc& b) const;
    /// To b itself, however often either went around.
    Vec2 unrolled(const GasDisc& a, const GasDisc& b) const {
        return {static_cast<double>(columns(a, b)) * side.x, static_cast<double>(rows(a, b)) * side.y};
    }
    /// In the open plane: whether their cells are one or side by side, or just share storage with such.
    bool is_near(const GasDisc& a, const GasDisc& b) const {
        return std::abs(columns(a, b)) <= 1 && std::abs(rows(a, b)) <= 1;
    }
    /// Whether two cells have more than one way to one another: of two along a side of the box, or one, the neighbours
    /// on both sides are the same.
    bool has_twins() const { return rim == Rim::periodic && std::min(nx, ny) <= 2; }
    /// The cell so many columns and rows on, in a periodic box.
    Cell around(Cell c, std::int32_t column, std::int32_t row) const {
        return {static_cast<std::uint16_t>((c.x + column + nx) % nx),
                static_cast<std::uint16_t>((c.y + row + ny) % ny)};
    }

  private:
    std::int64_t columns(const GasDisc& a, const GasDisc& b) const {
        return b.cell.x - a.cell.x + (static_cast<std::int64_t>(b.turns_x) - a.turns_x) * nx;
    }
    std::int64_t rows(const GasDisc& a, const GasDisc& b) const {
        return b.cell.y - a.cell.y + (static_cast<std::int64_t>(b.turns_y) - a.turns_y) * ny;
    }
};
auto members(Maybe_const<GasGrid> auto& grid) {
    auto& [rim, low, side, nx, ny] = grid;
    return std::tie(rim, low, side, nx, ny);
}

/// Where a gas can be: in a periodic box or a room, or, if it can go anywhere, around where it is.
struct GasRoom {
    GasGrid::Rim rim = GasGrid::Rim::open;
    Vec2 low{}, high{};
    double area = 0;  ///< [m²] of a room or a box
};
GasRoom room_of(const Walls& walls, const std::vector<Vec2>& places);

/// A grid for so many discs in a room: cells no smaller than the widest disc.
GasGrid choose_grid(const GasRoom& room, std::size_t discs, double widest);

}  // namespace carom
