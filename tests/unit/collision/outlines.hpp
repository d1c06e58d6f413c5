#pragma once
// Outlines at random, and what their distance is by brute force.

#include <algorithm>
#include <carom/random.hpp>
#include <limits>
#include <vector>

#include "collision/convex.hpp"
#include "collision/manifold.hpp"

namespace carom::test {

/// A disc, a capsule, or the hull of 3 to 8 points; rounded or not.
inline Convex random_outline(Random& random, double size) {
    const auto point = [&] {
        const double x = random.uniform(-size, size);
        return Vec2{x, random.uniform(-size, size)};
    };
    const double rounding = random.uniform() < 0.5 ? 0 : random.uniform(0, size / 2);
    const double kind = random.uniform();
    if (kind < 0.1) return pieces_of(Disc{point(), size / 2})[0];
    if (kind < 0.2) return pieces_of(Capsule{point(), point(), rounding})[0];
    Hull hull{{}, rounding};
    const auto corners = static_cast<int>(random.uniform(3, 9));
    for (int i = 0; i < corners; ++i) hull.points.push_back(point());
    return pieces_of(hull)[0];
}

inline Frame random_frame(Random& random) { return frame_at({}, random.uniform(-4, 4)); }

/// The corners relative to the first body's position.
inline std::vector<Vec2> corners_at(const Convex& outline, const Frame& frame, Vec2 offset) {
    std::vector<Vec2> corners;
    for (int i = 0; i < outline.count; ++i) corners.push_back(offset + frame.turn(outline.corner[i]));
    return corners;
}

inline double distance_to_line(Vec2 c, Vec2 a, Vec2 b) {
    const Vec2 along = b - a;
    const double squared = squared_length(along);
    const double place = squared > 0 ? std::clamp(dot(c - a, along) / squared, 0., 1.) : 0;
    return length(c - (a + place * along));
}

/// Between the rims of two sets of corners that do not overlap: every corner against every edge.
inline double brute_distance(const std::vector<Vec2>& p, const std::vector<Vec2>& q) {
    double least = std::numeric_limits<double>::infinity();
    const auto corners_of = [&](const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
        for (const Vec2 c : from)
            for (std::size_t i = 0; i < to.size(); ++i)
                least = std::min(least, distance_to_line(c, to[i], to[(i + 1) % to.size()]));
    };
    corners_of(p, q), corners_of(q, p);
    return least;
}

/// The largest distance between two parallels that keep the outlines apart, negative if none does: of all directions.
inline double brute_separation(const std::vector<Vec2>& p, const std::vector<Vec2>& q, int directions = 20000) {
    double best = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < directions; ++k) {
        const Vec2 n = frame_at({}, 2 * 3.14159265358979 * k / directions).turn({1, 0});
        double far_p = -1e300, near_q = 1e300;
        for (const Vec2 c : p) far_p = std::max(far_p, dot(c, n));
        for (const Vec2 c : q) near_q = std::min(near_q, dot(c, n));
        best = std::max(best, near_q - far_p);
    }
    return best;
}

}  // namespace carom::test
