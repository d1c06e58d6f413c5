#pragma once
// The text in collision/outlines_text.hpp for one pair of outlines.

#include "collision/nearest.hpp"
#include "collision/outlines_text.hpp"
#include "simd/duo.hpp"

namespace carom {
namespace {

static_assert(edge_feature(0) == first_edge_feature);

inline Plane<double> plane(Vec2 a) { return {a.x, a.y}; }
inline Vec2 vector(const Plane<double>& a) { return {a.x, a.y}; }

inline OutlineOf<double> outline_of(const Placed& p) {
    return {p.corner_x(), p.corner_y(), p.normal_x(), p.normal_y(), p.count, p.count, p.radius, p.width};
}

/// How far q lies outside each edge of p.
struct Separations {
    double of[Convex::most_corners];
    FirstOf<double> best;

    Separations(const Placed& p, const Placed& q) {
        const auto at = [](const double* x, const double* y) { return Plane<Duo>{load_duo(x), load_duo(y)}; };
        int k = 0;
        do {
            store(outside(at(p.normal_x() + k, p.normal_y() + k), at(p.corner_x() + k, p.corner_y() + k), q.corner_x(),
                          q.corner_y(), q.count),
                  of + k);
        } while ((k += 2) < p.count);
        best = first_largest(of, p.count);
    }
};

}  // namespace
}  // namespace carom
