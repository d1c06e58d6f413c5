#include "collision/nearest.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace carom {

namespace {

Nearest nearest_on_edge(Vec2 c, std::uint32_t corner, const Placed& p, int edge) {
    const Vec2 from = p.corner[edge], to = p.corner[p.next(edge)], along = to - from;
    const double place = dot(c - from, along);
    Nearest found;
    if (place <= 0)
        found = {{from, c, corner_feature(edge), corner}, 0, true};
    else if (dot(c - to, along) >= 0)
        found = {{to, c, corner_feature(p.next(edge)), corner}, 0, true};
    else
        found = {{from + place / squared_length(along) * along, c, edge_feature(edge), corner}, 0, false};
    found.squared = squared_length(c - found.point.on_p);
    return found;
}

Nearest nearest_of_edges(const Placed& p, int i, const Placed& q, int j) {
    Nearest best = nearest_on_edge(q.corner[j], corner_feature(j), p, i);
    const auto offer = [&](const Nearest& other) {
        if (other.squared < best.squared) best = other;
    };
    offer(nearest_on_edge(q.corner[q.next(j)], corner_feature(q.next(j)), p, i));
    for (const int k : {i, p.next(i)}) {
        Nearest other = nearest_on_edge(p.corner[k], corner_feature(k), q, j);
        std::swap(other.point.on_p, other.point.on_q);
        std::swap(other.point.feature_p, other.point.feature_q);
        offer(other);
    }
    return best;
}

}  // namespace

// The distance of convex outlines has no other minima than the least one, so that it is found by going to neighbouring
// edges as long as that comes nearer.
Nearest nearest_points(const Placed& p, int i, const Placed& q, int j) {
    Nearest best = nearest_of_edges(p, i, q, j);
    for (;;) {
        const Vec2 d = best.point.on_q - best.point.on_p;
        const int i_next = p.next(i), j_next = q.next(j);
        // Only an edge that starts out from the nearest corner towards the other outline can come nearer.
        const auto open_p = [&](int corner, int neighbour) {
            return best.point.feature_p == corner_feature(corner) && dot(p.corner[neighbour] - p.corner[corner], d) > 0;
        };
        const auto open_q = [&](int corner, int neighbour) {
            return best.point.feature_q == corner_feature(corner) && dot(q.corner[neighbour] - q.corner[corner], d) < 0;
        };
        const struct {
            bool open;
            int i, j;
        } ways[] = {{open_p(i, p.last(i)), p.last(i), j},
                    {open_p(i_next, p.next(i_next)), i_next, j},
                    {open_q(j, q.last(j)), i, q.last(j)},
                    {open_q(j_next, q.next(j_next)), i, j_next}};
        bool nearer = false;
        for (const auto& way : ways) {
            if (!way.open || nearer) continue;
            const Nearest other = nearest_of_edges(p, way.i, q, way.j);
            nearer = other.squared < best.squared;
            if (nearer) best = other, i = way.i, j = way.j;
        }
        if (!nearer) return best;
    }
}

int edge_facing(const Placed& q, Vec2 direction) {
    int best = 0;
    for (int j = 1; j < q.count; ++j)
        if (dot(q.normal[j], direction) < dot(q.normal[best], direction)) best = j;
    return best;
}

CoreDistance core_distance(const Placed& p, const Placed& q) {
    using Edge = CoreDistance::Edge;
    constexpr double none = -std::numeric_limits<double>::infinity();
    const Separations of_p(p, q), of_q(q, p);
    const double largest_p = p.count > 1 ? of_p.of[of_p.best] : none;
    const double largest_q = q.count > 1 ? of_q.of[of_q.best] : none;
    const bool p_leads = largest_p >= largest_q;
    const double largest = std::max(largest_p, largest_q);
    const Vec2 normal = p_leads ? Vec2(p.normal[of_p.best]) : -q.normal[of_q.best];
    const int i = p_leads ? of_p.best : edge_facing(p, -normal), j = p_leads ? edge_facing(q, normal) : of_q.best;
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
    if (largest == none) return {0, {0, 1}, p.corner[0], q.corner[0], Edge::none};
    // The corner that is deepest, and its foot on the edge.
    const Placed& corners = p_leads ? q : p;
    const Vec2 out = p_leads ? normal : -normal;
    int deepest = 0;
    for (int k = 1; k < corners.count; ++k)
        if (dot(corners.corner[k], out) < dot(corners.corner[deepest], out)) deepest = k;
    const Vec2 corner = corners.corner[deepest], foot = corner - largest * out;
    if (p_leads) return {largest, normal, foot, corner, Edge::of_p};
    return {largest, normal, corner, foot, Edge::of_q};
}

}  // namespace carom
