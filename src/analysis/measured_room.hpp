#pragma once
#include <algorithm>
#include <carom/world.hpp>
#include <optional>

#include "collision/walls.hpp"

namespace carom {

/// Where a gas is: a periodic box, between walls, or as far as its discs reach at the start.
struct MeasuredRoom {
    Vec2 low{}, high{1, 1};
    bool periodic = false, walls = false;
    std::optional<Stadium> round{};

    double area() const { return round ? area_of(*round) : (high.x - low.x) * (high.y - low.y); }
    /// Of the walls.
    double perimeter() const { return round ? perimeter_of(*round) : 2 * (high.x - low.x + high.y - low.y); }
    /// What is farther from the walls than this.
    MeasuredRoom within(double margin) const {
        MeasuredRoom inner = *this;
        inner.low += Vec2{margin, margin}, inner.high -= Vec2{margin, margin};
        if (inner.round) inner.round->radius -= margin;
        return inner;
    }
};

inline MeasuredRoom measured_room(const World& world) {
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

}  // namespace carom
