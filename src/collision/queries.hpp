#pragma once
// Which shapes are met by a ray, a point, a box, an outline: their pieces looked at one by one, by their bounds first.

#include <carom/query.hpp>
#include <optional>
#include <span>
#include <vector>

#include "collision/convex.hpp"
#include "collision/places.hpp"
#include "collision/walls.hpp"

namespace carom {

/// The pieces of bodies where these are.
struct PlacedPieces {
    std::span<const Piece> pieces;  ///< in the order of the rows
    std::span<const BodyId> ids;    ///< by row
    const Places& places;

    const Piece& operator[](std::size_t k) const { return pieces[k]; }
    const Frame& frame(std::size_t k) const { return places.frame(pieces[k].row); }
    const Aabb& bounds(std::size_t k) const { return places.bounds()[k]; }
    ShapeId shape(std::size_t k) const { return {ids[pieces[k].row], pieces[k].shape}; }
};

/// Where something that moves along a way meets an outline.
struct Meeting {
    Vec2 point{}, normal{};
    double fraction = 0;  ///< of the way
};

/// Where a ray from an origin along a way enters an outline: point, normal and fraction of the way, at most 1. A ray
/// that begins inside does not see the outline; it passes a piece of a chain from behind.
std::optional<Meeting> ray_meets(const Convex& outline, const Frame& at, Vec2 origin, Vec2 way);

/// The first shape that a ray meets; of several at once the first in the list.
std::optional<Hit> first_hit(const PlacedPieces&, Vec2 origin, Vec2 way, const Sought& sought = {});
/// All shapes that a ray meets, in the order in which it meets them, each once.
std::vector<Hit> all_hits(const PlacedPieces&, Vec2 origin, Vec2 way, const Sought& sought = {});
/// The first shape that outlines meet when they are moved along a way without turning; at 0 if they overlap one
/// already, or touch it and move into it. What they touch or graze without getting into it they do not meet.
std::optional<Hit> first_hit(const PlacedPieces&, std::span<const Convex> outlines, const Frame& from, Vec2 way,
                             const Sought& sought = {});

/// The shapes that overlap or touch outlines, a box, or a point, in the order of the list.
std::vector<ShapeId> overlapping(const PlacedPieces&, std::span<const Convex> outlines, const Frame& at,
                                 const Sought& sought = {});
std::vector<ShapeId> overlapping(const PlacedPieces&, const Aabb& box, const Sought& sought = {});
std::vector<ShapeId> overlapping(const PlacedPieces&, Vec2 point, const Sought& sought = {});

/// Where two outlines are nearest.
ClosestPoints closest_points(const Convex& a, const Frame& at_a, const Convex& b, const Frame& at_b);
/// Where the bodies of two rows are nearest; nothing if one of them has no shape that is sought.
std::optional<ClosestPoints> closest_points(const PlacedPieces&, std::uint32_t row_a, std::uint32_t row_b,
                                            const Sought& sought = {});

/// Those who are no deeper in one another than this part of the smaller one's size, touch.
inline constexpr double touch_hair = 1e-9;
/// The diagonal of an outline's box [m].
double size_of(const Convex& outline);

/// How deep an outline is in a straight wall; less than 0 if it is in front of it.
double depth_in(const Wall& wall, const Convex& outline, const Frame& at);

}  // namespace carom
