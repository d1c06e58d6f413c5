#pragma once
// What a ray or a moving outline meets where it leaves the room that walls leave open. Walls have their numbers as in
// events: the straight ones in order, then the round ones.

#include <carom/query.hpp>
#include <optional>
#include <span>

#include "collision/convex.hpp"
#include "collision/walls.hpp"

namespace carom {

/// The wall through which a ray leaves the room, which is convex; nothing if it ends in it or never is in it.
std::optional<Hit> wall_hit(const Walls&, Vec2 origin, Vec2 way);
/// The first wall that outlines meet when they are moved along a way without turning, of several at once the one with
/// the lowest number; at 0 the one that they are in deepest, if they overlap one already.
/// What they touch without getting into it they do not meet.
std::optional<Hit> wall_hit(const Walls&, std::span<const Convex> outlines, const Frame& from, Vec2 way);

}  // namespace carom
