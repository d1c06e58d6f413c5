#include "solvers/events/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

/// The column of a place along one axis, the way from its middle, and the turns.
struct Along {
    std::int64_t cell;
    double from_middle;
};
Along along(double place, double low, double side) {
    const double column = std::floor((place - low) / side);
    return {static_cast<std::int64_t>(column), place - (low + (column + 0.5) * side)};
}
std::int64_t turns_of(std::int64_t cell, std::int32_t n) { return cell >= 0 ? cell / n : -((-cell - 1) / n) - 1; }

/// The shortest way from one column to another in a ring of n.
double ring(std::int32_t from, std::int32_t to, std::int32_t n, double side) {
    std::int32_t d = to - from;
    if (2 * d > n) d -= n;
    if (2 * d < -n) d += n;
    return d * side;
}

}  // namespace

void GasGrid::put(GasDisc& d, Vec2 place) const {
    const Along x = along(place.x, low.x, side.x), y = along(place.y, low.y, side.y);
    const std::int64_t tx = turns_of(x.cell, nx), ty = turns_of(y.cell, ny);
    d.turns_x = static_cast<std::int32_t>(tx), d.turns_y = static_cast<std::int32_t>(ty);
    d.cell = {static_cast<std::uint16_t>(x.cell - tx * nx), static_cast<std::uint16_t>(y.cell - ty * ny)};
    d.x = {x.from_middle, y.from_middle};
}

Vec2 GasGrid::between(const GasDisc& a, const GasDisc& b) const {
    if (rim != Rim::periodic) return unrolled(a, b);
    return {ring(a.cell.x, b.cell.x, nx, side.x), ring(a.cell.y, b.cell.y, ny, side.y)};
}

GasRoom room_of(const Walls& walls, const std::vector<Vec2>& places) {
    const auto area = [](Vec2 size) { return size.x * size.y; };
    if (const auto& box = walls.periodic)
        return {GasGrid::Rim::periodic, box->low, box->high, area(box->high - box->low)};
    constexpr double none = std::numeric_limits<double>::infinity();
    Vec2 low{-none, -none}, high{none, none};
    for (const Wall& wall : walls.all) {
        if (wall.normal == Vec2{1, 0}) low.x = std::max(low.x, wall.offset);
        if (wall.normal == Vec2{-1, 0}) high.x = std::min(high.x, -wall.offset);
        if (wall.normal == Vec2{0, 1}) low.y = std::max(low.y, wall.offset);
        if (wall.normal == Vec2{0, -1}) high.y = std::min(high.y, -wall.offset);
    }
    for (const Stadium& wall : walls.round) {
        const Rectangle box = bounds_of(wall);
        low = {std::max(low.x, box.low.x), std::max(low.y, box.low.y)};
        high = {std::min(high.x, box.high.x), std::min(high.y, box.high.y)};
    }
    const Vec2 size = high - low;
    if (size.x > 0 && size.y > 0 && size.x < none && size.y < none)
        return {GasGrid::Rim::closed, low, high,
                walls.all.empty() && walls.round.size() == 1 ? area_of(walls.round[0]) : area(size)};
    GasRoom room{GasGrid::Rim::open, {}, {}};
    if (!places.empty()) room.low = room.high = places[0];
    for (const Vec2 x : places) {
        room.low = {std::min(room.low.x, x.x), std::min(room.low.y, x.y)};
        room.high = {std::max(room.high.x, x.x), std::max(room.high.y, x.y)};
    }
    return room;
}

GasGrid choose_grid(const GasRoom& room, std::size_t discs, double widest) {
    constexpr double most = 60000;  // a side, for 16 bits
    const Vec2 size = room.high - room.low;
    const double longer = std::max(size.x, size.y), count = static_cast<double>(std::max<std::size_t>(discs, 1));
    // Four cells for three discs where the gas is thin, which costs least; along a line if it is one.
    double wanted = size.x > 0 && size.y > 0 ? std::sqrt(0.75 * size.x * size.y / count) : longer / count;
    wanted = std::max({wanted, widest * (1 + 1e-9), longer / most});
    if (!(wanted > 0)) wanted = 1;
    GasGrid grid{room.rim, room.low, {wanted, wanted}};
    const auto fit = [wanted](double length) { return static_cast<std::int32_t>(length / wanted); };
    if (room.rim == GasGrid::Rim::periodic) {
        grid.nx = std::max(1, fit(size.x)), grid.ny = std::max(1, fit(size.y));
        grid.side = {size.x / grid.nx, size.y / grid.ny};
    } else {
        grid.nx = 3 + fit(size.x), grid.ny = 3 + fit(size.y);
        grid.low = room.low - Vec2{wanted, wanted};
    }
    return grid;
}

}  // namespace carom
