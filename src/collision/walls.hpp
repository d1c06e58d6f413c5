#pragma once
// Rectangles and half-planes as one list of straight walls, and the round ones.

#include <algorithm>
#include <carom/wall.hpp>
#include <optional>
#include <span>
#include <vector>

namespace carom {

/// Bodies stay where n·x ≥ offset + radius.
struct Wall {
    Vec2 normal;
    double offset;
    double restitution, friction;
    std::optional<double> temperature{};  ///< k T of a thermal wall [J]
};

struct Walls {
    std::vector<Wall> all;  ///< the straight ones
    std::vector<Stadium> round;
    std::optional<Periodic> periodic;

    Walls() = default;
    Walls(std::span<const Rectangle> rectangles, std::span<const HalfPlane> half_planes,
          std::span<const Stadium> stadiums, std::optional<Periodic> box)
        : round(stadiums.begin(), stadiums.end()), periodic(box) {
        for (const Rectangle& r : rectangles) {
            const auto add = [&](Vec2 n, double offset, Side s) {
                all.push_back({n, offset, s.restitution, s.friction, s.temperature});
            };
            add({1, 0}, r.low.x, r.left);
            add({-1, 0}, -r.high.x, r.right);
            add({0, 1}, r.low.y, r.bottom);
            add({0, -1}, -r.high.y, r.top);
        }
        for (const HalfPlane& p : half_planes) {
            const Vec2 n = p.normal / length(p.normal);
            all.push_back({n, dot(n, p.point), p.side.restitution, p.side.friction, p.side.temperature});
        }
    }
};

/// The upright box around it.
inline Rectangle bounds_of(const Stadium& s) {
    const Vec2 room{s.radius, s.radius};
    return {.low = Vec2{std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)} - room,
            .high = Vec2{std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)} + room};
}
/// Of the room inside [m²], and the length of its wall [m].
inline double area_of(const Stadium& s) {
    constexpr double pi = 0x1.921fb54442d18p1;
    return s.radius * (pi * s.radius + 2 * length(s.b - s.a));
}
inline double perimeter_of(const Stadium& s) {
    constexpr double pi = 0x1.921fb54442d18p1;
    return 2 * (pi * s.radius + length(s.b - s.a));
}

/// The shortest of the ways from a to b that a periodic box offers.
inline Vec2 nearest_image(const std::optional<Periodic>& box, Vec2 d) {
    if (!box) return d;
    const double w = box->high.x - box->low.x, h = box->high.y - box->low.y;
    return {d.x - w * std::floor(d.x / w + 0.5), d.y - h * std::floor(d.y / h + 0.5)};
}

}  // namespace carom
