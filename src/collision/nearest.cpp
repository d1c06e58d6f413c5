#include "collision/nearest.hpp"

#include <cmath>
#include <limits>

#include "collision/outlines_alone.hpp"

namespace carom {

// The distance of convex outlines has no other minima than the least one, so that it is found by going to neighbouring
// edges as long as that comes nearer.
Nearest nearest_points(const Placed& p, int i, const Placed& q, int j) {
    const OutlineOf<double> of_p = outline_of(p), of_q = outline_of(q);
    EdgeOf<double> edge_p(of_p, i), edge_q(of_q, j);
    NearestOf<double> best = nearest_of_edges(edge_p, edge_q);
    for (;;) {
        const Plane<double> d = best.on_q - best.on_p;
        const OpenWays<double> open_p(of_p, edge_p, best.feature_p, d), open_q(of_q, edge_q, best.feature_q, -d);
        const struct {
            bool open;
            int i, j;
        } ways[] = {{open_p.before, p.last(edge_p.edge), edge_q.edge},
                    {open_p.behind, edge_p.next, edge_q.edge},
                    {open_q.before, edge_p.edge, q.last(edge_q.edge)},
                    {open_q.behind, edge_p.edge, edge_q.next}};
        bool nearer = false;
        for (const auto& way : ways) {
            if (!way.open || nearer) continue;
            const EdgeOf<double> then_p(of_p, way.i), then_q(of_q, way.j);
            const NearestOf<double> other = nearest_of_edges(then_p, then_q);
            nearer = other.squared < best.squared;
            if (nearer) best = other, edge_p = then_p, edge_q = then_q;
        }
        if (!nearer)
            return {{vector(best.on_p), vector(best.on_q), static_cast<std::uint32_t>(best.feature_p),
                     static_cast<std::uint32_t>(best.feature_q)},
                    best.squared,
                    best.corners};
    }
}

int edge_facing(const Placed& q, Vec2 direction) { return edge_facing(outline_of(q), plane(direction)); }

namespace {

/// How far a point may go along a direction from corner k of an outline on a side that has this direction, up to `most`
/// with its sign.
Vec2 slide(const Placed& outline, int k, Vec2 along, double most) {
    constexpr double flat = 1e-9;
    for (const int other : {outline.next(k), outline.last(k)}) {
        const Vec2 side = outline.corner(other) - outline.corner(k);
        const double reach = dot(side, along);
        if (reach * most > 0 && std::abs(cross(side, along)) <= flat * std::abs(reach))
            return (std::abs(most) < std::abs(reach) ? most : reach) * along;
    }
    return {};
}

}  // namespace

CoreDistance core_distance(const Placed& p, const Placed& q) {
    using Edge = CoreDistance::Edge;
    constexpr double none = -std::numeric_limits<double>::infinity();
    const Separations of_p(p, q), of_q(q, p);
    const double largest_p = p.count > 1 ? of_p.best.value : none;
    const double largest_q = q.count > 1 ? of_q.best.value : none;
    const bool p_leads = largest_p >= largest_q;
    const double largest = std::max(largest_p, largest_q);
    const Vec2 normal = p_leads ? Vec2(p.normal(of_p.best.index)) : -q.normal(of_q.best.index);
    const int i = p_leads ? of_p.best.index : edge_facing(p, -normal),
              j = p_leads ? edge_facing(q, normal) : of_q.best.index;
    const bool thin = p.count <= 2 && q.count <= 2;
    if (largest > 0 || thin) {
        const Nearest nearest = nearest_points(p, i, q, j);
        const Vec2 d = nearest.point.on_q - nearest.point.on_p;
        const double distance = length(d), hair = 1e-9 * std::max(p.width, q.width);
        // Of lines that cross an end is nearest to a line, and no axis keeps them apart.
        if (distance > hair && (largest > hair || nearest.corners)) {
            const Edge edge = nearest.corners                              ? Edge::none
                              : nearest.point.feature_p >= edge_feature(0) ? Edge::of_p
                                                                           : Edge::of_q;
            return {distance, d / distance, nearest.point.on_p, nearest.point.on_q, edge};
        }
    }
    if (largest == none) return {0, {0, 1}, p.corner(0), q.corner(0), Edge::none};
    // The corner that is deepest, and its foot on the edge.
    const Placed &corners = p_leads ? q : p, &edges = p_leads ? p : q;
    const int edge = p_leads ? i : j;
    const Vec2 out = p_leads ? normal : -normal;
    int deepest = 0;
    for (int k = 1; k < corners.count; ++k)
        if (dot(corners.corner(k), out) < dot(corners.corner(deepest), out)) deepest = k;
    const Vec2 corner = corners.corner(deepest), along = perpendicular(out);
    // Of what lies flat on the edge a whole side is deepest, and the foot of the corner may be beyond the edge's ends.
    const Vec2 start = edges.corner(edge), end = edges.corner(edges.next(edge));
    const double place = dot(corner - start, along),
                 onto = std::min(std::max(place, 0.0), dot(end - start, along)) - place;
    const Vec2 foot = corner - largest * out + onto * along, point = corner + slide(corners, deepest, along, onto);
    if (p_leads) return {largest, normal, foot, point, Edge::of_p};
    return {largest, normal, point, foot, Edge::of_q};
}

}  // namespace carom
