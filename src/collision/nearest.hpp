#pragma once
// How far apart two convex outlines are, and where they are nearest. All of it is about the cores: the corners without
// their rounding.

#include <algorithm>

#include "collision/convex.hpp"
#include "simd/duo.hpp"

namespace carom {

/// Up to eight points or directions, x and y by themselves: loops over some of them are loops over lanes.
struct PlacedPoints {
    double x[Convex::most_corners], y[Convex::most_corners];

    Vec2 operator[](int i) const { return {x[i], y[i]}; }
    void put(int i, Vec2 a) { x[i] = a.x, y[i] = a.y; }
};

/// An outline in the world's orientation, seen from the position of the first one's body.
struct Placed {
    static constexpr int some = 4;  ///< normals are gone through by so many, and behind the last ones the first one follows once more

    int count;
    bool one_sided;
    double radius, width;
    Vec2 centre;
    PlacedPoints corner, normal;

    Placed() = default;
    Placed(const Convex& outline, const Frame& at, Vec2 offset)
        : count(outline.count),
          one_sided(outline.one_sided),
          radius(outline.radius),
          width(outline.width),
          centre(offset + at.turn(outline.centre)) {
        for (int i = 0; i < count; ++i) {
            corner.put(i, offset + at.turn(outline.corner[i]));
            normal.put(i, at.turn(outline.normal[i]));
        }
        for (int i = count; i % some != 0; ++i) corner.put(i, corner[0]), normal.put(i, normal[0]);
    }
    int next(int i) const { return i + 1 == count ? 0 : i + 1; }
    int last(int i) const { return i == 0 ? count - 1 : i - 1; }
    /// The same one elsewhere. What separations load by twos is stored so: else they would wait for it.
    Placed moved(Vec2 way) const {
        Placed there;
        there.count = count, there.one_sided = one_sided, there.radius = radius, there.width = width;
        there.centre = way + centre;
        for (int i = 0; i < count; i += 2) {
            store(way.x + load_duo(corner.x + i), there.corner.x + i);
            store(way.y + load_duo(corner.y + i), there.corner.y + i);
        }
        for (int i = 0; i < count; i += some)
            for (int k = i; k < i + some; k += 2) {
                store(load_duo(normal.x + k), there.normal.x + k);
                store(load_duo(normal.y + k), there.normal.y + k);
            }
        return there;
    }
};
/// As kernels see it.
inline const double* numbers_of(const Placed& outline) { return &outline.radius; }
/// Its box, where its body's position is the one that it is seen from.
inline Aabb bounds(const Placed& outline, Vec2 position) {
    return bounds_of(outline.count, outline.corner, position, outline.radius);
}

/// A corner has its number, an edge 8 more.
constexpr std::uint32_t edge_feature(int i) { return static_cast<std::uint32_t>(Convex::most_corners + i); }
constexpr std::uint32_t corner_feature(int i) { return static_cast<std::uint32_t>(i); }

/// A point on each.
struct TouchPoint {
    Vec2 on_p, on_q;
    std::uint32_t feature_p, feature_q;
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
