#include "collision/grid.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

void Grid::build(std::span<const Vec2> centre, std::span<const double> radius, const std::optional<Periodic>& box) {
    box_ = box;
    double least = 0;
    for (const double r : radius)
        if (r > 0 && (least == 0 || r < least)) least = r;
    smallest_ = least > 0 ? 2 * least : 1;
    population_ = {};
    for (int level = 0; level < levels; ++level) {
        const double width = std::ldexp(smallest_, level);
        const double across[] = {box ? box->high.x - box->low.x : 0, box ? box->high.y - box->low.y : 0};
        for (int axis = 0; axis < 2; ++axis) {
            count_[axis][level] =
                std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(across[axis] / width, 1e9)));
            width_[axis][level] = box ? across[axis] / static_cast<double>(count_[axis][level]) : width;
        }
    }
    std::size_t buckets = 16;
    while (buckets < 2 * centre.size()) buckets *= 2;
    first_.assign(buckets, none);
    next_.assign(centre.size(), none);
    cell_.resize(centre.size());
    for (std::uint32_t i = 0; i < centre.size(); ++i) insert(i, cell_of(centre[i], radius[i]));
}

int Grid::level_of(double radius) const {
    if (2 * radius <= smallest_) return 0;
    return std::min(levels - 1, std::ilogb(2 * radius / smallest_) + 1);
}

std::int64_t Grid::column(int level, double x, int axis) const {
    const double low = !box_ ? 0 : axis == 0 ? box_->low.x : box_->low.y;
    // Beyond 2^62 cells from the origin all share one column: rightly found, if slowly.
    const double cells = std::floor((x - low) / width_[axis][level]);
    const auto index = static_cast<std::int64_t>(std::clamp(cells, -4e18, 4e18));
    if (!box_) return index;
    const std::int64_t n = count_[axis][level];
    return ((index % n) + n) % n;
}

Grid::Cell Grid::cell_of(Vec2 centre, double radius) const {
    const int level = level_of(radius);
    return {level, column(level, centre.x, 0), column(level, centre.y, 1)};
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

void Grid::near(Vec2 centre, double radius, std::vector<std::uint32_t>& found) const {
    const std::size_t start = found.size();
    for (int level = 0; level < levels; ++level) {
        if (population_[static_cast<std::size_t>(level)] == 0) continue;
        // Discs of this level reach half a cell beyond their own.
        const double reach_x = radius + 0.5 * std::ldexp(smallest_, level);
        const auto from_x = static_cast<std::int64_t>(
            std::floor(std::clamp((centre.x - reach_x - (box_ ? box_->low.x : 0)) / width_[0][level], -4e18, 4e18)));
        const auto to_x = static_cast<std::int64_t>(
            std::floor(std::clamp((centre.x + reach_x - (box_ ? box_->low.x : 0)) / width_[0][level], -4e18, 4e18)));
        const auto from_y = static_cast<std::int64_t>(
            std::floor(std::clamp((centre.y - reach_x - (box_ ? box_->low.y : 0)) / width_[1][level], -4e18, 4e18)));
        const auto to_y = static_cast<std::int64_t>(
            std::floor(std::clamp((centre.y + reach_x - (box_ ? box_->low.y : 0)) / width_[1][level], -4e18, 4e18)));
        // A disc so large that looking at all others is cheaper than looking at all cells.
        const double cells = (static_cast<double>(to_x) - static_cast<double>(from_x) + 1) *
                             (static_cast<double>(to_y) - static_cast<double>(from_y) + 1);
        if (cells > 4.0 * static_cast<double>(cell_.size()) + 16) {
            for (std::uint32_t i = 0; i < cell_.size(); ++i)
                if (cell_[i].level == level) found.push_back(i);
            continue;
        }
        for (std::int64_t y = from_y; y <= to_y; ++y) {
            for (std::int64_t x = from_x; x <= to_x; ++x) {
                if (!box_) {
                    collect({level, x, y}, found);
                    continue;
                }
                const std::int64_t nx = count_[0][level], ny = count_[1][level];
                if (x - from_x < nx && y - from_y < ny)
                    collect({level, ((x % nx) + nx) % nx, ((y % ny) + ny) % ny}, found);
            }
        }
    }
    (void)start;
}

}  // namespace carom
