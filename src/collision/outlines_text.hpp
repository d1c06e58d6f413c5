#pragma once
// How outlines of several corners touch, for numbers and for lanes of them: V is double for a pair by itself, and for
// many at once what has a number of each. What a lane computes does not depend on what else there is.
//
// Without std and in an unnamed namespace, for wide kernels include it (src/simd/lanes.hpp).

#include "simd/single.hpp"

namespace carom {
namespace {

/// A normal within 0.8° (acos 0.9999) of another one counts as the same when it comes to which edge leads.
constexpr double sine_of_same = 0.0141, cosine_of_same = 0.9999;
constexpr int first_edge_feature = 8;  ///< a corner has its number, an edge 8 more

template <class V>
using MaskOf = decltype(V{} < V{});
/// Numbers of corners and edges: in lanes they are numbers like any other.
template <class V>
struct NumberingOf {
    using Index = V;
};
template <>
struct NumberingOf<double> {
    using Index = int;
};
template <class V>
using IndexOf = typename NumberingOf<V>::Index;

template <class V>
struct Plane {
    V x, y;
};
template <class V>
inline Plane<V> operator+(const Plane<V>& a, const Plane<V>& b) {
    return {a.x + b.x, a.y + b.y};
}
template <class V>
inline Plane<V> operator-(const Plane<V>& a, const Plane<V>& b) {
    return {a.x - b.x, a.y - b.y};
}
template <class V>
inline Plane<V> operator-(const Plane<V>& a) {
    return {-a.x, -a.y};
}
template <class V>
inline Plane<V> operator*(const V& s, const Plane<V>& a) {
    return {s * a.x, s * a.y};
}
template <class V>
inline V dot(const Plane<V>& a, const Plane<V>& b) {
    return a.x * b.x + a.y * b.y;
}
template <class V>
inline V cross(const Plane<V>& a, const Plane<V>& b) {
    return a.x * b.y - a.y * b.x;
}
template <class V>
inline Plane<V> perpendicular(const Plane<V>& a) {
    return {-a.y, a.x};
}

inline int select(bool where, int yes, int no) { return where ? yes : no; }
template <class V>
inline Plane<V> select(const MaskOf<V>& where, const Plane<V>& yes, const Plane<V>& no) {
    return {select(where, yes.x, no.x), select(where, yes.y, no.y)};
}
template <class V>
inline V lesser(const V& a, const V& b) {
    return select(b < a, b, a);
}
template <class V>
inline V greater(const V& a, const V& b) {
    return select(a < b, b, a);
}
inline bool no(bool a) { return !a; }
template <class M>
inline M no(const M& a) {
    return ~a;
}
/// Of one pair the one that it asks for is all that is computed.
template <class Yes, class No>
inline auto pick_of(bool where, Yes yes, No no) {
    return where ? yes() : no();
}
template <class M, class Yes, class No>
inline auto pick_of(const M& where, Yes yes, No no) {
    return select(where, yes(), no());
}
template <class And>
inline bool both_of(bool where, And and_where) {
    return where && and_where();
}
template <class M, class And>
inline M both_of(const M& where, And and_where) {
    return where & and_where();
}

inline double absolute(double a) { return __builtin_fabs(a); }
template <class V>
inline V absolute(const V& a) {
    return select(a < 0.0, -a, a);
}

/// One of so many numbers, by its own in each lane.
inline double chosen(const double* from, int, int index) { return from[index]; }
template <class V>
inline V chosen(const V* from, int count, const V& index) {
    V out = from[0];
    for (int k = 1; k < count; ++k) out = select(index == k, from[k], out);
    return out;
}

/// An outline, or one of each pair.
template <class V>
struct OutlineOf {
    const V *x, *y, *normal_x, *normal_y;
    int most;  ///< so many corners there are at the most: behind its own the first ones follow once more
    IndexOf<V> count;
    V radius, width;

    Plane<V> normal(int k) const { return {normal_x[k], normal_y[k]}; }
    Plane<V> normal_at(const IndexOf<V>& k) const { return {chosen(normal_x, most, k), chosen(normal_y, most, k)}; }
    Plane<V> corner_at(const IndexOf<V>& k) const { return {chosen(x, most, k), chosen(y, most, k)}; }
    IndexOf<V> next(const IndexOf<V>& k) const { return select(k + 1 == count, IndexOf<V>{}, k + 1); }
    IndexOf<V> last(const IndexOf<V>& k) const { return select(k == IndexOf<V>{}, count, k) - 1; }
    /// How thick it is where it is thinnest: of two corners the width is their distance, which counts for a segment
    /// only.
    V thickness() const { return select((count > 2) | (radius == 0.0), width, V{}) + 2.0 * radius; }
};

template <class V>
struct EdgeOf {
    IndexOf<V> edge, next;
    Plane<V> start, end;

    EdgeOf(const OutlineOf<V>& p, const IndexOf<V>& k)
        : edge(k), next(p.next(k)), start(p.corner_at(k)), end(p.corner_at(next)) {}
    EdgeOf(const IndexOf<V>& k, const IndexOf<V>& then, const Plane<V>& from, const Plane<V>& to)
        : edge(k), next(then), start(from), end(to) {}
};
template <class V>
inline EdgeOf<V> select(const MaskOf<V>& where, const EdgeOf<V>& yes, const EdgeOf<V>& no) {
    return {select(where, yes.edge, no.edge), select(where, yes.next, no.next), select(where, yes.start, no.start),
            select(where, yes.end, no.end)};
}

/// How far corners lie outside an edge, or several edges N of one outline.
template <class N, class V>
inline N outside(const Plane<N>& normal, const Plane<N>& own, const V* x, const V* y, int count) {
    N lowest = x[0] * normal.x + y[0] * normal.y;
    for (int j = 1; j < count; ++j) {
        const N here = x[j] * normal.x + y[j] * normal.y;
        lowest = select(here < lowest, here, lowest);
    }
    return lowest - (own.x * normal.x + own.y * normal.y);
}

/// The first of those that are largest.
template <class V>
struct FirstOf {
    V value;
    IndexOf<V> index;
};
template <class V>
inline FirstOf<V> first_largest(const V* of, int count) {
    FirstOf<V> best{of[0], IndexOf<V>{}};
    for (int k = 1; k < count; ++k) {
        const auto more = of[k] > best.value;
        best = {select(more, of[k], best.value), select(more, IndexOf<V>{} + k, best.index)};
    }
    return best;
}

/// The edge that faces a direction most.
template <class V>
inline IndexOf<V> edge_facing(const OutlineOf<V>& q, const Plane<V>& direction) {
    FirstOf<V> best{dot(q.normal(0), direction), IndexOf<V>{}};
    for (int k = 1; k < q.most; ++k) {
        const V here = dot(q.normal(k), direction);
        const auto less = here < best.value;
        best = {select(less, here, best.value), select(less, IndexOf<V>{} + k, best.index)};
    }
    return best.index;
}

/// Two square corners within a hair of one another, as where a box slides over the seam of two others of one height.
/// Which of the two sides would hold the other up is noise then, and the contact with the side that the neighbour
/// covers would stop the box: there is none before it is deeper than the hair. Of corners of outlines askew that are
/// farther apart nobody knows whether they will be level when they meet.
template <class V>
inline MaskOf<V> corner_on_corner(const OutlineOf<V>& p, const OutlineOf<V>& q, const V* of_p, const V* of_q,
                                  const Plane<V>& normal, const V& largest) {
    const V hair = 0.005 * lesser(p.thickness(), q.thickness()), radii = p.radius + q.radius;
    const MaskOf<V> is_shallow = no(largest - radii <= -hair), is_near = largest - radii < hair;
    const auto is_straight = [&](const OutlineOf<V>& outline) {
        MaskOf<V> found{};
        for (int k = 0; k < outline.most; ++k)
            found = found | (absolute(dot(outline.normal(k), normal)) < sine_of_same);
        return found;
    };
    const auto crosswise = [&](const OutlineOf<V>& outline, const V* separations) {
        MaskOf<V> found{};
        for (int k = 0; k < outline.most; ++k) {
            const MaskOf<V> is_across = absolute(dot(outline.normal(k), normal)) < 0.5;
            const MaskOf<V> is_level = absolute(separations[k] - radii) < hair;
            found = found | (is_across & is_level);
        }
        return found;
    };
    return both_of(is_shallow, [&] {
        const MaskOf<V> of_p_are = crosswise(p, of_p), of_q_are = crosswise(q, of_q);
        return both_of(MaskOf<V>(of_p_are | of_q_are), [&] {
            const MaskOf<V> p_is = is_straight(p), q_is = is_straight(q);
            return MaskOf<V>(is_near | (p_is & q_is));
        });
    });
}

/// Whether the corner of the other edge that is nearest to the line of the first one lies over it: then nothing else of
/// the other outline is nearer.
template <class V>
inline MaskOf<V> lies_over(const EdgeOf<V>& lead, const EdgeOf<V>& other, const Plane<V>& normal) {
    const Plane<V> along = perpendicular(normal);
    const Plane<V> corner = select(dot(other.end - other.start, normal) < 0.0, other.end, other.start);
    const V foot = dot(corner - lead.start, along), width = dot(lead.end - lead.start, along);
    return (foot > 0.0) & (foot < width);
}

/// The axis of least overlap or largest gap (separating axes: Gottschalk, Lin, Manocha 1996), and the edges that face
/// one another there.
template <class V>
struct Facing {
    MaskOf<V> p_leads;
    V largest, least_width;
    Plane<V> normal;  ///< of the edge that leads
    IndexOf<V> i, j;  ///< edges of p and q

    Facing(const OutlineOf<V>& p, const OutlineOf<V>& q, const FirstOf<V>& of_p, const FirstOf<V>& of_q)
        : largest(greater(of_p.value, of_q.value)), least_width(lesser(p.width, q.width)) {
        const Plane<V> normal_p = p.normal_at(of_p.index), normal_q = q.normal_at(of_q.index);
        // Nearly parallel edges would take turns otherwise. What this neglects is of second order in their angle.
        const MaskOf<V> parallel = dot(normal_p, normal_q) < -cosine_of_same;
        p_leads = of_q.value <= of_p.value + select(parallel, 5e-4 * least_width, V{});
        normal = select(p_leads, normal_p, normal_q);
        const auto face = [&](const OutlineOf<V>& other) { return edge_facing(other, normal); };
        const auto facing = pick_of(
            p_leads, [&] { return face(q); }, [&] { return face(p); });
        i = select(p_leads, of_p.index, facing), j = select(p_leads, facing, of_q.index);
    }
    /// Whether it is clear without the nearest points that an edge is cut to the other one.
    MaskOf<V> is_cut(const EdgeOf<V>& lead, const EdgeOf<V>& other) const {
        const MaskOf<V> overlap = largest <= 1e-9 * least_width;
        return overlap | both_of(no(overlap), [&] { return lies_over(lead, other, normal); });
    }
    /// If a corner is nearest to an edge, the distance is the largest separation.
    MaskOf<V> are_corners_nearest(const MaskOf<V>& corners, const V& squared, const V& hair) const {
        const V beyond = largest * (1 + 1e-9) + hair;
        return corners & (squared > beyond * beyond);
    }
};

/// A point on each of two edges, and what is there.
template <class V>
struct PointOf {
    Plane<V> on_lead, on_other;
    IndexOf<V> feature_lead, feature_other;
};
template <class V>
inline PointOf<V> select(const MaskOf<V>& where, const PointOf<V>& yes, const PointOf<V>& no) {
    return {select(where, yes.on_lead, no.on_lead), select(where, yes.on_other, no.on_other),
            select(where, yes.feature_lead, no.feature_lead), select(where, yes.feature_other, no.feature_other)};
}

/// The part of the other edge that lies over the one that leads: its ends, if there is any.
template <class V>
struct Cut {
    MaskOf<V> is_beside;
    PointOf<V> left, right;

    Cut(const EdgeOf<V>& lead, const EdgeOf<V>& other, const Plane<V>& normal) {
        const Plane<V> along = perpendicular(normal);
        // The other edge runs the other way.
        const MaskOf<V> swapped = dot(other.end - other.start, along) > 0.0;
        const Plane<V> l = select(swapped, other.start, other.end), r = select(swapped, other.end, other.start);
        const Plane<V> step = r - l;
        const V from = dot(l - lead.start, along), to = dot(r - lead.start, along);
        const V width = dot(lead.end - lead.start, along);
        is_beside = (to < 0.0) | (from > width);
        const auto corner = [&](const Plane<V>& c, const IndexOf<V>& k) {
            return PointOf<V>{c - V(dot(c - lead.start, normal)) * normal, c, lead.edge + first_edge_feature, k};
        };
        const auto end = [&](const Plane<V>& c, const IndexOf<V>& k, const V& place) {
            return PointOf<V>{c, l + V((place - from) / (to - from)) * step, k, other.edge + first_edge_feature};
        };
        left = corner(l, select(swapped, other.edge, other.next));
        right = corner(r, select(swapped, other.next, other.edge));
        if (const MaskOf<V> before = from < 0.0; any(before))
            left = select(before, end(lead.start, lead.edge, V{}), left);
        if (const MaskOf<V> beyond = to > width; any(beyond))
            right = select(beyond, end(lead.end, lead.next, width), right);
    }
};

/// A point on each of two outlines, and how far they are from one another.
template <class V>
struct NearestOf {
    Plane<V> on_p, on_q;
    IndexOf<V> feature_p, feature_q;
    V squared;
    MaskOf<V> corners;  ///< both are

    NearestOf turned() const { return {on_q, on_p, feature_q, feature_p, squared, corners}; }
};

/// A corner of q, and the point of p's edge that is nearest to it.
template <class V>
inline NearestOf<V> nearest_on_edge(const Plane<V>& c, const IndexOf<V>& corner, const EdgeOf<V>& p) {
    const Plane<V> along = p.end - p.start;
    const V place = dot(c - p.start, along);
    const MaskOf<V> before = place <= 0.0, after = dot(c - p.end, along) >= 0.0, corners = before | after;
    Plane<V> on = select(before, p.start, p.end);
    IndexOf<V> feature = select(before, p.edge, p.next);
    if (any(no(corners))) {
        on = select(corners, on, p.start + V(place / dot(along, along)) * along);
        feature = select(corners, feature, p.edge + first_edge_feature);
    }
    const Plane<V> d = c - on;
    return {on, c, feature, corner, dot(d, d), corners};
}

/// The nearest points of two edges that do not cross.
template <class V>
inline NearestOf<V> nearest_of_edges(const EdgeOf<V>& p, const EdgeOf<V>& q) {
    NearestOf<V> best = nearest_on_edge(q.start, q.edge, p);
    const auto offer = [&](const NearestOf<V>& other) {
        const MaskOf<V> nearer = other.squared < best.squared;
        best.on_p = select(nearer, other.on_p, best.on_p), best.on_q = select(nearer, other.on_q, best.on_q);
        best.feature_p = select(nearer, other.feature_p, best.feature_p);
        best.feature_q = select(nearer, other.feature_q, best.feature_q);
        best.squared = select(nearer, other.squared, best.squared);
        best.corners = (nearer & other.corners) | (no(nearer) & best.corners);
    };
    offer(nearest_on_edge(q.end, q.next, p));
    offer(nearest_on_edge(p.start, p.edge, q).turned());
    offer(nearest_on_edge(p.end, p.next, q).turned());
    return best;
}

/// Whether an outline's edges beside one, before it and behind it, may be nearer to the other outline, which is in
/// direction d: only those that start out from the nearest corner towards it.
template <class V>
struct OpenWays {
    MaskOf<V> before, behind;

    OpenWays(const OutlineOf<V>& p, const EdgeOf<V>& edge, const IndexOf<V>& feature, const Plane<V>& d) {
        const auto leads_there = [&](const IndexOf<V>& neighbour, const Plane<V>& corner) {
            return MaskOf<V>(dot(p.corner_at(neighbour) - corner, d) > 0.0);
        };
        before = both_of(MaskOf<V>(feature == edge.edge), [&] { return leads_there(p.last(edge.edge), edge.start); });
        behind = both_of(MaskOf<V>(feature == edge.next), [&] { return leads_there(p.next(edge.next), edge.end); });
    }
};

/// The gap of two points of cores seen from their own bodies, less the rounding.
template <class V>
inline V gap_of(const Plane<V>& core_a, const Plane<V>& core_b, const Plane<V>& between, const Plane<V>& normal,
                const V& radius_a, const V& radius_b) {
    return dot(between + core_b - core_a, normal) - radius_a - radius_b;
}
/// Whether of two points the first one is on the left of the normal.
template <class V>
inline MaskOf<V> is_first_left(const Plane<V>& normal, const Plane<V>& first, const Plane<V>& second) {
    return cross(normal, first - second) > 0.0;
}

}  // namespace
}  // namespace carom
