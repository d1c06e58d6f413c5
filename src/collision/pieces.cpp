// Shapes as convex pieces.

#include <fmt/format.h>

#include <algorithm>
#include <carom/error.hpp>

#include "collision/outline.hpp"
#include "collision/polygons.hpp"
#include "math/pages.hpp"

namespace carom {

namespace {

Corners corners_of(const Box& box) {
    const double shorter = std::min(box.width, box.height);
    if (2 * box.rounding > shorter)
        throw Error(fmt::format("Box.rounding must be at most half the shorter side, {} m, got {} m", shorter / 2,
                                box.rounding));
    const double x = box.width / 2 - box.rounding, y = box.height / 2 - box.rounding;
    const Frame frame = frame_at(box.centre, box.angle);
    const auto at = [&](double u, double v) { return box.centre + frame.turn({u, v}); };
    if (x == 0 && y == 0) return {box.centre};
    if (y == 0) return {at(-x, 0), at(x, 0)};
    if (x == 0) return {at(0, -y), at(0, y)};
    return {at(-x, -y), at(x, -y), at(x, y), at(-x, y)};
}

Corners ends(Vec2 a, Vec2 b, const char* name) {
    if (a == b) throw Error(fmt::format("{}.b must be another point than a, got ({}, {})", name, b.x, b.y));
    return {a, b};
}

}  // namespace

Outline outline_of(const Disc& disc) { return {{disc.centre}, disc.radius}; }
Outline outline_of(const Capsule& capsule) {
    return {capsule.a == capsule.b ? Corners{capsule.a} : Corners{capsule.a, capsule.b}, capsule.radius};
}
Outline outline_of(const Box& box) { return {corners_of(box), box.rounding}; }
Outline outline_of(const Polygon& polygon) {
    const Corners corners = simple_polygon(polygon.points, "Polygon.points");
    if (polygon.rounding > 0 && !is_convex(corners))
        throw Error(fmt::format("Polygon.rounding must be 0 for a concave polygon, got {} m", polygon.rounding));
    return {corners, polygon.rounding};
}
Outline outline_of(const Hull& hull) {
    const Corners corners = convex_hull(hull.points);
    if (corners.size() < 3) throw Error("Hull.points must be at least 3 that do not lie in a line");
    return {corners, hull.rounding};
}
Outline outline_of(const Segment& segment) { return {ends(segment.a, segment.b, "Segment"), 0}; }

namespace {

template <class T>
std::vector<Convex> split(const T& shape) {
    const Outline outline = outline_of(shape);
    // What is not told by its points is convex, with four corners at most.
    if constexpr (!requires { shape.points; }) return {convex(outline.corners, outline.rounding)};
    const auto parts = is_convex(outline.corners) ? pieces_of_convex(outline.corners, Convex::most_corners)
                                                  : convex_parts(outline.corners, Convex::most_corners);
    std::vector<Convex> pieces;
    for (const Corners& corners : parts) pieces.push_back(convex(corners, outline.rounding));
    return pieces;
}

/// How far beyond an end of each of some lines in the order of a chain, or against it, its line bounds the room over
/// those that follow: as far as they bend towards the room, and by no more than a right angle.
void find_reaches(std::vector<Convex>& pieces, bool is_closed, bool forwards) {
    constexpr double straight = 1e-9;  // rad, by rounding
    const std::size_t count = pieces.size(), most = is_closed ? 2 * count : count;
    const auto at = [&](std::size_t i) -> Convex& { return pieces[forwards ? i % count : count - 1 - i % count]; };
    const auto bend = [&](std::size_t i, std::size_t j) {
        return (forwards ? 1 : -1) * cross(at(i).normal[0], at(j).normal[0]);
    };
    const auto bends_on = [&](std::size_t first, std::size_t next) {
        return next < std::min(most, first + count) &&
               bend(next - 1, next) > (next == first + 1 ? straight : -straight) &&
               dot(at(first).normal[0], at(next).normal[0]) > 0;
    };
    std::size_t end = 0;  // the first line over which the room is not bounded any more
    for (std::size_t i = 0; i < count; ++i) {
        end = std::max(end, i + 1);
        const bool bends = bends_on(i, i + 1);
        while (bends && bends_on(i, end)) ++end;
        const Convex& last = at(end - 1);
        Convex& piece = at(i);
        const Vec2 along = (forwards ? -1 : 1) * perpendicular(piece.normal[0]);
        const double reach = bends ? dot(last.corner[forwards ? 0 : 1] - piece.corner[forwards ? 0 : 1], along) : 0;
        (forwards ? piece.next_reach : piece.previous_reach) = reach;
    }
}

std::vector<Convex> split(const Chain& chain) {
    const std::vector<Vec2>& p = chain.points;
    if (p.size() < 2) throw Error(fmt::format("Chain.points must be at least 2, got {}", p.size()));
    const std::size_t lines = chain.closed ? p.size() : p.size() - 1;
    std::vector<Convex> pieces;
    for (std::size_t i = 0; i < lines; ++i) {
        const Vec2 from = p[i], to = p[(i + 1) % p.size()];
        if (from == to)
            throw Error(fmt::format("Chain.points must differ from the one before, and {} is ({}, {}) again",
                                    (i + 1) % p.size(), to.x, to.y));
        pieces.push_back(convex(Corners{to, from}, 0));
        pieces.back().one_sided = true;
    }
    for (std::size_t i = 0; i < lines; ++i) {
        Convex& piece = pieces[i];
        piece.has_previous = chain.closed || i > 0;
        piece.has_next = chain.closed || i + 1 < lines;
        const Convex &previous = pieces[(i + lines - 1) % lines], &next = pieces[(i + 1) % lines];
        if (piece.has_previous) piece.previous_normal = previous.normal[0], piece.previous_length = previous.width;
        if (piece.has_next) piece.next_normal = next.normal[0], piece.next_length = next.width;
    }
    for (const bool forwards : {false, true}) find_reaches(pieces, chain.closed, forwards);
    return pieces;
}

}  // namespace

std::vector<Convex> pieces_of(const Geometry& geometry) {
    return std::visit([](const auto& shape) { return split(shape); }, geometry);
}

namespace {

std::size_t least_pieces(const Bodies& bodies) {
    std::size_t count = 0;
    for (const auto& shapes : bodies.shapes) count += std::max<std::size_t>(shapes.size(), 1);
    return count;
}

}  // namespace

void renew_pieces(const Bodies& bodies, std::size_t first, std::vector<Piece>& all) {
    all.erase(std::partition_point(all.begin(), all.end(), [first](const Piece& p) { return p.row < first; }),
              all.end());
    if (first == 0) reserve_large(all, least_pieces(bodies));
    for (auto row = static_cast<std::uint32_t>(first); row < bodies.size(); ++row) {
        Piece piece;
        piece.row = row;
        piece.restitution = bodies.restitution[row], piece.friction = bodies.friction[row];
        piece.outline.radius = bodies.radius[row];
        if (bodies.shapes[row].empty()) all.push_back(piece);
        for (const Shape& shape : bodies.shapes[row]) {
            piece.restitution = shape.restitution.value_or(bodies.restitution[row]);
            piece.friction = shape.friction.value_or(bodies.friction[row]);
            piece.rolling_resistance = shape.rolling_resistance, piece.surface_speed = shape.surface_speed;
            piece.sensor = shape.sensor, piece.filter = shape.filter;
            for (const Convex& outline : pieces_of(shape.geometry)) {
                piece.outline = outline;
                all.push_back(piece);
                ++piece.number;
            }
            ++piece.shape;
        }
    }
}

}  // namespace carom
