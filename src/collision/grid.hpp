#pragma once
// Broad phase for discs of any mix of radii: a hierarchy of grids in one hash table. A disc is at home in the grid
// whose cells are at least as wide as the disc, so that it reaches no farther than the neighbouring cells; a grid per
// power of four, where there are discs of that size. In all coarser ones it is a guest: who looks around looks at all
// of one grid whose cells are about as wide as its own reach, and at those who are at home in coarser ones; never at
// all the cells of a finer one, which may be thousands for few discs. Cost grows linearly with the number of discs
// (Ericson, Real-Time Collision Detection, 2005, 7.2).

#include <carom/vec2.hpp>
#include <carom/wall.hpp>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom {

class Grid {
  public:
    /// Empties the grid and makes it fit discs of these radii.
    void prepare(std::span<const double> radius, const std::optional<Periodic>& box);
    /// Takes disc i in.
    void put(std::uint32_t i, Vec2 centre, double radius) { move(i, centre, radius); }
    /// Takes all discs in.
    void build(std::span<const Vec2> centre, std::span<const double> radius, const std::optional<Periodic>& box);
    /// Disc i is elsewhere now, or of another size.
    void move(std::uint32_t i, Vec2 centre, double radius);
    /// Appends to `found` every disc that may overlap the one given, in no order, perhaps itself, each once.
    void near(Vec2 centre, double radius, std::vector<std::uint32_t>& found) const;

  private:
    /// A cell of a level, and whether the list is that of its guests.
    struct Cell {
        int level;
        bool of_guests;
        std::int64_t x, y;
        bool operator==(const Cell&) const = default;
    };
    struct Level {
        double wide;                ///< at least so wide are its cells [m]: no disc that is at home or a guest is wider
        double width[2];            ///< width of a cell, by axis
        std::int64_t across[2];     ///< cells across a periodic box
        std::size_t homes, guests;  ///< how many discs
    };
    /// Columns (axis 0) or rows (axis 1) of a level, first and last.
    struct Strip {
        std::int64_t first, last;
        double count() const { return static_cast<double>(last) - static_cast<double>(first) + 1; }
    };
    struct Part {
        Strip columns, rows;
        double cells() const { return columns.count() * rows.count(); }
    };
    static constexpr std::uint32_t none = 0xffffffff;
    static constexpr Cell nowhere{-1, false, 0, 0};

    void open(double wide);
    std::size_t home_of(double radius);
    void place(std::uint32_t i, std::size_t level, const Cell& cell);
    std::size_t level_around(Vec2 centre, double radius) const;
    std::int64_t index(const Level& level, int axis, double x) const;
    std::int64_t wrapped(const Level& level, int axis, std::int64_t index) const;
    Strip strip(const Level& level, int axis, double from, double to) const;
    Part part(const Level& level, Vec2 centre, double radius) const;
    std::size_t bucket(const Cell& cell) const;
    void collect(std::size_t level, bool guests_too, const Part& part, std::vector<std::uint32_t>& found) const;
    void collect(const Cell& cell, std::vector<std::uint32_t>& found) const;

    std::optional<Periodic> box_;
    std::size_t discs_ = 0;
    std::vector<Level> levels_;  ///< from fine to coarse
    std::size_t prepared_ = 0;   ///< levels that have guests; later ones hold discs that have outgrown all of these
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> next_;  ///< by level, and in it by disc
    std::vector<Cell> cell_;           ///< as next_
};

}  // namespace carom
