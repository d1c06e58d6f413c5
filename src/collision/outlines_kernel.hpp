#pragma once
// The kernel in collision/outlines.hpp, compiled once for each instruction set.

#include "collision/outlines.hpp"
#include "simd/lanes.hpp"

namespace carom {
namespace {

/// A number that the compiler knows.
template <int number>
struct Known {
    constexpr operator int() const { return number; }
};

}  // namespace
}  // namespace carom

#include "collision/outlines_text.hpp"  // for what there is of lanes so far

namespace carom {
namespace {

/// One outline of each of the pairs from first on.
template <class Most>
struct Gathered {
    Lanes x[8], y[8], normal_x[8], normal_y[8];
    OutlineOf<Lanes> outline;

    Gathered(const double* const* from, const double* corners, const double* radius, const double* width, Most most)
        : outline{x, y, normal_x, normal_y, most, load(corners), load(radius), load(width)} {
        gather(from, corners, 0, x, most), gather(from, corners, 1, y, most);
        gather(from, corners, 2, normal_x, most), gather(from, corners, 3, normal_y, most);
    }
    void move(Lanes2 way, Most most) {
        for (int k = 0; k < most; ++k) x[k] = way.x + x[k], y[k] = way.y + y[k];
    }

  private:
    static void gather(const double* const* from, const double* corners, int which, Lanes* to, Most most) {
        for (int k = 0; k < most; k += 4) {
            const Lanes4 four = quads_at([=](int lane) {
                const bool has_more = most > 4 && corners[lane] > 4;  // else there is room for four, which come again
                return from[lane] + (has_more ? 8 * which + k : 4 * which);
            });
            to[k] = four.x, to[k + 1] = four.y, to[k + 2] = four.z, to[k + 3] = four.w;
        }
    }
};

/// How far q lies outside each edge of p.
template <class Most>
struct EachOutside {
    Lanes of[8];
    FirstOf<Lanes> best;

    EachOutside(const Gathered<Most>& p, const Gathered<Most>& q, Most most) {
        int k = 0;
        do {
            of[k] = outside(p.outline.normal(k), Plane<Lanes>{p.x[k], p.y[k]}, q.x, q.y, most);
        } while (++k < most);
        best = first_largest(of, most);
    }
};

/// A point of the manifolds, where there is one.
struct Point {
    Plane<Lanes> core_a, core_b;
    Lanes gap, id;
};
inline Point select(Mask where, const Point& yes, const Point& no) {
    return {select(where, yes.core_a, no.core_a), select(where, yes.core_b, no.core_b), select(where, yes.gap, no.gap),
            select(where, yes.id, no.id)};
}

/// What all pairs of a group have.
struct Pairs {
    const OutlineOf<Lanes>&a, &b;
    Plane<Lanes> between;
    Lanes margin;
};

struct Manifolds {
    Plane<Lanes> normal{};
    Lanes count{}, corners{};
    Point point[2]{};

    /// Those of the cuts where there are some, with the points that are no farther apart than the margin.
    void take(Mask there, const Cut<Lanes>& cut, const Facing<Lanes>& facing, const Pairs& pairs) {
        normal = select(there, select(facing.p_leads, facing.normal, -facing.normal), Plane<Lanes>{});
        const auto point_of = [&](const PointOf<Lanes>& on) {
            return point_at(select(facing.p_leads, on.on_lead, on.on_other),
                            select(facing.p_leads, on.on_other, on.on_lead),
                            select(facing.p_leads, on.feature_lead, on.feature_other),
                            select(facing.p_leads, on.feature_other, on.feature_lead), normal, pairs);
        };
        Point left = point_of(cut.left), right = point_of(cut.right);
        const Mask none = ~there | cut.is_beside;
        const Mask is_left = ~(none | (left.gap > pairs.margin)), is_right = ~(none | (right.gap > pairs.margin));
        const Mask both = is_left & is_right;
        const Mask first_is_left = is_first_left(normal, left.core_a, right.core_a);
        constexpr double left_side = left_of_two, right_side = right_of_two;
        left.id += select(both, select(first_is_left, all(left_side), all(right_side)), Lanes{});
        right.id += select(both, select(first_is_left, all(right_side), all(left_side)), Lanes{});
        count = select(is_left, all(1), Lanes{}) + select(is_right, all(1), Lanes{});
        point[0] = select(is_left, left, select(is_right, right, Point{})), point[1] = select(both, right, Point{});
    }
    /// Those of nearest points where it is they that count: one each.
    void take(Mask there, const NearestOf<Lanes>& nearest, const Pairs& pairs) {
        const Plane<Lanes> d = nearest.on_q - nearest.on_p;
        const Lanes distance = square_root(dot(d, d));
        normal = select(there, Plane<Lanes>{d.x / distance, d.y / distance}, normal);
        const Point only = point_at(nearest.on_p, nearest.on_q, nearest.feature_p, nearest.feature_q, normal, pairs);
        const Mask is_far = only.gap > pairs.margin;
        corners = select(there & nearest.corners, all(1), Lanes{});
        count = select(there, select(is_far, Lanes{}, all(1)), count);
        point[0] = select(there, select(is_far, Point{}, only), point[0]), point[1] = select(there, Point{}, point[1]);
    }
    /// Numbers are written in the order in which a Manifold has them.
    void write(double* const* to, size_t pairs) const {
        const auto put = [&](size_t first, const Lanes4& four) {
            store_fours_at([=](int lane) { return to[lane] + first; }, four, pairs);
        };
        const Point &p = point[0], &q = point[1];
        const Lanes id = as_integers(q.id), how = as_integers(count + corners * 0x1p32);
        put(0, {normal.x, normal.y, how, p.core_a.x});
        put(4, {p.core_a.y, p.core_b.x, p.core_b.y, p.gap});
        put(8, {as_integers(p.id), q.core_a.x, q.core_a.y, q.core_b.x});
        put(11, {q.core_b.x, q.core_b.y, q.gap, id});
    }

  private:
    static Point point_at(const Plane<Lanes>& on_a, const Plane<Lanes>& on_b, Lanes feature_a, Lanes feature_b,
                          const Plane<Lanes>& normal, const Pairs& pairs) {
        const Plane<Lanes> core_b = on_b - pairs.between;
        return {on_a, core_b, gap_of(on_a, core_b, pairs.between, normal, pairs.a.radius, pairs.b.radius),
                feature_a * 256.0 + feature_b};
    }
};

/// Edges that face one another, and how the outlines touch there.
struct Touching {
    const Pairs& pairs;
    const Facing<Lanes>& facing;
    EdgeOf<Lanes> of_a, of_b;
    Manifolds found;
    Mask alone{};  ///< who has to look at other edges

    Touching(Mask meet, const Pairs& of, const Facing<Lanes>& axis)
        : pairs(of), facing(axis), of_a(of.a, axis.i), of_b(of.b, axis.j) {
        const Mask a_leads = facing.p_leads;
        const EdgeOf<Lanes> lead = select(a_leads, of_a, of_b), other = select(a_leads, of_b, of_a);
        const Mask open = meet & ~facing.is_cut(lead, other);
        const Cut<Lanes> cut(lead, other, facing.normal);
        found.take(meet, cut, facing, pairs);
        if (any(open)) take_nearest(open, cut.is_beside);
    }

  private:
    void take_nearest(Mask open, Mask is_beside) {
        const NearestOf<Lanes> nearest = nearest_of_edges(of_a, of_b);
        const Plane<Lanes> d = nearest.on_q - nearest.on_p;
        const OpenWays<Lanes> ways_a(pairs.a, of_a, nearest.feature_p, d), ways_b(pairs.b, of_b, nearest.feature_q, -d);
        alone = open & (ways_a.before | ways_a.behind | ways_b.before | ways_b.behind);
        const Mask apart = facing.are_corners_nearest(nearest.corners, nearest.squared, Lanes{}) |
                           (is_beside & ~(nearest.squared == Lanes{}));
        found.take(open & ~alone & apart, nearest, pairs);
    }
};

/// As many pairs as there are lanes, from first on.
template <class Most>
inline OutlinesFound cut_group(const OutlinePairs& all_pairs, size_t first, Most most) {
    const size_t number = all_pairs.count - first;
    Gathered<Most> a(all_pairs.a + first, all_pairs.corners_a + first, all_pairs.radius_a + first,
                     all_pairs.width_a + first, most);
    Gathered<Most> b(all_pairs.b + first, all_pairs.corners_b + first, all_pairs.radius_b + first,
                     all_pairs.width_b + first, most);
    const Plane<Lanes> between{load(all_pairs.between_x + first), load(all_pairs.between_y + first)};
    b.move({between.x, between.y}, most);
    const Pairs pairs{a.outline, b.outline, between, load(all_pairs.margin + first)};
    const Lanes reach = pairs.margin + pairs.a.radius + pairs.b.radius;
    const EachOutside<Most> of_a(a, b, most), of_b(b, a, most);
    const Mask is_far = (of_a.best.value > reach) | (of_b.best.value > reach);
    double* const* const to = all_pairs.found + first;
    if (!any(~is_far)) return Manifolds{}.write(to, number), OutlinesFound{};
    const Facing<Lanes> facing(pairs.a, pairs.b, of_a.best, of_b.best);
    const Mask none = is_far | corner_on_corner(pairs.a, pairs.b, of_a.of, of_b.of, facing.normal, facing.largest);
    const Touching touching(~none, pairs, facing);
    touching.found.write(to, number);
    const auto filled = static_cast<uint32_t>((1U << (number < lanes ? number : lanes)) - 1);
    return {static_cast<uint32_t>(bits(touching.found.count > Lanes{})) & filled,
            static_cast<uint32_t>(bits(touching.alone)) & filled};
}

template <class Most>
inline OutlinesFound cut_each(const OutlinePairs& pairs, Most most) {
    OutlinesFound found{};
    for (size_t first = 0; first < pairs.count; first += static_cast<size_t>(lanes)) {
        const OutlinesFound some = cut_group(pairs, first, most);
        found.touch |= some.touch << first, found.alone |= some.alone << first;
    }
    return found;
}

OutlinesFound cut(OutlinePairs& pairs, int most) {
    for (size_t k = pairs.count; k % static_cast<size_t>(lanes) != 0; ++k) pairs.repeat(k);
    if (most <= 4) return cut_each(pairs, Known<4>{});
    return cut_each(pairs, most);
}

}  // namespace
}  // namespace carom
