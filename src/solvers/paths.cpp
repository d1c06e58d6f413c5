#include "solvers/paths.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Of a body that flies farther in a step only the image is looked at that was nearest at the start: the work for all
/// grows with the way, and there is no end to how long that may be.
constexpr double most_boxes = 1e4;

constexpr double in_doubt = 1e-14;  ///< of what is subtracted, by rounding

/// Where one disc is as seen from another: a polynomial of time.
using Way = std::array<Vec2, 4>;
Way way_between(const Path& a, const Path& b, double from) {
    const auto pa = from_time(a, from), pb = from_time(b, from);
    Way d;
    for (std::size_t k = 0; k < d.size(); ++k) d[k] = pb[k] - pa[k];
    return d;
}
/// It is no longer than this in a time t.
double longest(const Way& d, double t) { return t * (length(d[1]) + t * (length(d[2]) + t * length(d[3]))); }

std::optional<double> first_touch(const Way& d, double distance, double end) {
    // |Σ d_k t^k|² − distance²
    std::array<double, 7> gap{};
    for (std::size_t i = 0; i < d.size(); ++i)
        for (std::size_t j = 0; j < d.size(); ++j) gap[i + j] += dot(d[i], d[j]);
    gap[0] -= distance * distance;
    return first_descent(gap, end);
}

struct Strip {
    int first, last;
};
/// Which images of what is at x, a box's width apart, lie within reach; its own, 0, in any case.
Strip images(double x, double reach, double width) {
    constexpr double most = 2;  // only a disc larger than the box, which overlaps its own images, reaches farther
    return {static_cast<int>(std::clamp(std::ceil((-reach - x) / width), -most, 0.0)),
            static_cast<int>(std::clamp(std::floor((reach - x) / width), 0.0, most))};
}

}  // namespace

std::optional<double> first_touch(const Path& a, const Path& b, double distance, double from, double end,
                                  const std::optional<Periodic>& box) {
    Way d = way_between(a, b, from);
    if (!box) return from_start(first_touch(d, distance, end - from), from);

    d[0] = nearest_image(box, d[0]);
    const Vec2 size = box->high - box->low;
    const double t = end - from, travel = longest(d, t);
    const double middle = 0.5 * (from + end), least = std::min(size.x, size.y);
    if (!(travel < most_boxes * least)) return from_start(first_touch(d, distance, t), from);
    if (travel > least && from < middle && middle < end) {
        const auto early = first_touch(a, b, distance, from, middle, box);
        return early ? early : first_touch(a, b, distance, middle, end, box);
    }
    // The image that is nearest at the start need not be the one that is hit.
    const Strip columns = images(d[0].x, travel + distance, size.x), rows = images(d[0].y, travel + distance, size.y);
    std::optional<double> first;
    for (int column = columns.first; column <= columns.last; ++column) {
        for (int row = rows.first; row <= rows.last; ++row) {
            Way image = d;
            image[0] += Vec2{column * size.x, row * size.y};
            const auto touch = first_touch(image, distance, t);
            if (touch && (!first || *touch < *first)) first = touch;
        }
    }
    return from_start(first, from);
}

std::optional<double> first_touch(const Path& a, double radius, const Wall& wall, double from, double end) {
    const auto p = from_time(a, from);
    const std::array<double, 4> gap{dot(p[0], wall.normal) - wall.offset - radius, dot(p[1], wall.normal),
                                    dot(p[2], wall.normal), dot(p[3], wall.normal)};
    return from_start(first_descent(gap, end - from), from);
}

bool stay_apart(const Path& a, const Path& b, double distance, double from, double end,
                const std::optional<Periodic>& box) {
    const Way d = way_between(a, b, from);
    return length(nearest_image(box, d[0])) - longest(d, end - from) > (1 + in_doubt) * distance;
}

bool stay_apart(const Path& a, double radius, const Wall& wall, double from, double end) {
    const Way p = from_time(a, from);
    const double gap = dot(p[0], wall.normal) - wall.offset - radius;
    return gap - longest(p, end - from) > in_doubt * (length(p[0]) + std::abs(wall.offset) + radius);
}

}  // namespace carom
