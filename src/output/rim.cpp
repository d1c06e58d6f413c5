#include "output/rim.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/outline.hpp"

namespace carom {
namespace {

/// On a circle as large as a picture a chord is off by a quarter of a pixel.
constexpr int chords = 96;

void add_arc(std::vector<Vec2>& points, Vec2 centre, double radius, double from, double turned) {
    const int n = std::max(1, static_cast<int>(std::ceil(chords * turned / (2 * std::numbers::pi))));
    for (int i = 0; i <= n; ++i) {
        const double angle = from + i * turned / n;
        points.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
}

Rim rim_of(const Outline& outline) {
    const auto& [corners, radius] = outline;
    const std::size_t n = corners.size();
    if (radius == 0) return {corners, n > 2};
    Rim rim{{}, true};
    if (n == 1) add_arc(rim.points, corners[0], radius, 0, 2 * std::numbers::pi);
    for (std::size_t i = 0; i < n && n > 1; ++i) {
        const Vec2 before = corners[i] - corners[(i + n - 1) % n], after = corners[(i + 1) % n] - corners[i];
        const double turned = std::abs(std::atan2(cross(before, after), dot(before, after)));
        add_arc(rim.points, corners[i], radius, std::atan2(-before.x, before.y), turned);
    }
    return rim;
}

Rim rim_of(const Chain& chain) {
    Rim rim{chain.points, false};
    if (chain.closed) rim.points.push_back(chain.points.front());
    return rim;
}

template <class T>
Rim rim_of(const T& shape) {
    return rim_of(outline_of(shape));
}

}  // namespace

Rim rim_of(const Geometry& geometry) {
    return std::visit([](const auto& shape) { return rim_of(shape); }, geometry);
}

Rim rim_of(const Stadium& walls) {
    const auto& [a, b, radius, side] = walls;
    return a == b ? rim_of(Outline{{a}, radius}) : rim_of(Outline{{a, b}, radius});
}

std::vector<Vec2> placed(std::vector<Vec2> points, Vec2 position, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (Vec2& point : points) point = position + Vec2{c * point.x - s * point.y, s * point.x + c * point.y};
    return points;
}

}  // namespace carom
