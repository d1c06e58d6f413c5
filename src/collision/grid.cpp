#include "collision/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {

void Grid::prepare(std::span<const double> radius, const std::optional<Periodic>& box) {
    box_ = box;
    double least = 0, most = 0;
    for (const double r : radius) {
        if (r > 0 && (least == 0 || r < least)) least = r;
        most = std::max(most, r);
    }
    // The finest level holds discs up to four times the smallest, which one level thus does for most gases; the level
    // of the largest fits it exactly.
    constexpr int finest = 20;
    int steps = 0;
    double wide = most > 0 ? 2 * most : 1;
    for (; steps < finest && wide > 8 * least; ++steps) wide /= 4;
    std::array<bool, finest + 1> are_there{};
    for (const double r : radius) {
        int step = 0;
        for (double w = wide; w < 2 * r && step < steps; w *= 4) ++step;
        are_there[static_cast<std::size_t>(step)] = true;
    }
    discs_ = radius.size();
    levels_.clear(), next_.clear(), cell_.clear();
    for (int step = 0; step <= steps; ++step, wide *= 4)
        if (are_there[static_cast<std::size_t>(step)] || step == steps) open(wide);
    prepared_ = levels_.size();
    std::size_t buckets = 16;
    while (buckets < 2 * next_.size()) buckets *= 2;
    first_.assign(buckets, none);
}

void Grid::build(std::span<const Vec2> centre, std::span<const double> radius, const std::optional<Periodic>& box) {
    prepare(radius, box);
    for (std::uint32_t i = 0; i < centre.size(); ++i) put(i, centre[i], radius[i]);
}

/// Adds a level that is coarser than all there are. Nobody is in it yet.
void Grid::open(double wide) {
    Level& level = levels_.emplace_back(Level{wide, {wide, wide}, {1, 1}, 0, 0});
    next_.resize(next_.size() + discs_, none);
    cell_.resize(cell_.size() + discs_, nowhere);
    if (!box_) return;
    const Vec2 size = box_->high - box_->low;
    for (const int axis : {0, 1}) {
        const double across = axis == 0 ? size.x : size.y, count = std::clamp(std::floor(across / wide), 1.0, 1e9);
        level.across[axis] = static_cast<std::int64_t>(count);
        level.width[axis] = across / count;
    }
}

/// The finest level for a disc. There is one more for a disc that has grown beyond all.
std::size_t Grid::home_of(double radius) {
    constexpr double widest = 1e300;
    std::size_t home = 0;
    for (; levels_[home].wide < 2 * radius; ++home)
        if (home + 1 == levels_.size()) {
            const double wide = levels_[home].wide;
            if (wide >= widest) break;
            open(std::min(std::max(4 * wide, 2 * radius), widest));
        }
    return home;
}

std::int64_t Grid::index(const Level& level, int axis, double x) const {
    const double low = !box_ ? 0 : axis == 0 ? box_->low.x : box_->low.y;
    // Beyond 2^61 cells from the origin all share one column: rightly found, if slowly. So do those whose place is not
    // a number, which std::clamp would let through.
    return static_cast<std::int64_t>(std::max(-0x1p61, std::min(0x1p61, std::floor((x - low) / level.width[axis]))));
}

std::int64_t Grid::wrapped(const Level& level, int axis, std::int64_t index) const {
    if (!box_) return index;
    const std::int64_t n = level.across[axis], rest = index % n;
    return rest < 0 ? rest + n : rest;
}

Grid::Strip Grid::strip(const Level& level, int axis, double from, double to) const {
    const Strip found{index(level, axis, from), index(level, axis, to)};
    const std::int64_t across = level.across[axis];
    return box_ && found.last - found.first >= across ? Strip{0, across - 1} : found;
}

Grid::Part Grid::part(const Level& level, Vec2 centre, double radius) const {
    // A disc of this level reaches half a cell beyond its centre; a hair more, for the rounding of a wrapped one.
    const double reach = radius + (0.5 + 1e-9) * level.wide;
    return {strip(level, 0, centre.x - reach, centre.x + reach), strip(level, 1, centre.y - reach, centre.y + reach)};
}

std::size_t Grid::bucket(const Cell& cell) const {
    auto mix = static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15u +
               static_cast<std::uint64_t>(cell.y) * 0xc2b2ae3d27d4eb4fu +
               static_cast<std::uint64_t>(2 * cell.level + cell.of_guests) * 0x165667b19e3779f9u;
    mix ^= mix >> 29;
    return (mix * 0xbf58476d1ce4e5b9u >> 20) & (first_.size() - 1);
}

/// Puts a disc into a cell of a level, or takes it out of the level.
void Grid::place(std::uint32_t i, std::size_t level, const Cell& cell) {
    const std::size_t node = level * discs_ + i;
    Cell& old = cell_[node];
    if (cell == old) return;
    const auto count = [&](const Cell& c) -> std::size_t& {
        return c.of_guests ? levels_[level].guests : levels_[level].homes;
    };
    if (old != nowhere) {
        std::uint32_t* link = &first_[bucket(old)];
        while (*link != node) link = &next_[*link];
        *link = next_[node];
        --count(old);
    }
    old = cell;
    if (cell == nowhere) return;
    std::uint32_t& head = first_[bucket(cell)];
    next_[node] = head;
    head = static_cast<std::uint32_t>(node);
    ++count(cell);
}

void Grid::move(std::uint32_t i, Vec2 centre, double radius) {
    const std::size_t home = home_of(radius);
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        const Level& level = levels_[l];
        const bool is_in = l == home || (l > home && l < prepared_);
        place(i, l,
              !is_in ? nowhere
                     : Cell{static_cast<int>(l), l > home, wrapped(level, 0, index(level, 0, centre.x)),
                            wrapped(level, 1, index(level, 1, centre.y))});
    }
}

void Grid::collect(const Cell& cell, std::vector<std::uint32_t>& found) const {
    const std::size_t before = static_cast<std::size_t>(cell.level) * discs_;
    for (std::uint32_t k = first_[bucket(cell)]; k != none; k = next_[k])
        if (cell_[k] == cell) found.push_back(static_cast<std::uint32_t>(k - before));
}

/// The discs of a part of a level: those at home, or the guests as well.
void Grid::collect(std::size_t l, bool guests_too, const Part& part, std::vector<std::uint32_t>& found) const {
    const Level& level = levels_[l];
    const bool of_homes = level.homes > 0, of_guests = guests_too && level.guests > 0;
    if (!of_homes && !of_guests) return;
    // To a disc so large, all others are sooner looked at than all cells.
    if (part.cells() > 4.0 * static_cast<double>(discs_) + 16) {
        for (std::uint32_t i = 0; i < discs_; ++i) {
            const Cell& cell = cell_[l * discs_ + i];
            if (cell != nowhere && (cell.of_guests ? of_guests : of_homes)) found.push_back(i);
        }
        return;
    }
    for (std::int64_t y = part.rows.first; y <= part.rows.last; ++y)
        for (std::int64_t x = part.columns.first; x <= part.columns.last; ++x)
            for (const bool guests : {false, true})
                if (guests ? of_guests : of_homes)
                    collect({static_cast<int>(l), guests, wrapped(level, 0, x), wrapped(level, 1, y)}, found);
}

/// The level to look at all discs in: whose cells are not much smaller than what is looked at, or, where the next level
/// is far too coarse, one of which some more cells are.
std::size_t Grid::level_around(Vec2 centre, double radius) const {
    constexpr double far_too_coarse = 16, some_more = 256;
    std::size_t l = 0;
    for (; l + 1 < prepared_ && levels_[l].wide < radius; ++l)
        if (levels_[l + 1].wide > far_too_coarse * radius && part(levels_[l], centre, radius).cells() <= some_more)
            break;
    return l;
}

void Grid::near(Vec2 centre, double radius, std::vector<std::uint32_t>& found) const {
    const std::size_t around = level_around(centre, radius);
    for (std::size_t l = around; l < levels_.size(); ++l)
        collect(l, l == around, part(levels_[l], centre, radius), found);
}

}  // namespace carom
