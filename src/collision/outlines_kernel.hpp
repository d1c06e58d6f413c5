#pragma once
// The kernel in collision/outlines.hpp, compiled once for each instruction set.

#include "simd/lanes.hpp"

#include "collision/outlines.hpp"
#include "collision/outlines_text.hpp"

namespace carom {
namespace {

/// A number that the compiler knows.
template <int number>
struct Known {
    constexpr operator int() const { return number; }
};

/// One outline of each of the pairs from first on.
template <class Most>
struct Gathered {
    Lanes x[8], y[8], normal_x[8], normal_y[8];
    OutlineOf<Lanes> outline;

    Gathered(const double* const* from, const double* corners, Most most) {
        const auto gather = [&](size_t member, Lanes* to) {
            for (int k = 0; k < most; k += 4) {
                const Lanes4 four = quads_at([=](int lane) {
                    const size_t further = k == 0 || k < corners[lane] ? static_cast<size_t>(k) : 0;
                    return from[lane] + member / sizeof(double) + further;
                });
                to[k] = four.x, to[k + 1] = four.y, to[k + 2] = four.z, to[k + 3] = four.w;
            }
        };
        gather(offsetof(OutlineNumbers, corner_x), x), gather(offsetof(OutlineNumbers, corner_y), y);
        gather(offsetof(OutlineNumbers, normal_x), normal_x), gather(offsetof(OutlineNumbers, normal_y), normal_y);
        const Lanes4 head = quads_at([=](int lane) { return from[lane]; });
        outline = {x, y, normal_x, normal_y, most, load(corners), head.x, head.y};
    }
    void move(Lanes2 way, Most most) {
        for (int k = 0; k < most; ++k) x[k] = way.x + x[k], y[k] = way.y + y[k];
    }
};

/// How far q lies outside each edge of p.
template <class Most>
struct EachOutside {
    Lanes of[8];
    FirstOf<Lanes> best;

    EachOutside(const Gathered<Most>& p, const Gathered<Most>& q, Most most) {
        for (int k = 0; k < most; ++k)
            of[k] = outside(p.outline.normal(k), Plane<Lanes>{p.x[k], p.y[k]}, q.x, q.y, most);
        best = first_largest(of, most);
    }
};

/// A point of the manifolds, where there is one.
struct Point {
    Plane<Lanes> core_a, core_b;
    Lanes gap, id;
};
inline Point pick(Mask where, const Point& yes, const Point& no) {
    return {pick(where, yes.core_a, no.core_a), pick(where, yes.core_b, no.core_b), pick(where, yes.gap, no.gap),
            pick(where, yes.id, no.id)};
}

struct Manifolds {
    Plane<Lanes> normal{};
    Lanes count{};
    Point point[2]{};

    /// Those of the cuts where there are some, with the points that are no farther apart than the margin.
    void take(Mask there, const Cut<Lanes>& cut, const Facing<Lanes>& facing, const OutlineOf<Lanes>& a,
              const OutlineOf<Lanes>& b, Plane<Lanes> between, Lanes margin) {
        normal = pick(there, pick(facing.p_leads, facing.normal, -facing.normal), Plane<Lanes>{});
        const auto point_of = [&](const PointOf<Lanes>& on) {
            Point p;
            p.core_a = pick(facing.p_leads, on.on_lead, on.on_other);
            p.core_b = pick(facing.p_leads, on.on_other, on.on_lead) - between;
            p.gap = gap_of(p.core_a, p.core_b, between, normal, a.radius, b.radius);
            const Lanes feature_a = pick(facing.p_leads, on.feature_lead, on.feature_other);
            const Lanes feature_b = pick(facing.p_leads, on.feature_other, on.feature_lead);
            p.id = feature_a * 256.0 + feature_b;
            return p;
        };
        Point left = point_of(cut.left), right = point_of(cut.right);
        const Mask none = ~there | cut.is_beside;
        const Mask is_left = ~(none | (left.gap > margin)), is_right = ~(none | (right.gap > margin));
        const Mask both = is_left & is_right;
        const Mask first_is_left = is_first_left(normal, left.core_a, right.core_a);
        constexpr double left_side = 0x10000, right_side = 0x20000;
        left.id += pick(both, pick(first_is_left, all(left_side), all(right_side)), Lanes{});
        right.id += pick(both, pick(first_is_left, all(right_side), all(left_side)), Lanes{});
        count = pick(is_left, all(1), Lanes{}) + pick(is_right, all(1), Lanes{});
        point[0] = pick(is_left, left, pick(is_right, right, Point{})), point[1] = pick(both, right, Point{});
    }
    /// Numbers are written in the order in which a Manifold has them.
    void write(double* const* to, size_t pairs) const {
        const auto put = [&](size_t first, const Lanes4& four) {
            store_fours_at([=](int lane) { return to[lane] + first; }, four, pairs);
        };
        const Point &p = point[0], &q = point[1];
        const Lanes id = as_integers(q.id);
        put(0, {normal.x, normal.y, as_integers(count), p.core_a.x});
        put(4, {p.core_a.y, p.core_b.x, p.core_b.y, p.gap});
        put(8, {as_integers(p.id), q.core_a.x, q.core_a.y, q.core_b.x});
        put(11, {q.core_b.x, q.core_b.y, q.gap, id});
    }
};

/// As many pairs as there are lanes, from first on.
template <class Most>
inline OutlinesFound cut_group(const OutlinePairs& pairs, size_t first, Most most) {
    const size_t number = pairs.count - first;
    Gathered<Most> a(pairs.a + first, pairs.corners_a + first, most);
    Gathered<Most> b(pairs.b + first, pairs.corners_b + first, most);
    const Plane<Lanes> between{load(pairs.between_x + first), load(pairs.between_y + first)};
    b.move({between.x, between.y}, most);
    const OutlineOf<Lanes>&p = a.outline, &q = b.outline;
    const Lanes margin = load(pairs.margin + first), reach = margin + p.radius + q.radius;
    const EachOutside<Most> of_p(a, b, most), of_q(b, a, most);
    const Mask is_far = (of_p.best.value > reach) | (of_q.best.value > reach);
    Manifolds found;
    Mask there{}, alone{};
    if (any(~is_far)) {
        const Facing<Lanes> facing(p, q, of_p.best, of_q.best);
        const Mask meet = ~(is_far | corner_on_corner(p, q, of_p.of, of_q.of, facing.normal, facing.largest));
        const EdgeOf<Lanes> of_a(p, facing.i), of_b(q, facing.j);
        const EdgeOf<Lanes> lead = pick(facing.p_leads, of_a, of_b), other = pick(facing.p_leads, of_b, of_a);
        const Mask is_cut = facing.is_cut(lead, other);
        there = meet & is_cut, alone = meet & ~is_cut;
        found.take(there, Cut<Lanes>(lead, other, facing.normal), facing, p, q, between, margin);
    }
    found.write(pairs.found + first, number);
    const uint32_t filled = number < static_cast<size_t>(lanes) ? (1U << number) - 1 : (1U << lanes) - 1;
    return {static_cast<uint32_t>(bits(found.count > Lanes{})) & filled, static_cast<uint32_t>(bits(alone)) & filled};
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
