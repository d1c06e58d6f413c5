#include "collision/grid.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

void Grid::prepare(std::span<const double> radius, const std::optional<Periodic>& box) {
    box_ = box;
    double least = 0, most = 0;
    for (const double r : radius) {
        if (r > 0 && (least == 0 || r < least)) least = r;
        most = std::max(most, r);
    }
    // Level 0 holds discs up to four times the smallest, which one level thus does for most gases; the level of the
    // largest fits it exactly. 20 levels for the radii there are leave 12 for discs that grow.
    smallest_ = most > 0 ? 2 * most : 1;
    for (int level = 0; level < 20 && smallest_ > 8 * least; ++level) smallest_ /= 4;
    population_ = {};
    for (int axis = 0; axis < 2; ++axis) {
        const double across = !box ? 0 : axis == 0 ? box->high.x - box->low.x : box->high.y - box->low.y;
        for (int level = 0; level < levels; ++level) {
            const double width = width_of(level);
            const double count = std::clamp(std::floor(across / width), 1.0, 1e9);
            count_[axis][level] = static_cast<std::int64_t>(count);
            width_[axis][level] = box ? across / count : width;
        }
    }
    std::size_t buckets = 16;
    while (buckets < 2 * radius.size()) buckets *= 2;
    first_.assign(buckets, none);
    next_.assign(radius.size(), none);
    cell_.assign(radius.size(), Cell{-1, 0, 0});
}

void Grid::build(std::span<const Vec2> centre, std::span<const double> radius, const std::optional<Periodic>& box) {
    prepare(radius, box);
    for (std::uint32_t i = 0; i < centre.size(); ++i) put(i, centre[i], radius[i]);
}

int Grid::level_of(double radius) const {
    int level = 0;
    for (double width = smallest_; width < 2 * radius && level < levels - 1; width *= 4) ++level;
    return level;
}

std::int64_t Grid::index(int level, int axis, double x) const {
    const double low = !box_ ? 0 : axis == 0 ? box_->low.x : box_->low.y;
    // Beyond 2^61 cells from the origin all share one column: rightly found, if slowly. So do those whose place is not
    // a number, which std::clamp would let through.
    return static_cast<std::int64_t>(std::max(-0x1p61, std::min(0x1p61, std::floor((x - low) / width_[axis][level]))));
}

std::int64_t Grid::wrapped(int level, int axis, std::int64_t index) const {
    if (!box_) return index;
    const std::int64_t n = count_[axis][level], rest = index % n;
    return rest < 0 ? rest + n : rest;
}

Grid::Cell Grid::cell_of(Vec2 centre, double radius) const {
    const int level = level_of(radius);
    return {level, wrapped(level, 0, index(level, 0, centre.x)), wrapped(level, 1, index(level, 1, centre.y))};
}

Grid::Strip Grid::strip(int level, int axis, double from, double to) const {
    const Strip found{index(level, axis, from), index(level, axis, to)};
    const std::int64_t across = count_[axis][level];
    return box_ && found.last - found.first >= across ? Strip{0, across - 1} : found;
}

std::size_t Grid::bucket(const Cell& cell) const {
    auto mix = static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15u +
               static_cast<std::uint64_t>(cell.y) * 0xc2b2ae3d27d4eb4fu +
               static_cast<std::uint64_t>(cell.level) * 0x165667b19e3779f9u;
    mix ^= mix >> 29;
    return (mix * 0xbf58476d1ce4e5b9u >> 20) & (first_.size() - 1);
}

void Grid::insert(std::uint32_t i, const Cell& cell) {
    cell_[i] = cell;
    std::uint32_t& head = first_[bucket(cell)];
    next_[i] = head;
    head = i;
    ++population_[static_cast<std::size_t>(cell.level)];
}

void Grid::erase(std::uint32_t i) {
    std::uint32_t* link = &first_[bucket(cell_[i])];
    while (*link != i) link = &next_[*link];
    *link = next_[i];
    --population_[static_cast<std::size_t>(cell_[i].level)];
}

void Grid::move(std::uint32_t i, Vec2 centre, double radius) {
    const Cell cell = cell_of(centre, radius);
    if (cell == cell_[i]) return;
    erase(i);
    insert(i, cell);
}

void Grid::collect(const Cell& cell, std::vector<std::uint32_t>& found) const {
    for (std::uint32_t i = first_[bucket(cell)]; i != none; i = next_[i])
        if (cell_[i] == cell) found.push_back(i);
}

void Grid::collect_level(int level, std::vector<std::uint32_t>& found) const {
    for (std::uint32_t i = 0; i < cell_.size(); ++i)
        if (cell_[i].level == level) found.push_back(i);
}

void Grid::near(Vec2 centre, double radius, std::vector<std::uint32_t>& found) const {
    for (int level = 0; level < levels; ++level) {
        if (population_[static_cast<std::size_t>(level)] == 0) continue;
        // A disc of this level reaches half a cell beyond its centre; a hair more, for the rounding of a wrapped one.
        const double reach = radius + (0.5 + 1e-9) * width_of(level);
        const Strip columns = strip(level, 0, centre.x - reach, centre.x + reach);
        const Strip rows = strip(level, 1, centre.y - reach, centre.y + reach);
        // To a disc so large, all others are sooner looked at than all cells.
        if (columns.count() * rows.count() > 4.0 * static_cast<double>(cell_.size()) + 16) {
            collect_level(level, found);
            continue;
        }
        for (std::int64_t y = rows.first; y <= rows.last; ++y)
            for (std::int64_t x = columns.first; x <= columns.last; ++x)
                collect({level, wrapped(level, 0, x), wrapped(level, 1, y)}, found);
    }
}

}  // namespace carom
