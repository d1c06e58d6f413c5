#include "analysis/measured_room.hpp"

#include "collision/grid.hpp"

namespace carom {

namespace {

MeasuredRoom bounds_of_gas(const World& world) {
    if (world.periodic()) return {world.periodic()->low, world.periodic()->high, true, false};
    if (!world.rectangles().empty()) return {world.rectangles()[0].low, world.rectangles()[0].high, false, true};
    if (!world.stadiums().empty()) {
        const Rectangle box = bounds_of(world.stadiums()[0]);
        return {box.low, box.high, false, true, world.stadiums()[0]};
    }
    MeasuredRoom room;
    for (std::size_t i = 0; i < world.size(); ++i) {
        const Vec2 x = world.positions()[i];
        room.low = i == 0 ? x : Vec2{std::min(room.low.x, x.x), std::min(room.low.y, x.y)};
        room.high = i == 0 ? x : Vec2{std::max(room.high.x, x.x), std::max(room.high.y, x.y)};
    }
    return room;
}

/// Whether discs up to so wide pass between each of these rows and the walls, each other, and their images.
bool pass_between(const World& world, const std::vector<std::size_t>& rows, const MeasuredRoom& room, double widest) {
    std::vector<Vec2> centre;
    std::vector<double> reach;  // half of a passage farther
    for (const std::size_t row : rows) {
        centre.push_back(world.positions()[row]);
        reach.push_back(world.radii()[row] + 0.5 * widest);
    }
    Grid grid;
    grid.build(centre, reach, world.periodic());
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        const double radius = world.radii()[rows[i]];
        if ((room.periodic ? room.narrower_side() - radius : room.distance(centre[i])) <= radius + widest) return false;
        near.clear();
        grid.near(centre[i], reach[i], near);
        for (const std::uint32_t j : near) {
            const double apart = length(nearest_image(world.periodic(), centre[j] - centre[i]));
            if (j != i && apart <= radius + world.radii()[rows[j]] + widest) return false;
        }
    }
    return true;
}

bool is_open(const World& world, std::size_t discs, const MeasuredRoom& room, double widest) {
    std::vector<std::size_t> posts;
    for (std::size_t row = 0; row < world.size(); ++row)
        if (world.kinds()[row] == Kind::fixed && world.shapes()[row].empty()) posts.push_back(row);
    if (posts.size() + discs < world.size()) return false;
    return posts.empty() || pass_between(world, posts, room, widest);
}

}  // namespace

double MeasuredRoom::distance(Vec2 x) const {
    if (!round) return std::min({x.x - low.x, high.x - x.x, x.y - low.y, high.y - x.y});
    const Vec2 way = round->b - round->a, from = x - round->a;
    const double squared = dot(way, way), along = squared > 0 ? std::clamp(dot(from, way) / squared, 0.0, 1.0) : 0;
    return round->radius - length(from - along * way);
}

MeasuredRoom measured_room(const World& world, std::size_t discs, double widest) {
    MeasuredRoom room = bounds_of_gas(world);
    const std::size_t walls = world.rectangles().size() + world.stadiums().size();
    if (!world.half_planes().empty() || (!room.periodic && walls != 1)) return room;
    room.empty = discs == world.size();
    room.open = is_open(world, discs, room, widest);
    return room;
}

}  // namespace carom
