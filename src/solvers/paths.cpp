#include "solvers/paths.hpp"

#include <algorithm>
#include <array>

#include "math/roots.hpp"

namespace carom {

Path parabola(double start, Vec2 x, Vec2 v, Vec2 a) { return {start, x, v, 0.5 * a, {}}; }

Path hermite(Vec2 x0, Vec2 v0, Vec2 x1, Vec2 v1, double h) {
    const Vec2 mean = (x1 - x0) / h;
    return {0, x0, v0, (3 * mean - 2 * v0 - v1) / h, (v0 + v1 - 2 * mean) / (h * h)};
}

Reach reach(const Path& p, double end) {
    // A cubic stays within the hull of its Bézier points.
    const double t = end - p.start;
    const Vec2 points[] = {p.c0, p.c0 + t / 3 * p.c1, p.c0 + 2 * t / 3 * p.c1 + t * t / 3 * p.c2, p.position(end)};
    const Vec2 centre = 0.5 * (points[0] + points[3]);
    double radius = 0;
    for (const Vec2 point : points) radius = std::max(radius, length(point - centre));
    return {centre, radius};
}

namespace {

/// The path's polynomial about another start.
std::array<Vec2, 4> from_time(const Path& p, double s) {
    const double t = s - p.start;
    if (t == 0) return {p.c0, p.c1, p.c2, p.c3};
    return {p.position(s), p.velocity(s), p.c2 + 3 * t * p.c3, p.c3};
}

std::optional<double> from_start(const std::optional<double>& t, double from) {
    return t ? std::optional(from + *t) : std::nullopt;
}

}  // namespace

std::optional<double> first_touch(const Path& a, const Path& b, double distance, double from, double end,
                                  const std::optional<Periodic>& box) {
    const auto pa = from_time(a, from), pb = from_time(b, from);
    Vec2 d[4];
    for (int k = 0; k < 4; ++k) d[k] = pb[k] - pa[k];
    d[0] = nearest_image(box, d[0]);
    // |Σ d_k t^k|² − distance²
    std::array<double, 7> gap{};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) gap[i + j] += dot(d[i], d[j]);
    gap[0] -= distance * distance;
    return from_start(first_descent(gap, end - from), from);
}

std::optional<double> first_touch(const Path& a, double radius, const Wall& wall, double from, double end) {
    const auto p = from_time(a, from);
    const std::array<double, 4> gap{dot(p[0], wall.normal) - wall.offset - radius, dot(p[1], wall.normal),
                                    dot(p[2], wall.normal), dot(p[3], wall.normal)};
    return from_start(first_descent(gap, end - from), from);
}

}  // namespace carom
