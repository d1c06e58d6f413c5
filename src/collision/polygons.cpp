#include "collision/polygons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <carom/error.hpp>
#include <optional>

namespace carom {

namespace {

using Indices = std::vector<std::size_t>;

/// Which way a path from a over b to c turns: 1 left, -1 right, 0 straight on or back, but for rounding.
int turn(Vec2 a, Vec2 b, Vec2 c) {
    const double area = cross(b - a, c - b), scale = length(b - a) * length(c - b);
    return area > 1e-12 * scale ? 1 : area < -1e-12 * scale ? -1 : 0;
}

bool between(Vec2 a, Vec2 b, Vec2 p) { return dot(p - a, p - b) <= 0; }

/// Whether lines from a to b and from c to d have a point in common.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    const int c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a), b_side = turn(c, d, b);
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return (c_side == 0 && between(a, b, c)) || (d_side == 0 && between(a, b, d)) ||
           (a_side == 0 && between(c, d, a)) || (b_side == 0 && between(c, d, b));
}

void check_corners(const Corners& p, const std::string& name) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j)
            if (p[i] == p[j])
                throw Error(fmt::format("{} must be different points, but {} and {} are both ({}, {})", name, i, j,
                                        p[i].x, p[i].y));
    for (std::size_t i = 0; i < n; ++i)
        if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) == 0)
            throw Error(
                fmt::format("{} must not lie in a line: points {}, {} and {} do", name, i, (i + 1) % n, (i + 2) % n));
}

void check_edges(const Corners& p, const std::string& name) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j)
            if ((j + 1) % n != i && meet(p[i], p[i + 1], p[j], p[(j + 1) % n]))
                throw Error(
                    fmt::format("{} must be a polygon that does not meet itself: the edge from {} to {} meets "
                                "the one from {} to {}",
                                name, i, i + 1, j, (j + 1) % n));
}

/// Or on an edge, but for rounding: what is left of an L whose notch is on the diagonal would meet itself.
bool inside(Vec2 a, Vec2 b, Vec2 c, Vec2 p) { return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0; }

/// A corner of a polygon, between its neighbours.
std::array<std::size_t, 3> around(const Indices& polygon, std::size_t k) {
    const std::size_t n = polygon.size();
    return {polygon[(k + n - 1) % n], polygon[k], polygon[(k + 1) % n]};
}
int turn_at(const Corners& p, const Indices& polygon, std::size_t k) {
    const auto [before, tip, after] = around(polygon, k);
    return turn(p[before], p[tip], p[after]);
}

bool is_ear(const Corners& p, const Indices& rest, std::size_t k) {
    if (turn_at(p, rest, k) <= 0) return false;
    const std::array ear = around(rest, k);
    return std::none_of(rest.begin(), rest.end(), [&](std::size_t i) {
        return i != ear[0] && i != ear[1] && i != ear[2] && inside(p[ear[0]], p[ear[1]], p[ear[2]], p[i]);
    });
}

/// Triangles by cutting off ears (Meisters 1975: every simple polygon has two). Corners of 180° that are left are none.
std::vector<Indices> triangles(const Corners& p) {
    Indices rest(p.size());
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = i;
    const auto first = [&](const auto& is_one) {
        std::size_t k = 0;
        while (k < rest.size() && !is_one(k)) ++k;
        return k;
    };
    std::vector<Indices> found;
    while (rest.size() > 3) {
        std::size_t k = first([&](std::size_t i) { return is_ear(p, rest, i); });
        if (k < rest.size()) {
            const std::array ear = around(rest, k);
            found.emplace_back(ear.begin(), ear.end());
        } else {
            k = first([&](std::size_t i) { return turn_at(p, rest, i) == 0; });
        }
        if (k == rest.size()) throw Error("Polygon.points must not be so close to a line that rounding hides the area");
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
    }
    found.push_back(rest);
    return found;
}

/// Two parts as one if they share an edge and the whole is convex. (A corner of 180° is allowed; it is dropped later.)
std::optional<Indices> merged(const Corners& p, const Indices& a, const Indices& b, std::size_t most_corners) {
    if (a.size() + b.size() - 2 > most_corners) return {};
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) {
            if (a[i] != b[(j + 1) % b.size()] || a[(i + 1) % a.size()] != b[j]) continue;
            Indices whole;
            for (std::size_t k = 1; k <= a.size(); ++k) whole.push_back(a[(i + k) % a.size()]);
            for (std::size_t k = 2; k < b.size(); ++k) whole.push_back(b[(j + k) % b.size()]);
            for (std::size_t k = 0; k < whole.size(); ++k)
                if (turn_at(p, whole, k) < 0) return {};
            return whole;
        }
    return {};
}

/// Leaves out the diagonals that convexity does not need: at most four times as many parts as necessary stay (Hertel,
/// Mehlhorn 1983; O'Rourke, Computational Geometry in C, 2.5).
void merge_all(const Corners& p, std::vector<Indices>& parts, std::size_t most_corners) {
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t j = i + 1; j < parts.size();) {
            if (const auto whole = merged(p, parts[i], parts[j], most_corners)) {
                parts[i] = *whole;
                parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
                j = i + 1;  // the larger part has other neighbours
            } else {
                ++j;
            }
        }
}

}  // namespace

double doubled_area(std::span<const Vec2> p) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += cross(p[i] - p[0], p[i + 1] - p[0]);
    return sum;
}

bool is_convex(std::span<const Vec2> p) {
    for (std::size_t i = 0; i < p.size(); ++i)
        if (turn(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) < 0) return false;
    return true;
}

Corners convex_hull(Corners points) {
    // Monotone chain (Andrew 1979): the lower side from left to right, then the upper one back.
    std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Corners hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t start = hull.size();
        for (const Vec2 p : points) {
            while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();  // it starts the other side
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

Corners simple_polygon(const Corners& points, const std::string& name) {
    if (points.size() < 3) throw Error(fmt::format("{} must be at least 3, got {}", name, points.size()));
    check_corners(points, name);
    check_edges(points, name);
    Corners corners = points;
    if (doubled_area(corners) < 0) std::reverse(corners.begin(), corners.end());
    return corners;
}

std::vector<Corners> pieces_of_convex(const Corners& corners, std::size_t most_corners) {
    if (corners.size() <= most_corners) return {corners};
    const auto middle = corners.begin() + static_cast<std::ptrdiff_t>(corners.size() / 2);
    Corners back(middle, corners.end());
    back.push_back(corners.front());
    std::vector<Corners> pieces = pieces_of_convex(Corners(corners.begin(), middle + 1), most_corners);
    for (Corners& piece : pieces_of_convex(back, most_corners)) pieces.push_back(std::move(piece));
    return pieces;
}

std::vector<Corners> convex_parts(const Corners& corners, std::size_t most_corners) {
    std::vector<Indices> parts = triangles(corners);
    merge_all(corners, parts, most_corners);
    std::vector<Corners> found;
    for (const Indices& part : parts) {
        Corners piece;
        for (std::size_t k = 0; k < part.size(); ++k)
            if (turn_at(corners, part, k) > 0) piece.push_back(corners[part[k]]);
        if (piece.size() > 2) found.push_back(piece);  // else it has no area but rounding
    }
    return found;
}

}  // namespace carom
