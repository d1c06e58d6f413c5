#include "collision/room.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/queries.hpp"

namespace carom {

namespace {

/// The point of a wall's edge that is nearest to another one, the direction into the room there, and how far that one
/// is behind it.
struct NearestEdge {
    Vec2 point, normal;
    double depth;
};
NearestEdge nearest_edge(const Wall& wall, Vec2 p) {
    const double depth = wall.offset - dot(wall.normal, p);
    return {p + depth * wall.normal, wall.normal, depth};
}
NearestEdge nearest_edge(const Stadium& wall, Vec2 p) {
    const Vec2 axis = wall.b - wall.a;
    const double along = wall.a == wall.b ? 0 : dot(p - wall.a, axis) / squared_length(axis);
    const Vec2 foot = wall.a + std::clamp(along, 0., 1.) * axis, out = p - foot;
    const double distance = length(out);
    // On the axis both sides are as near.
    const Vec2 normal = distance > 0       ? -out / distance
                        : wall.a == wall.b ? Vec2{0, 1}
                                           : perpendicular(axis) / length(axis);
    return {foot - wall.radius * normal, normal, distance - wall.radius};
}

/// The part of a way on which a disc is in front of a wall, or a point of radius 0: fractions, which may lie before
/// the start and behind the end.
struct Stay {
    double enter, leave;
};
std::optional<Stay> stay_before(const Wall& wall, double radius, Vec2 from, Vec2 way) {
    const double room = dot(wall.normal, from) - wall.offset - radius, speed = dot(wall.normal, way);
    if (speed < 0) return Stay{-HUGE_VAL, room / -speed};
    if (speed > 0) return Stay{-room / speed, HUGE_VAL};
    if (room < 0) return {};
    return Stay{-HUGE_VAL, HUGE_VAL};
}
std::optional<Stay> stay_before(const Stadium& wall, double radius, Vec2 from, Vec2 way) {
    const double room = wall.radius - radius;
    if (!(room > 0)) return {};
    const Convex inside =
        wall.a == wall.b ? convex(std::array{wall.a}, room) : convex(std::array{wall.a, wall.b}, room);
    // Who leaves it comes in on the way back. Both ends of the line are surely outside.
    const double beyond = (length(wall.a - from) + length(wall.b - from) + 2 * wall.radius) / length(way);
    const Vec2 end = beyond * way;
    const auto in = ray_meets(inside, {}, from - end, 2 * end), back_in = ray_meets(inside, {}, from + end, -2 * end);
    if (!in || !back_in) return {};
    return Stay{beyond * (2 * in->fraction - 1), beyond * (1 - 2 * back_in->fraction)};
}

/// Calls act(number, wall) for all of them.
template <class Act>
void each_wall(const Walls& walls, const Act& act) {
    std::uint32_t number = 0;
    for (const Wall& wall : walls.all) act(number++, wall);
    for (const Stadium& wall : walls.round) act(number++, wall);
}

}  // namespace

std::optional<Hit> wall_hit(const Walls& walls, Vec2 origin, Vec2 way) {
    double enter = 0;
    Hit hit{.fraction = HUGE_VAL};
    each_wall(walls, [&](std::uint32_t number, const auto& wall) {
        const Stay stay = stay_before(wall, 0, origin, way).value_or(Stay{HUGE_VAL, -HUGE_VAL});
        enter = std::max(enter, stay.enter);
        if (!(stay.leave < hit.fraction) || stay.leave > 1) return;
        const NearestEdge edge = nearest_edge(wall, origin + stay.leave * way);
        hit = {{}, number, edge.point, edge.normal, stay.leave};
    });
    if (!(enter <= hit.fraction && hit.fraction <= 1)) return {};
    return hit;
}

std::optional<Hit> wall_hit(const Walls& walls, std::span<const Convex> outlines, const Frame& from, Vec2 way) {
    std::optional<Hit> first;
    double deepest = 0;  // of those that it is in at the start
    const auto meet = [&](std::uint32_t number, const auto& wall, Vec2 corner, double radius, double rounding) {
        const NearestEdge now = nearest_edge(wall, corner);
        const double depth = now.depth + radius;
        // The room is convex: who ends in it, having touched its edge, did not leave it.
        const bool touches = std::abs(depth) <= rounding;
        if (touches && nearest_edge(wall, corner + way).depth + radius <= rounding) return;
        if (depth >= 0 && !touches) {
            if (first && first->fraction == 0 && !(depth > deepest)) return;
            first = {{}, number, now.point, now.normal, 0};
            deepest = depth;
            return;
        }
        if (way == Vec2{}) return;
        const auto stay = stay_before(wall, radius, corner, way);
        // Who is in front of it by rounding alone leaves at once.
        const double leave = stay ? std::max(stay->leave, 0.) : 0;
        if (!(leave <= 1) || (first && !(leave < first->fraction))) return;
        const NearestEdge then = nearest_edge(wall, corner + leave * way);
        first = {{}, number, then.point, then.normal, leave};
    };
    each_wall(walls, [&](std::uint32_t number, const auto& wall) {
        for (const Convex& outline : outlines)
            for (int i = 0; i < outline.count; ++i) {
                const Vec2 corner = from.turn(outline.corner[i]);
                const double rounding = touch_hair * size_of(outline) + 1e-14 * length(from.position);
                meet(number, wall, from.position + corner, outline.radius, rounding);
            }
    });
    return first;
}

}  // namespace carom
