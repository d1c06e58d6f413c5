#pragma once
// The text in collision/outlines_text.hpp for one pair of outlines.

#include "simd/duo.hpp"

#include "collision/nearest.hpp"
#include "collision/outlines_text.hpp"

namespace carom {
namespace {

inline Plane<double> plane(Vec2 a) { return {a.x, a.y}; }
inline Vec2 vector(const Plane<double>& a) { return {a.x, a.y}; }

inline OutlineOf<double> outline_of(const Placed& p) {
    return {p.corner.x, p.corner.y, p.normal.x, p.normal.y, p.count, p.count, p.radius, p.width};
}

/// How far q lies outside each edge of p.
struct Separations {
    double of[Convex::most_corners];
    FirstOf<double> best;

    Separations(const Placed& p, const Placed& q) {
        for (int k = 0; k < p.count; k += 2)
            store(outside(Plane<Duo>{load_duo(p.normal.x + k), load_duo(p.normal.y + k)},
                          Plane<Duo>{load_duo(p.corner.x + k), load_duo(p.corner.y + k)}, q.corner.x, q.corner.y, q.count),
                  of + k);
        best = first_largest(of, p.count);
    }
};

}  // namespace
}  // namespace carom
