#include "collision/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "collision/nearest.hpp"
#include "collision/outlines_alone.hpp"

namespace carom {

namespace {

/// Where outline p meets outline q; the normal is from p to q. It is written where it is to be read, number by number:
/// who copies it as a whole right away waits.
struct Touch {
    Vec2 normal{};
    int count = 0;
    bool corners = false, beside = false;
    bool is_flipped = false;  ///< points are of q and p
    TouchPoint point[2];

    void add(Vec2 on_p, Vec2 on_q, std::uint32_t feature_p, std::uint32_t feature_q) {
        TouchPoint& p = point[count++];
        p.on_p = on_p, p.on_q = on_q, p.feature_p = feature_p, p.feature_q = feature_q;
    }
    /// What was found is of the two the other way round.
    void flip() { normal = -normal, is_flipped = !is_flipped; }
};

/// Who has a contact at a piece of a chain whose normal is not the piece's own.
enum class Owner { piece, neighbour, nobody };

/// The ends of a piece. Of two pieces that meet in a convex corner the first one has the normals between theirs.
struct Ends {
    Vec2 normal, along;  ///< along the chain's way
    bool has_previous, has_next;
    Vec2 along_previous, along_next;
    double previous_reach, next_reach;

    Ends(const Convex& piece, const Frame& at)
        : normal(at.turn(piece.normal[0])),
          along(-perpendicular(normal)),
          has_previous(piece.has_previous),
          has_next(piece.has_next),
          along_previous(-perpendicular(at.turn(piece.previous_normal))),
          along_next(-perpendicular(at.turn(piece.next_normal))),
          previous_reach(piece.previous_reach),
          next_reach(piece.next_reach) {}

    /// More than 0 at a concave corner.
    double bend(bool at_start) const { return at_start ? cross(along_previous, along) : cross(along, along_next); }

    /// Of a direction of length 1.
    Owner owner(Vec2 direction) const {
        const bool at_start = dot(direction, along) <= 0;
        if (at_start ? !has_previous : !has_next) return dot(direction, normal) > 0 ? Owner::piece : Owner::nobody;
        if (bend(at_start) > 0) return Owner::nobody;  // a concave corner has no normals
        if (at_start) return dot(direction, along_previous) > -sine_of_same ? Owner::neighbour : Owner::nobody;
        const double over_next = dot(direction, along_next);
        return over_next < 0 ? Owner::piece : over_next < sine_of_same ? Owner::neighbour : Owner::nobody;
    }
    /// Whether what is this far beyond an end comes to the piece if it goes on along the chain, and by no more than
    /// the margin [m]: behind a concave corner a piece bounds the room over its neighbours, too, as far as they bend
    /// on.
    bool comes(Vec2 direction, double margin) const {
        const double way = dot(direction, along);
        return std::abs(way) <= std::min(margin, way <= 0 ? previous_reach : next_reach);
    }
    /// The owner, where q can touch a neighbour only if it reaches beyond the end that they share, and the first piece
    /// has nothing of whom it has behind it, though he lies on the corner.
    Owner owner(Vec2 direction, const Placed& p, const Placed& q) const {
        const Owner its = owner(direction);
        if (its != Owner::neighbour) return its;
        const bool at_start = dot(direction, along) <= 0;
        const Vec2 end = p.corner(at_start), beyond = at_start ? -along_previous : along_next;
        if (at_start && cross(along_previous, q.centre - end) < 0) return Owner::piece;
        for (int i = 0; i < q.count; ++i)
            if (dot(q.corner(i) - end, beyond) > 0) return Owner::neighbour;
        return Owner::nobody;
    }
};

void corner_against_corner(const Placed& p, const Placed& q, Touch& touch) {
    const Vec2 d = q.corner(0) - p.corner(0);
    const double distance = length(d);
    touch.normal = distance > 0 ? d / distance : Vec2{0, 1};
    touch.corners = true;
    touch.add(p.corner(0), q.corner(0), corner_feature(0), corner_feature(0));
}

/// A single corner q near an outline p of several: the edge of largest separation bounds the Voronoi region that q is
/// in, or is the edge through which it is shortest out.
void outline_against_corner(const Placed& p, const Placed& q, const std::optional<Ends>& ends, double margin,
                            Touch& touch) {
    const Vec2 c = q.corner(0);
    int edge = 0;
    double farthest = dot(c - p.corner(0), p.normal(0));
    for (int i = 1; i < p.count && !ends; ++i) {
        const double separation = dot(c - p.corner(i), p.normal(i));
        if (separation > farthest) farthest = separation, edge = i;
    }
    const Vec2 along = perpendicular(p.normal(edge));
    const int from = edge, to = p.next(edge);
    const bool before = dot(c - p.corner(from), along)<0, after = dot(c - p.corner(to), along)> 0;
    const int corner = before ? from : to;
    const Vec2 d = c - p.corner(corner);
    const bool is_beside = before || after, comes = is_beside && ends && ends->comes(d, margin);
    if (is_beside && !comes && (farthest > 0 || p.count == 2)) {
        touch.normal = d / length(d);
        if (ends && ends->owner(touch.normal) != Owner::piece) return;
        touch.corners = true;
        touch.add(p.corner(corner), c, corner_feature(corner), corner_feature(0));
    } else if (!ends || farthest >= 0) {
        touch.normal = p.normal(edge), touch.beside = comes;
        touch.add(c - farthest * touch.normal, c, edge_feature(edge), corner_feature(0));
    }
}

/// The part of q's edge that lies over p's, along p's normal: its ends.
void clip(const EdgeOf<double>& p, const EdgeOf<double>& q, const Plane<double>& normal, Touch& touch) {
    touch.normal = vector(normal);
    const Cut<double> cut(p, q, normal);
    if (cut.is_beside) return;
    for (const PointOf<double>& at : {cut.left, cut.right})
        touch.add(vector(at.on_lead), vector(at.on_other), static_cast<std::uint32_t>(at.feature_lead),
                  static_cast<std::uint32_t>(at.feature_other));
}

void single(const Nearest& nearest, Touch& touch) {
    const auto& [on_p, on_q, feature_p, feature_q] = nearest.point;
    const Vec2 d = on_q - on_p;
    touch = {};
    touch.normal = d / length(d);
    touch.corners = nearest.corners;
    touch.add(on_p, on_q, feature_p, feature_q);
}

/// The axis of least overlap or largest gap, then the nearest corners if the outlines are apart and it is corners that
/// are nearest, else an edge of one cut to the other's.
void outline_against_outline(const Placed& placed_p, const Placed& placed_q, double margin, Touch& touch) {
    const double reach = margin + placed_p.radius + placed_q.radius;
    const Separations of_p(placed_p, placed_q);
    if (of_p.best.value > reach) return;
    const Separations of_q(placed_q, placed_p);
    if (of_q.best.value > reach) return;
    const OutlineOf<double> p = outline_of(placed_p), q = outline_of(placed_q);
    const Facing<double> facing(p, q, of_p.best, of_q.best);
    if (corner_on_corner(p, q, of_p.of, of_q.of, facing.normal, facing.largest)) return;
    const EdgeOf<double> edge_p(p, facing.i), edge_q(q, facing.j);
    const EdgeOf<double>&lead = facing.p_leads ? edge_p : edge_q, &other = facing.p_leads ? edge_q : edge_p;
    const auto cut = [&] {
        clip(lead, other, facing.normal, touch);
        if (!facing.p_leads) touch.flip();
    };
    const bool lines = p.count == 2 && q.count == 2;
    if (!lines && facing.is_cut(lead, other)) return cut();
    const Nearest nearest = nearest_points(placed_p, facing.i, placed_q, facing.j);
    const double hair = lines ? 1e-9 * facing.least_width : 0;
    if (facing.are_corners_nearest(nearest.corners, nearest.squared, hair)) return single(nearest, touch);
    cut();
    if (touch.count == 0 && nearest.squared != 0) single(nearest, touch);
}

/// What is straight, and goes on over a concave corner at which the chain hardly bends, does not touch there: it comes
/// to the next line with its own end first. Where the chain bends more, an end that is past the corner may be behind
/// it.
void drop_concave_ends(const Placed& p, const Placed& q, int edge, const Ends& ends, Touch& touch) {
    constexpr double hardly = 0.1;  // rad
    const Vec2 one = q.corner(edge), other = q.corner(q.next(edge));
    const auto goes_on = [&](const TouchPoint& t) {
        const bool at_end = t.feature_p == corner_feature(0), at_start = t.feature_p == corner_feature(1);
        const bool is_concave = (at_end && ends.next_reach > 0) || (at_start && ends.previous_reach > 0);
        if (!is_concave || ends.bend(at_start) > hardly) return false;
        const Vec2 out = at_end ? ends.along : -ends.along, over = at_end ? ends.along_next : -ends.along_previous;
        const Vec2 far = dot(other - one, out) > 0 ? other : one;
        return dot(far - p.corner(at_end ? 0 : 1), over) > 0;
    };
    if (touch.count == 2 && goes_on(touch.point[1])) --touch.count;
    if (touch.count > 0 && goes_on(touch.point[0])) touch.point[0] = touch.point[1], --touch.count;
}

/// The corner of q that is nearest to a piece's line, if it is over its neighbours and may come to it along them.
void corner_over_neighbours(const Placed& p, const Placed& q, const Ends& ends, double margin, Touch& touch) {
    int nearest = 0;
    for (int i = 1; i < q.count; ++i)
        if (dot(q.corner(i) - q.corner(nearest), ends.normal) < 0) nearest = i;
    const Vec2 c = q.corner(nearest), of_start = c - p.corner(1), of_end = c - p.corner(0);
    const bool is_ahead = dot(of_end, ends.along) > 0;
    if (!(is_ahead || dot(of_start, ends.along) < 0) || !ends.comes(is_ahead ? of_end : of_start, margin)) return;
    touch.normal = ends.normal, touch.beside = true;
    touch.add(c - dot(of_end, ends.normal) * ends.normal, c, edge_feature(0), corner_feature(nearest));
}

/// A piece of a chain against an outline of several corners.
void piece_against_outline(const Placed& p, const Placed& q, const Ends& ends, double margin, Touch& touch) {
    if (dot(q.centre - p.corner(0), ends.normal) < 0) return;
    const Separations of_p(p, q), of_q(q, p);
    double largest = of_p.of[0];
    if (largest > margin + p.radius + q.radius) return;
    int facing = -1;  // an edge of q with a better axis
    Owner owner = Owner::piece;
    for (int j = 0; j < q.count; ++j) {
        // What lies nearly flat on the piece is held by it all along.
        if (of_q.of[j] <= largest || dot(q.normal(j), ends.normal) < -cosine_of_same) continue;
        const Owner its = ends.owner(-q.normal(j), p, q);
        if (its != Owner::nobody) largest = of_q.of[j], facing = j, owner = its;
    }
    if (owner == Owner::neighbour) return;
    const int j = facing >= 0 ? facing : edge_facing(q, ends.normal);
    if (largest > 1e-9 * std::min(p.width, q.width)) {
        const Nearest nearest = nearest_points(p, 0, q, j);
        const double beyond = largest * (1 + 1e-9);
        if (nearest.corners && nearest.squared > beyond * beyond) {
            Touch of_corners;
            single(nearest, of_corners);
            owner = ends.owner(of_corners.normal, p, q);
            if (owner == Owner::piece) touch = of_corners;
            if (owner != Owner::nobody) return;
        }
    }
    const EdgeOf<double> edge_p(outline_of(p), 0), edge_q(outline_of(q), j);
    if (facing < 0) {
        clip(edge_p, edge_q, plane(p.normal(0)), touch);
        drop_concave_ends(p, q, j, ends, touch);
        if (touch.count == 0) corner_over_neighbours(p, q, ends, margin, touch);
        return;
    }
    clip(edge_q, edge_p, plane(q.normal(j)), touch);
    touch.flip();
}

void find_touch(const Placed& p, const Placed& q, const std::optional<Ends>& ends, double margin, Touch& touch) {
    if (q.count == 1)
        return p.count == 1 ? corner_against_corner(p, q, touch) : outline_against_corner(p, q, ends, margin, touch);
    ends ? piece_against_outline(p, q, *ends, margin, touch) : outline_against_outline(p, q, margin, touch);
}

}  // namespace

Manifold manifold(const Convex& a, const Frame& frame_a, const Convex& b, const Frame& frame_b, Vec2 between,
                  double margin) {
    return manifold({a, frame_a, Placed(a, frame_a, {})}, {b, frame_b, Placed(b, frame_b, between)}, between, margin);
}

Manifold manifold(const PlacedConvex& of_a, const PlacedConvex& of_b, Vec2 between, double margin) {
    const auto& [a, frame_a, at_a] = of_a;
    const auto& [b, frame_b, at_b] = of_b;
    const bool b_leads = (at_b.one_sided && !at_a.one_sided) || (at_a.count == 1 && at_b.count > 1);
    std::optional<Ends> ends;
    if (at_a.one_sided || at_b.one_sided) ends.emplace(b_leads ? b : a, b_leads ? frame_b : frame_a);
    Touch touch;
    b_leads ? find_touch(at_b, at_a, ends, margin, touch) : find_touch(at_a, at_b, ends, margin, touch);
    if (b_leads) touch.flip();
    Manifold found;
    found.normal = touch.normal, found.corners = touch.corners, found.beside = touch.beside;
    for (int k = 0; k < touch.count; ++k) {
        const auto& [on_p, on_q, feature_p, feature_q] = touch.point[k];
        const Vec2 core_a = touch.is_flipped ? on_q : on_p, core_b = (touch.is_flipped ? on_p : on_q) - between;
        const double gap =
            gap_of(plane(core_a), plane(core_b), plane(between), plane(found.normal), at_a.radius, at_b.radius);
        if (gap > margin) continue;
        ManifoldPoint& point = found.point[found.count++];
        point.core_a = core_a, point.core_b = core_b, point.gap = gap;
        point.id = touch.is_flipped ? feature_q << 8 | feature_p : feature_p << 8 | feature_q;
    }
    if (found.count == 2) {
        const bool first_is_left =
            is_first_left(plane(found.normal), plane(found.point[0].core_a), plane(found.point[1].core_a));
        found.point[0].id |= first_is_left ? ManifoldPoint::left : ManifoldPoint::right;
        found.point[1].id |= first_is_left ? ManifoldPoint::right : ManifoldPoint::left;
    }
    return found;
}

/// At the ends of the edge that faces the wall most: of what is thin the two lowest corners may be those of its short
/// end until it lies flat.
Manifold manifold(const Wall& wall, const Convex& b, const Frame& frame_b, double margin) {
    const double above = dot(wall.normal, frame_b.position) - wall.offset;
    const Placed at_b(b, frame_b, {});
    const int edge = edge_facing(at_b, wall.normal), next = at_b.next(edge);
    Manifold found;
    found.normal = wall.normal;
    const auto add = [&](int i) {
        const Vec2 corner = at_b.corner(i);
        const double height = above + dot(wall.normal, corner);
        if (height - b.radius > margin) return;
        found.point[found.count++] = {corner - height * wall.normal, corner, height - b.radius,
                                      static_cast<std::uint32_t>(i)};
    };
    add(std::min(edge, next));
    if (next != edge) add(std::max(edge, next));
    return found;
}

}  // namespace carom
