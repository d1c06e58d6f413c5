#pragma once
// Which pieces are met by a ray, a point, a box, an outline: of a list of pieces, looked at one by one.

#include <carom/query.hpp>
#include <optional>
#include <span>
#include <vector>

#include "collision/convex.hpp"

namespace carom {

/// A piece where its body is.
struct PlacedPiece {
    const Piece* piece;
    Frame frame;
};
using PlacedPieces = std::span<const PlacedPiece>;

struct PieceHit {
    std::size_t index = 0;  ///< in the list
    Vec2 point{}, normal{};
    double fraction = 0;
};

/// Where a ray from an origin along a way enters an outline: point, normal and fraction of the way, at most 1. A ray
/// that begins inside does not see the outline; it passes a piece of a chain from behind.
std::optional<PieceHit> ray_hit(const Convex& outline, const Frame& at, Vec2 origin, Vec2 way);

/// The first piece that a ray meets; of several at once the first in the list.
std::optional<PieceHit> first_hit(PlacedPieces pieces, Vec2 origin, Vec2 way, const Sought& sought = {});
/// All pieces that a ray meets, in the order in which it meets them.
std::vector<PieceHit> all_hits(PlacedPieces pieces, Vec2 origin, Vec2 way, const Sought& sought = {});
/// The first piece that an outline meets when it is moved along a way without turning; at 0 if it overlaps one already.
std::optional<PieceHit> first_hit(PlacedPieces pieces, const Convex& outline, const Frame& from, Vec2 way,
                                  const Sought& sought = {});

/// The pieces, by their places in the list, that overlap or touch an outline, a box, or a point.
std::vector<std::size_t> overlapping(PlacedPieces pieces, const Convex& outline, const Frame& at,
                                     const Sought& sought = {});
std::vector<std::size_t> overlapping(PlacedPieces pieces, const Aabb& box, const Sought& sought = {});
std::vector<std::size_t> overlapping(PlacedPieces pieces, Vec2 point, const Sought& sought = {});

/// Where two outlines are nearest.
ClosestPoints closest_points(const Convex& a, const Frame& at_a, const Convex& b, const Frame& at_b);

}  // namespace carom
