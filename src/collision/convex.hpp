#pragma once
// Convex outlines, the one form in which shapes collide: 1 to 8 corners, rounded by a radius.

#include <algorithm>
#include <carom/body.hpp>
#include <carom/shape.hpp>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "math/elementary.hpp"
#include "state/bodies.hpp"

namespace carom {

/// A disc is one corner and a radius, a capsule or a segment are two, boxes and polygons three to eight,
/// counterclockwise.
struct Convex {
    static constexpr int most_corners = 8;
    int count = 1;
    double radius = 0;
    Vec2 corner[most_corners];
    Vec2 normal[most_corners];  ///< out of the edge from corner i to the next; of two corners there are two edges
    Vec2 centre{};              ///< somewhere in the middle of the corners
    double width = 0;  ///< least distance between two parallels around the corners; of two corners their distance

    /// A piece of a chain: solid from the side of normal[0] alone, and its neighbours say which normals a contact may
    /// have, so that nothing bumps where pieces meet. The chain walks from corner 1 to corner 0, so that the room on
    /// its left is outside the edge from 0 to 1.
    bool one_sided = false;
    bool has_previous = false, has_next = false;
    Vec2 previous_normal{}, next_normal{};
    double previous_length = 0, next_length = 0;
    /// How far beyond either end a line bounds the room over the chain, as that bends towards the room from there on.
    double previous_reach = 0, next_reach = 0;
};

/// How thick an outline is where it is thinnest [m]; infinite of points and segments, which have no inside.
inline double thickness(const Convex& outline) {
    const double thick = (outline.count > 2 ? outline.width : 0) + 2 * outline.radius;
    return thick > 0 ? thick : HUGE_VAL;
}

/// An outline by its corners, counterclockwise: 1, 2 or a convex polygon of at most 8.
Convex convex(std::span<const Vec2> corners, double radius);

/// Where a body's frame is. The cosine and sine are those of its angle.
struct Frame {
    Vec2 position{};
    double cosine = 1, sine = 0;

    Vec2 turn(Vec2 a) const { return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y}; }
    Vec2 turn_back(Vec2 a) const { return {cosine * a.x + sine * a.y, cosine * a.y - sine * a.x}; }
};
/// The frame of a body at a position and an angle [rad], with the library's own cosine and sine.
inline Frame frame_at(Vec2 position, double angle) {
    const portable::SinCos turned = portable::sincos(angle);
    return {position, turned.cos, turned.sin};
}

struct Aabb {
    Vec2 low{}, high{};
};
inline bool overlap(const Aabb& a, const Aabb& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}
inline bool is_within(const Aabb& box, const Aabb& room) {
    return box.low.x >= room.low.x && box.low.y >= room.low.y && box.high.x <= room.high.x && box.high.y <= room.high.y;
}
/// The smallest box around two.
inline Aabb hull(const Aabb& a, const Aabb& b) {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}
/// The smallest upright box around an outline.
Aabb bounds(const Convex& outline, const Frame& at);
/// That of corners seen from a position, with their rounding.
template <class Corners>
Aabb bounds_of(int count, const Corners& corner, Vec2 position, double radius) {
    Aabb box{corner[0], corner[0]};
    for (int i = 1; i < count; ++i) {
        const Vec2 c = corner[i];
        box.low = {std::min(box.low.x, c.x), std::min(box.low.y, c.y)};
        box.high = {std::max(box.high.x, c.x), std::max(box.high.y, c.y)};
    }
    const Vec2 rim{radius, radius};
    return {position + box.low - rim, position + box.high + rim};
}

/// A part of a body that collides as a whole.
struct Piece {
    Convex outline;
    std::uint32_t row = 0;     ///< of its body
    std::uint32_t number = 0;  ///< among its body's pieces
    std::uint32_t shape = 0;   ///< among its body's shapes
    double restitution = 1, friction = 0, rolling_resistance = 0, surface_speed = 0;
    bool sensor = false;
    Filter filter{};
};

/// Whether shapes of these filters collide.
bool may_meet(const Filter& a, const Filter& b);
/// Whether pieces do: of two bodies, no sensors, one of them with a thickness, and by their filters.
inline bool may_meet(const Piece& a, const Piece& b) {
    const bool is_thick = std::min(thickness(a.outline), thickness(b.outline)) < HUGE_VAL;
    return a.row != b.row && !a.sensor && !b.sensor && is_thick && may_meet(a.filter, b.filter);
}

/// Makes those of the pieces of all bodies that are of rows from this one on, in the order of rows; before them are
/// those of the others.
void renew_pieces(const Bodies& bodies, std::size_t first, std::vector<Piece>& all);
/// Calls act(k) for those of the body in a row.
template <class Act>
void each_piece_of(std::span<const Piece> pieces, std::uint32_t row, const Act& act) {
    const auto first =
        std::partition_point(pieces.begin(), pieces.end(), [row](const Piece& p) { return p.row < row; });
    for (auto k = static_cast<std::size_t>(first - pieces.begin()); k < pieces.size() && pieces[k].row == row; ++k)
        act(k);
}

/// The convex pieces of a shape, in the frame of its body; an Error that says what is wrong with it.
std::vector<Convex> pieces_of(const Geometry& geometry);

struct MassProperties {
    double mass = 0;
    Vec2 centre{};
    double moment = 0;  ///< about the centre [kg m²]
};
/// Of a body with these shapes. Those of an area of 0 have no mass.
MassProperties mass_properties(const std::vector<Shape>& shapes, double mass_without_density);

/// The centre of mass of a body's shapes in the frame in which they are given, where that is not the frame's origin and
/// the body is one that moves about it; else the origin.
Vec2 centre_of_shapes(const Body& body);
/// A body whose shapes' centre of mass is its position, with their mass and moment of inertia if they have an area.
Body with_mass_of_shapes(const Body& body);

}  // namespace carom
