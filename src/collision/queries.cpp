#include "collision/queries.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/nearest.hpp"
#include "collision/toi.hpp"

namespace carom {

namespace {

bool is_sought(const Piece& piece, const Sought& sought) {
    return (piece.filter.category & sought.categories) != 0 && (sought.sensors || !piece.sensor);
}

bool overlap(const Aabb& a, const Aabb& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
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

std::optional<PieceHit> moving_hit(const Convex& piece, const Frame& at, const Convex& outline, const Frame& from,
                                   Vec2 way) {
    const Convex a = turned(piece, at), b = turned(outline, from);
    const Vec2 between = from.position - at.position;
    const auto time = time_of_impact(a, {}, b, {way, 0, 0}, between, 0);
    if (!time) return {};
    const CoreDistance apart = core_distance(Placed(a, {}, {}), Placed(b, {}, between + *time * way));
    return PieceHit{0, at.position + apart.on_p + a.radius * apart.normal, apart.normal, *time};
}

/// The first of what the pieces that are sought give, if their bounds meet a box.
template <class Try>
std::optional<PieceHit> first_of(PlacedPieces pieces, const Aabb& box, const Sought& sought, Try hit_of) {
    std::optional<PieceHit> first;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const PlacedPiece& at = pieces[k];
        if (!is_sought(*at.piece, sought) || !overlap(box, bounds(at.piece->outline, at.frame))) continue;
        const std::optional<PieceHit> hit = hit_of(at);
        if (!hit || (first && hit->fraction >= first->fraction)) continue;
        first = hit;
        first->index = k;
    }
    return first;
}

}  // namespace

std::optional<PieceHit> ray_hit(const Convex& outline, const Frame& at, Vec2 origin, Vec2 way) {
    const Vec2 o = at.turn_back(origin - at.position), along = at.turn_back(way);
    if (along == Vec2{}) return {};
    const bool solid = outline.count > 2 && outline.radius == 0;
    const auto entry = solid ? entry_into_polygon(outline, o, along) : entry_through_rim(outline, o, along);
    if (!entry || !(entry->fraction >= 0) || entry->fraction > 1) return {};
    return PieceHit{0, origin + entry->fraction * way, at.turn(entry->normal), entry->fraction};
}

std::optional<PieceHit> first_hit(PlacedPieces pieces, Vec2 origin, Vec2 way, const Sought& sought) {
    return first_of(pieces, around({origin, origin}, way), sought,
                    [&](const PlacedPiece& at) { return ray_hit(at.piece->outline, at.frame, origin, way); });
}

std::vector<PieceHit> all_hits(PlacedPieces pieces, Vec2 origin, Vec2 way, const Sought& sought) {
    std::vector<PieceHit> hits;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (!is_sought(*pieces[k].piece, sought)) continue;
        if (auto hit = ray_hit(pieces[k].piece->outline, pieces[k].frame, origin, way)) {
            hit->index = k;
            hits.push_back(*hit);
        }
    }
    std::sort(hits.begin(), hits.end(), [](const PieceHit& a, const PieceHit& b) {
        return a.fraction < b.fraction || (a.fraction == b.fraction && a.index < b.index);
    });
    return hits;
}

std::optional<PieceHit> first_hit(PlacedPieces pieces, const Convex& outline, const Frame& from, Vec2 way,
                                  const Sought& sought) {
    return first_of(pieces, around(bounds(outline, from), way), sought,
                    [&](const PlacedPiece& at) { return moving_hit(at.piece->outline, at.frame, outline, from, way); });
}

std::vector<std::size_t> overlapping(PlacedPieces pieces, const Convex& outline, const Frame& at,
                                     const Sought& sought) {
    std::vector<std::size_t> found;
    const Aabb box = bounds(outline, at);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const auto& [piece, frame] = pieces[k];
        if (is_sought(*piece, sought) && overlap(box, bounds(piece->outline, frame)) &&
            closest_points(piece->outline, frame, outline, at).distance <= 0)
            found.push_back(k);
    }
    return found;
}

std::vector<std::size_t> overlapping(PlacedPieces pieces, const Aabb& box, const Sought& sought) {
    const Vec2 size = box.high - box.low;
    std::vector<Vec2> corners{{}};
    if (size.x > 0) corners.push_back({size.x, 0});
    if (size.x > 0 && size.y > 0) corners.push_back(size);
    if (size.y > 0) corners.push_back({0, size.y});
    return overlapping(pieces, convex(corners, 0), Frame{box.low}, sought);
}

std::vector<std::size_t> overlapping(PlacedPieces pieces, Vec2 point, const Sought& sought) {
    return overlapping(pieces, Aabb{point, point}, sought);
}

ClosestPoints closest_points(const Convex& a, const Frame& at_a, const Convex& b, const Frame& at_b) {
    const CoreDistance apart = core_distance(Placed(a, at_a, {}), Placed(b, at_b, at_b.position - at_a.position));
    return {at_a.position + apart.on_p + a.radius * apart.normal, at_a.position + apart.on_q - b.radius * apart.normal,
            apart.distance - a.radius - b.radius};
}

}  // namespace carom
