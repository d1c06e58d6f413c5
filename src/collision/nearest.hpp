#pragma once
// How far apart two convex outlines are, and where they are nearest. All of it is about the cores: the corners without
// their rounding.

#include <algorithm>

#include "collision/convex.hpp"
#include "simd/duo.hpp"

namespace carom {

/// An outline in the world's orientation, seen from the position of the first one's body. It is laid out for loops over
/// lanes, and so that of one with few corners not many lines of memory are in use.
struct alignas(64) Placed {
    static constexpr int some =
        4;  ///< room is for a multiple of it, and behind the last corner the first one follows again

    int count;
    bool one_sided;
    double radius, width;
    Vec2 centre;
    /// x of corners, y of corners, x of normals and y of normals, `room()` of each.
    alignas(64) double numbers[4 * Convex::most_corners];

    Placed() = default;
    Placed(const Convex& outline, const Frame& at, Vec2 offset)
        : count(outline.count),
          one_sided(outline.one_sided),
          radius(outline.radius),
          width(outline.width),
          centre(offset + at.turn(outline.centre)) {
        for (int i = 0; i < count; ++i) put(i, offset + at.turn(outline.corner[i]), at.turn(outline.normal[i]));
        for (int i = count; i % some != 0; ++i) put(i, corner(0), normal(0));
    }
    int room() const { return count <= some ? some : Convex::most_corners; }
    const double* corner_x() const { return numbers; }
    const double* corner_y() const { return numbers + room(); }
    const double* normal_x() const { return numbers + 2 * room(); }
    const double* normal_y() const { return numbers + 3 * room(); }
    Vec2 corner(int i) const { return {corner_x()[i], corner_y()[i]}; }
    Vec2 normal(int i) const { return {normal_x()[i], normal_y()[i]}; }
    int next(int i) const { return i + 1 == count ? 0 : i + 1; }
    int last(int i) const { return i == 0 ? count - 1 : i - 1; }
    /// The same one elsewhere. What separations load by twos is stored so: else they would wait for it.
    Placed moved(Vec2 way) const {
        Placed there;
        there.count = count, there.one_sided = one_sided, there.radius = radius, there.width = width;
        there.centre = way + centre;
        const int rooms = room();
        for (int i = 0; i < rooms; i += 2) {
            store(way.x + load_duo(corner_x() + i), there.numbers + i);
            store(way.y + load_duo(corner_y() + i), there.numbers + rooms + i);
        }
        for (int i = 2 * rooms; i < 4 * rooms; i += 2) store(load_duo(numbers + i), there.numbers + i);
        return there;
    }

  private:
    void put(int i, Vec2 own_corner, Vec2 own_normal) {
        double* const to = numbers + i;
        to[0] = own_corner.x, to[room()] = own_corner.y;
        to[2 * room()] = own_normal.x, to[3 * room()] = own_normal.y;
    }
};
/// Its box, where its body's position is the one that it is seen from.
inline Aabb bounds(const Placed& outline, Vec2 position) {
    struct InTurn {
        const Placed& of;
        Vec2 operator[](int i) const { return of.corner(i); }
    };
    return bounds_of(outline.count, InTurn{outline}, position, outline.radius);
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
