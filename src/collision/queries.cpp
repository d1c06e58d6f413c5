#include "collision/queries.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/nearest.hpp"
#include "collision/toi.hpp"

namespace carom {

namespace {

bool is_sought(const PlacedPieces& all, std::size_t k, const Sought& sought) {
    if (all[k].sensor && !sought.sensors) return false;
    if (sought.except && all.ids[all[k].row] == *sought.except) return false;
    return !sought.filter || may_meet(*sought.filter, all[k].filter);
}

Aabb around(const Aabb& box, Vec2 way) {
    return {box.low + Vec2{std::min(way.x, 0.), std::min(way.y, 0.)},
            box.high + Vec2{std::max(way.x, 0.), std::max(way.y, 0.)}};
}

/// A ray's entry in the outline's frame.
struct Entry {
    double fraction;
    Vec2 normal;
};

/// Into a convex polygon without a rim: it is behind all edges at once (Cyrus, Beck 1978). Nothing slips through at a
/// corner.
std::optional<Entry> entry_into_polygon(const Convex& c, Vec2 o, Vec2 way) {
    double enter = -HUGE_VAL, leave = HUGE_VAL;
    Vec2 normal{};
    for (int i = 0; i < c.count; ++i) {
        const double ahead = dot(c.corner[i] - o, c.normal[i]), speed = dot(way, c.normal[i]);
        if (speed == 0 && ahead < 0) return {};
        if (speed < 0 && ahead / speed > enter) enter = ahead / speed, normal = c.normal[i];
        if (speed > 0) leave = std::min(leave, ahead / speed);
    }
    if (enter > leave) return {};
    return Entry{enter, normal};
}

/// Into a disc: of the two roots the first.
std::optional<Entry> entry_into_disc(Vec2 centre, double radius, Vec2 o, Vec2 way) {
    const Vec2 from = o - centre;
    const double squared = squared_length(way), half = dot(from, way);
    // The nearest point of the ray's line, and not the discriminant: it keeps its digits far away.
    const Vec2 nearest = from - half / squared * way;
    const double rest = radius * radius - squared_length(nearest);
    if (!(rest >= 0) || radius == 0) return {};
    const double fraction = (-half - std::sqrt(rest * squared)) / squared;
    return Entry{fraction, (from + fraction * way) / radius};
}

/// Through the straight part of a rim, or through a line from the side of its normal.
std::optional<Entry> entry_through_edge(const Convex& c, int i, Vec2 o, Vec2 way) {
    const Vec2 n = c.normal[i], start = c.corner[i] + c.radius * n, along = perpendicular(n);
    const double speed = dot(way, n);
    if (speed >= 0) return {};
    const double fraction = dot(start - o, n) / speed;
    const double place = dot(o + fraction * way - start, along);
    if (place < 0 || place > dot(c.corner[(i + 1) % c.count] - c.corner[i], along)) return {};
    return Entry{fraction, n};
}

/// Into what consists of discs at the corners and strips at the edges: the first of all entries, from outside.
std::optional<Entry> entry_through_rim(const Convex& c, Vec2 o, Vec2 way) {
    if (c.radius > 0) {
        const Placed outline(c, {}, {}), point(convex(std::array{o}, 0), {}, {});
        if (core_distance(outline, point).distance < c.radius) return {};
    }
    std::optional<Entry> first;
    const auto offer = [&](const std::optional<Entry>& entry) {
        if (entry && entry->fraction >= 0 && (!first || entry->fraction < first->fraction)) first = entry;
    };
    const int edges = c.count == 1 || c.one_sided ? c.count - 1 : c.count;
    for (int i = 0; i < edges; ++i) offer(entry_through_edge(c, i, o, way));
    for (int i = 0; i < c.count; ++i) offer(entry_into_disc(c.corner[i], c.radius, o, way));
    return first;
}

Convex turned(Convex outline, const Frame& at) {
    for (int i = 0; i < outline.count; ++i)
        outline.corner[i] = at.turn(outline.corner[i]), outline.normal[i] = at.turn(outline.normal[i]);
    outline.centre = at.turn(outline.centre);
    return outline;
}

/// How deep in one another two that touch may be [m], for rounding.
double rounding_of(const Convex& a, const Convex& b, Vec2 between) {
    const double size_a = size_of(a), size_b = size_of(b);
    return touch_hair * std::min(size_a, size_b) + 1e-14 * std::max({size_a, size_b, length(between)});
}

/// Whether an outline that moves along a way gets no deeper into a piece than touch: then a direction parts the two in
/// which it comes no nearer. As nothing turns, that is an edge's, or across the way, or that of the nearest points.
bool passes(const Placed& piece, const Placed& outline, Vec2 way, double rounding) {
    const auto parts = [&](Vec2 n) {
        double gap = HUGE_VAL;
        for (int i = 0; i < outline.count; ++i)
            for (int k = 0; k < piece.count; ++k) gap = std::min(gap, dot(outline.corner(i) - piece.corner(k), n));
        return dot(way, n) >= -rounding && gap - outline.radius - piece.radius >= -rounding;
    };
    for (int i = 0; i < piece.count && piece.count > 1; ++i)
        if (parts(piece.normal(i))) return true;
    for (int i = 0; i < outline.count && outline.count > 1; ++i)
        if (parts(-outline.normal(i))) return true;
    const double far = length(way);
    const Vec2 across = far > 0 ? perpendicular(way / far) : Vec2{0, 1};
    return parts(across) || parts(-across) || parts(core_distance(piece, outline).normal);
}

std::optional<Meeting> moving_meets(const Convex& piece, const Frame& at, const Convex& outline, const Frame& from,
                                    Vec2 way) {
    const Convex a = turned(piece, at), b = turned(outline, from);
    const Vec2 between = from.position - at.position;
    const auto time = time_of_impact(a, {}, b, {way, 0, 0}, between, 0);
    if (!time) return {};
    const Placed there(a, {}, {});
    if (passes(there, Placed(b, {}, between), way, rounding_of(a, b, between))) return {};
    const CoreDistance apart = core_distance(there, Placed(b, {}, between + *time * way));
    return Meeting{at.position + apart.on_p + a.radius * apart.normal, apart.normal, *time};
}

/// Calls f(k) for every piece that is sought and whose bounds meet a box that is moved along a way.
template <class F>
void each_near(const PlacedPieces& all, const Aabb& box, Vec2 way, const Sought& sought, F f) {
    constexpr double rounding = 1e-14;
    const Aabb room = around(box, way);
    const Vec2 far{std::max(std::abs(room.low.x), std::abs(room.high.x)),
                   std::max(std::abs(room.low.y), std::abs(room.high.y))};
    const Vec2 n{std::abs(way.y), std::abs(way.x)}, own = box.high - box.low + rounding * far;
    const auto is_beside = [&](const Aabb& other) {  // across the way
        const Vec2 apart = (other.low - box.low) + (other.high - box.high);
        return std::abs(cross(way, apart)) > dot(n, (other.high - other.low) + own);
    };
    all.places.each([&](const Aabb& other) { return overlap(room, other) && !is_beside(other); },
                    [&](std::size_t k) {
                        if (is_sought(all, k, sought)) f(k);
                    });
}

/// Whether a point lies in another piece of the same shape: where a concave shape was cut, no ray enters it.
bool lies_in_another_part(const PlacedPieces& all, std::size_t k, Vec2 point) {
    const Convex probe = convex(std::array{point}, 0);
    const auto contains = [&](std::size_t other) {
        return !all[other].outline.one_sided && overlap({point, point}, all.bounds(other)) &&
               closest_points(all[other].outline, all.frame(other), probe, {}).distance <= 0;
    };
    const auto is_part = [&](std::size_t other) {
        return all[other].row == all[k].row && all[other].shape == all[k].shape;
    };
    for (std::size_t other = k; other-- > 0 && is_part(other);)
        if (contains(other)) return true;
    for (std::size_t other = k + 1; other < all.pieces.size() && is_part(other); ++other)
        if (contains(other)) return true;
    return false;
}

/// Calls take(hit) for every piece that a ray meets, in the order of the list.
template <class Take>
void each_hit(const PlacedPieces& all, Vec2 origin, Vec2 way, const Sought& sought, Take take) {
    each_near(all, {origin, origin}, way, sought, [&](std::size_t k) {
        const auto met = ray_meets(all[k].outline, all.frame(k), origin, way);
        if (met && !lies_in_another_part(all, k, origin))
            take(Hit{all.shape(k).body, all[k].shape, met->point, met->normal, met->fraction});
    });
}

void keep_first(std::optional<Hit>& first, const Hit& hit) {
    if (!first || hit.fraction < first->fraction) first = hit;
}

}  // namespace

std::optional<Meeting> ray_meets(const Convex& outline, const Frame& at, Vec2 origin, Vec2 way) {
    const Vec2 o = at.turn_back(origin - at.position), along = at.turn_back(way);
    if (along == Vec2{}) return {};
    const bool solid = outline.count > 2 && outline.radius == 0;
    const auto entry = solid ? entry_into_polygon(outline, o, along) : entry_through_rim(outline, o, along);
    if (!entry || !(entry->fraction >= 0) || entry->fraction > 1) return {};
    return Meeting{origin + entry->fraction * way, at.turn(entry->normal), entry->fraction};
}

std::optional<Hit> first_hit(const PlacedPieces& all, Vec2 origin, Vec2 way, const Sought& sought) {
    std::optional<Hit> first;
    each_hit(all, origin, way, sought, [&](const Hit& hit) { keep_first(first, hit); });
    return first;
}

std::vector<Hit> all_hits(const PlacedPieces& all, Vec2 origin, Vec2 way, const Sought& sought) {
    std::vector<Hit> hits;
    each_hit(all, origin, way, sought, [&](const Hit& hit) {
        const bool again = !hits.empty() && hits.back().body == hit.body && hits.back().shape == hit.shape;
        if (!again)
            hits.push_back(hit);
        else if (hit.fraction < hits.back().fraction)
            hits.back() = hit;
    });
    std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.fraction < b.fraction; });
    return hits;
}

std::optional<Hit> first_hit(const PlacedPieces& all, std::span<const Convex> outlines, const Frame& from, Vec2 way,
                             const Sought& sought) {
    std::optional<Hit> first;
    for (const Convex& outline : outlines)
        each_near(all, bounds(outline, from), way, sought, [&](std::size_t k) {
            if (const auto met = moving_meets(all[k].outline, all.frame(k), outline, from, way))
                keep_first(first, {all.shape(k).body, all[k].shape, met->point, met->normal, met->fraction});
        });
    return first;
}

std::vector<ShapeId> overlapping(const PlacedPieces& all, std::span<const Convex> outlines, const Frame& at,
                                 const Sought& sought) {
    std::vector<std::size_t> found;
    for (const Convex& outline : outlines)
        each_near(all, bounds(outline, at), {}, sought, [&](std::size_t k) {
            if (closest_points(all[k].outline, all.frame(k), outline, at).distance <= 0) found.push_back(k);
        });
    if (outlines.size() > 1) std::sort(found.begin(), found.end());
    std::vector<ShapeId> shapes;
    for (const std::size_t k : found)
        if (shapes.empty() || shapes.back() != all.shape(k)) shapes.push_back(all.shape(k));
    return shapes;
}

namespace {

/// No more of a box than there is anything in.
Aabb filled(const PlacedPieces& all, const Aabb& box, const Sought& sought) {
    Aabb there{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    each_near(all, box, {}, sought, [&](std::size_t k) { there = hull(there, all.bounds(k)); });
    return {{std::max(box.low.x, there.low.x), std::max(box.low.y, there.low.y)},
            {std::min(box.high.x, there.high.x), std::min(box.high.y, there.high.y)}};
}

}  // namespace

std::vector<ShapeId> overlapping(const PlacedPieces& all, const Aabb& where, const Sought& sought) {
    constexpr double large = 1e150;  // whose square is a number: of a box as large as numbers go not even the size is
    const bool is_large = where.high.x - where.low.x > large || where.high.y - where.low.y > large;
    const Aabb box = is_large ? filled(all, where, sought) : where;
    if (!overlap(box, box)) return {};
    const Vec2 size = box.high - box.low;
    std::vector<Vec2> corners{{}};
    if (size.x > 0) corners.push_back({size.x, 0});
    if (size.x > 0 && size.y > 0) corners.push_back(size);
    if (size.y > 0) corners.push_back({0, size.y});
    return overlapping(all, std::array{convex(corners, 0)}, Frame{box.low}, sought);
}

std::vector<ShapeId> overlapping(const PlacedPieces& all, Vec2 point, const Sought& sought) {
    return overlapping(all, Aabb{point, point}, sought);
}

ClosestPoints closest_points(const Convex& a, const Frame& at_a, const Convex& b, const Frame& at_b) {
    const CoreDistance apart = core_distance(Placed(a, at_a, {}), Placed(b, at_b, at_b.position - at_a.position));
    return {.on_a = at_a.position + apart.on_p + a.radius * apart.normal,
            .on_b = at_a.position + apart.on_q - b.radius * apart.normal,
            .distance = apart.distance - a.radius - b.radius};
}

std::optional<ClosestPoints> closest_points(const PlacedPieces& all, std::uint32_t row_a, std::uint32_t row_b,
                                            const Sought& sought) {
    const auto pieces_of = [&](std::uint32_t row) {
        std::vector<std::size_t> found;
        each_piece_of(all.pieces, row, [&](std::size_t k) {
            if (is_sought(all, k, sought)) found.push_back(k);
        });
        return found;
    };
    std::optional<ClosestPoints> nearest;
    const auto of_a = pieces_of(row_a), of_b = pieces_of(row_b);
    for (const std::size_t k : of_a)
        for (const std::size_t l : of_b) {
            ClosestPoints points = closest_points(all[k].outline, all.frame(k), all[l].outline, all.frame(l));
            if (nearest && nearest->distance <= points.distance) continue;
            points.shape_a = all[k].shape, points.shape_b = all[l].shape;
            nearest = points;
        }
    return nearest;
}

double size_of(const Convex& outline) {
    const Aabb box = bounds(outline, {});
    return length(box.high - box.low);
}

double depth_in(const Wall& wall, const Convex& outline, const Frame& at) {
    double nearest = HUGE_VAL;
    for (int k = 0; k < outline.count; ++k)
        nearest = std::min(nearest, dot(wall.normal, at.position + at.turn(outline.corner[k])));
    return wall.offset + outline.radius - nearest;
}

}  // namespace carom
