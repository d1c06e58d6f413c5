#pragma once
// Broad phase for discs of any mix of radii: a hierarchy of grids in one hash table. A disc lives in the grid whose
// cells are at least as wide as the disc, so that it reaches no farther than the neighbouring cells; a grid per power
// of four. Cost grows linearly with the number of discs (Ericson, Real-Time Collision Detection, 2005, 7.2).

#include <array>
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
    void put(std::uint32_t i, Vec2 centre, double radius) { insert(i, cell_of(centre, radius)); }
    /// Takes all discs in.
    void build(std::span<const Vec2> centre, std::span<const double> radius, const std::optional<Periodic>& box);
    /// Disc i is elsewhere now, or of another size.
    void move(std::uint32_t i, Vec2 centre, double radius);
    /// Appends to `found` every disc that may overlap the one given, in no order, perhaps itself, each once.
    void near(Vec2 centre, double radius, std::vector<std::uint32_t>& found) const;

  private:
    struct Cell {
        int level;
        std::int64_t x, y;
        bool operator==(const Cell&) const = default;
    };
    /// Columns (axis 0) or rows (axis 1) of a level, first and last.
    struct Strip {
        std::int64_t first, last;
        double count() const { return static_cast<double>(last) - static_cast<double>(first) + 1; }
    };
    static constexpr std::uint32_t none = 0xffffffff;
    static constexpr int levels = 32;

    double width_of(int level) const { return std::ldexp(smallest_, 2 * level); }
    int level_of(double radius) const;
    Cell cell_of(Vec2 centre, double radius) const;
    std::int64_t index(int level, int axis, double x) const;
    std::int64_t wrapped(int level, int axis, std::int64_t index) const;
    Strip strip(int level, int axis, double from, double to) const;
    std::size_t bucket(const Cell& cell) const;
    void insert(std::uint32_t i, const Cell& cell);
    void erase(std::uint32_t i);
    void collect(const Cell& cell, std::vector<std::uint32_t>& found) const;
    void collect_level(int level, std::vector<std::uint32_t>& found) const;

    std::optional<Periodic> box_;
    double smallest_ = 1;                        ///< width of the cells of level 0
    std::array<double, levels> width_[2];        ///< width of a cell, by axis and level
    std::array<std::int64_t, levels> count_[2];  ///< cells across a periodic box
    std::array<std::uint32_t, levels> population_{};
    std::vector<std::uint32_t> first_, next_;
    std::vector<Cell> cell_;
};

}  // namespace carom
