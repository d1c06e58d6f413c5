#pragma once
// How far apart two convex outlines are, and where they are nearest. All of it is about the cores: the corners without
// their rounding.

#include <algorithm>

#include "collision/convex.hpp"

namespace carom {

/// A Vec2 that has no value by default: of eight corners most are not there.
struct Place {
    double x, y;

    Place() = default;
    Place(Vec2 a) : x(a.x), y(a.y) {}
    operator Vec2() const { return {x, y}; }
};

/// An outline in the world's orientation, seen from the position of the first one's body.
struct Placed {
    int count;
    double radius, width;
    Vec2 centre;
    Place corner[Convex::most_corners], normal[Convex::most_corners];

    Placed(const Convex& outline, const Frame& at, Vec2 offset)
        : count(outline.count), radius(outline.radius), width(outline.width), centre(offset + at.turn(outline.centre)) {
        for (int i = 0; i < count; ++i) {
            corner[i] = offset + at.turn(outline.corner[i]);
            normal[i] = at.turn(outline.normal[i]);
        }
    }
    int next(int i) const { return i + 1 == count ? 0 : i + 1; }
    int last(int i) const { return i == 0 ? count - 1 : i - 1; }
};

/// A corner has its number, an edge 8 more.
constexpr std::uint32_t edge_feature(int i) { return static_cast<std::uint32_t>(Convex::most_corners + i); }
constexpr std::uint32_t corner_feature(int i) { return static_cast<std::uint32_t>(i); }

/// A point on each.
struct TouchPoint {
    Vec2 on_p, on_q;
    std::uint32_t feature_p, feature_q;
};

/// How far q lies outside each edge of p.
struct Separations {
    double of[Convex::most_corners];
    int best = 0;

    Separations(const Placed& p, const Placed& q) {
        for (int i = 0; i < p.count; ++i) {
            const Vec2 n = p.normal[i];
            double lowest = dot(q.corner[0], n);
            for (int j = 1; j < q.count; ++j) lowest = std::min(lowest, dot(q.corner[j], n));
            of[i] = lowest - dot(p.corner[i], n);
            if (of[i] > of[best]) best = i;
        }
    }
};

/// The nearest points of edge i of p and edge j of q if they do not cross, and whether both are corners.
struct Nearest {
    TouchPoint point;
    double squared = 0;
    bool corners = false;
};

/// The nearest points of two cores that are apart, found by walking from a pair of edges, one of each.
Nearest nearest_points(const Placed& p, int i, const Placed& q, int j);

/// The edge of q that faces a direction most.
int edge_facing(const Placed& q, Vec2 direction);

/// The direction from p to q along which the cores are farthest apart, and how far: their distance, or if they overlap
/// less than zero: the shortest way out. Nothing that moves in another direction takes that distance away.
struct CoreDistance {
    enum class Edge { none, of_p, of_q };
    double distance;
    Vec2 normal, on_p, on_q;
    Edge edge;  ///< to which the normal belongs
};
CoreDistance core_distance(const Placed& p, const Placed& q);

}  // namespace carom
