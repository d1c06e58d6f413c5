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
    bool empty = false;  ///< nothing is in it but the gas, and no wall cuts it
    bool open = false;   ///< all of it can be reached: in it are fixed discs at most, and others pass on all sides

    double area() const { return round ? area_of(*round) : (high.x - low.x) * (high.y - low.y); }
    /// Of the walls.
    double perimeter() const { return round ? perimeter_of(*round) : 2 * (high.x - low.x + high.y - low.y); }
    double narrower_side() const { return std::min(high.x - low.x, high.y - low.y); }
    /// Of a point, from the walls.
    double distance(Vec2 x) const;
    /// What is farther from the walls than this.
    MeasuredRoom within(double margin) const {
        MeasuredRoom inner = *this;
        inner.low += Vec2{margin, margin}, inner.high -= Vec2{margin, margin};
        if (inner.round) inner.round->radius -= margin;
        return inner;
    }
};

/// That of so many discs, up to so wide [m].
MeasuredRoom measured_room(const World& world, std::size_t discs, double widest);

}  // namespace carom
