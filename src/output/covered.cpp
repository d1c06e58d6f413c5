#include "output/covered.hpp"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr double fine = 4;    // places in a pixel, along each side
constexpr double rim = 0.35;  // pixels that a line may add along its sides before it is drawn: each that is drawn makes
                              // the grey of the rim darker, and a hundred that differ by nothing make a bold one

/// The part of the way from a to b that lies within a box from the origin; nothing if first > last.
void clip(double from, double way, double size, double& first, double& last) {
    if (way == 0) {
        if (from < 0 || from > size) first = 1, last = 0;
        return;
    }
    const double s = -from / way, t = (size - from) / way;
    first = std::max(first, std::min(s, t)), last = std::min(last, std::max(s, t));
}

}  // namespace

Covered::Covered(double width, double height, double line)
    : columns_(static_cast<std::size_t>(std::ceil(fine * width)) + 1),
      rows_(static_cast<std::size_t>(std::ceil(fine * height)) + 1),
      half_(fine * line / 2),
      seen_(columns_ * rows_) {}

/// Calls f with places of the panel that are no farther than half from a line, `apart` from one another, until f says
/// true; whether it did.
template <class F>
bool Covered::over(Vec2 a, Vec2 b, double half, double apart, F f) const {
    const Vec2 from = fine * a, way = fine * (b - a);
    const double width = static_cast<double>(columns_ - 1), height = static_cast<double>(rows_ - 1);
    double first = 0, last = 1;
    clip(from.x + half, way.x, width + 2 * half, first, last);
    clip(from.y + half, way.y, height + 2 * half, first, last);
    if (!(first <= last)) return false;
    const double reach = length(way);
    const Vec2 aside = reach > 0 ? Vec2{-way.y / reach, way.x / reach} : Vec2{0, 1};
    const double along = std::ceil((last - first) * reach / apart), across = std::ceil(2 * half / apart);
    for (double k = 0; k <= along; ++k) {
        const Vec2 middle = from + (first + (along > 0 ? k / along : 0) * (last - first)) * way;
        for (double n = 0; n <= across; ++n) {
            const Vec2 at = middle + (across > 0 ? half * (2 * n / across - 1) : 0) * aside;
            if (!(at.x >= 0 && at.x <= width && at.y >= 0 && at.y <= height)) continue;
            if (f(static_cast<std::size_t>(at.y) * columns_ + static_cast<std::size_t>(at.x))) return true;
        }
    }
    return false;
}

bool Covered::adds(Vec2 a, Vec2 b) {
    constexpr double endless = 1e6;  // pixels: beyond, it is not known well enough where it enters
    if (!(length(b - a) < endless)) return true;
    const auto is_free = [&](std::size_t place) { return !seen_[place]; };
    if (!over(a, b, std::max(half_ - fine * rim, 0.0), 1, is_free)) return false;
    // So near to one another that none between is missed; and a little beyond the ends, which are round.
    constexpr double dense = 0.7;
    const double reach = length(b - a), more = std::min(half_, 1.0) / fine;
    const Vec2 beyond = reach > 0 ? more / reach * (b - a) : Vec2{};
    over(a - beyond, b + beyond, half_, dense, [&](std::size_t place) {
        seen_[place] = true;
        return false;
    });
    return true;
}

}  // namespace carom
