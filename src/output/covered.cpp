#include "output/covered.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Row by row, so that none is missed and each is set once: what is covered, and places that it touches.
void Covered::mark(Vec2 a, Vec2 b) {
    constexpr double touched = 0.35;  // places that a line may enter beside their middle
    const double reach = fine * length(b - a), half = half_ + touched;
    const Vec2 along = reach > 0 ? fine / reach * (b - a) : Vec2{1, 0}, aside{-along.y, along.x};
    // A little beyond the ends, which are round.
    const double more = std::min(half_, 1.0) + touched;
    const Vec2 from = fine * a - more * along, to = fine * b + more * along;
    const double low = std::max(0.0, std::floor(std::min(from.y, to.y) - half));
    const double high = std::min(static_cast<double>(rows_ - 1), std::ceil(std::max(from.y, to.y) + half));
    for (double row = low; row <= high; ++row) {
        const Vec2 edge = Vec2{0.5, row + 0.5} - from;  // the middle of its first place
        double first = 0, last = static_cast<double>(columns_ - 1);
        clip(dot(edge, along), along.x, reach + 2 * more, first, last);
        clip(dot(edge, aside) + half, aside.x, 2 * half, first, last);
        if (!(first <= last)) continue;
        const auto row_of = seen_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * columns_);
        const auto begin = static_cast<std::ptrdiff_t>(std::ceil(first));
        const auto end = static_cast<std::ptrdiff_t>(last) + 1;
        if (begin < end) std::fill(row_of + begin, row_of + end, static_cast<unsigned char>(1));
    }
}

bool Covered::adds(Vec2 a, Vec2 b) {
    constexpr double endless = 1e6;  // pixels: beyond, it is not known well enough where it enters
    if (!(length(b - a) < endless)) return true;
    if (half_ == 0) return over(a, b, 0, 1, [&](std::size_t place) { return std::exchange(seen_[place], 1) == 0; });
    constexpr double apart = 2;  // places, half a pixel: what lies between has been drawn with them
    if (!over(a, b, std::max(half_ - fine * rim, 0.0), apart, [&](std::size_t place) { return seen_[place] == 0; }))
        return false;
    mark(a, b);
    return true;
}

}  // namespace carom
