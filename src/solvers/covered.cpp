#include "solvers/covered.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "solvers/candidates.hpp"
#include "solvers/impact.hpp"
#include "solvers/shared.hpp"

namespace carom {

bool turns(const Encounter& c, const State& state, double dt) {
    constexpr double hair = 0.01;  // rad
    if (!rounds_a_corner(c.manifold, c.radius_a, c.radius_b)) return false;
    const ManifoldPoint& p = c.manifold.point[0];
    const Vec2 v = velocity_at(state, c.b, p.core_b) - velocity_at(state, c.a, p.core_a);
    return dt * std::abs(cross(c.manifold.normal, v)) > hair * (p.gap + c.radius_a + c.radius_b);
}

bool is_fast(const State& state, double h, std::uint32_t a, std::uint32_t b, double thickness,
             const SoftContacts& contacts) {
    return h * closing_speed(state, a, b, contacts) > 0.25 * thickness;
}

namespace {

/// Whether a list in the order of its keys has one of the two bodies of a candidate and of the chain that it is at.
template <class Listed, class KeyOf>
bool has_at_chain(const SoftScene& scene, const Candidate& candidate, const std::vector<Listed>& list,
                  const KeyOf& key_of) {
    const ContactKey& key = candidate.key;
    const bool of_b = scene.pieces[candidate.piece_b].outline.one_sided;
    const std::uint32_t place = of_b ? candidate.piece_b : candidate.piece_a;
    const Piece& piece = scene.pieces[place];
    const auto is_of_chain = [&](const ContactKey& listed) {
        const std::size_t other = place - piece.number + (of_b ? listed.piece_b : listed.piece_a);
        return other < scene.pieces.size() && scene.pieces[other].row == piece.row &&
               scene.pieces[other].shape == piece.shape;
    };
    const auto is_before = [&](const Listed& l, const ContactKey& k) { return key_of(l) < k; };
    auto it = std::lower_bound(list.begin(), list.end(), ContactKey{key.a, key.b}, is_before);
    for (; it != list.end() && key_of(*it).a == key.a && key_of(*it).b == key.b; ++it)
        if (is_of_chain(key_of(*it))) return true;
    return false;
}

/// Whether a piece is one of those that may be left out where somebody goes past so many of them: hardly bent, of which
/// one in a few is enough to keep him off the others.
bool is_spare(const Piece& piece, double way) {
    constexpr double most = 20,
                     turn = 0.02;  // [rad] of all that are left out in a row: not a hundredth of their length
    const Convex& outline = piece.outline;
    const double stride = std::min(way / (most * outline.width), 1e6);
    if (!(stride >= 2) || piece.number % static_cast<std::uint32_t>(stride) == 0) return false;
    const auto bend = [&](Vec2 other) { return std::abs(cross(outline.normal[0], other)); };
    return stride * (bend(outline.previous_normal) + bend(outline.next_normal)) <= turn;
}

/// A piece of a chain, and somebody who is over its line or beside that.
struct OverLine {
    const Convex& line;
    std::uint32_t chain, other;  ///< rows
    std::uint32_t piece, others_piece;
    Vec2 between;  ///< from the chain's position to the other one's
    double radius;

    OverLine(const SoftScene& scene, const Near& near, const SoftContacts& contacts)
        : OverLine(scene, near, contacts.search.candidates[near.candidate], contacts) {}

    /// Of a point of his core, seen from his position; in a substep of h [s].
    struct Point {
        double gap;                       ///< of his rim above the line or its prolongation [m]
        double before_start, behind_end;  ///< by so much it is not over the line [m], if that is more than 0
        double way, nearer;               ///< how far it may get, in any direction; and how much nearer as it goes [m]
    };
    Point at(Vec2 core, const State& state, double h, const SoftContacts& contacts) const {
        constexpr double ample = 1.1;  // forces may make it faster
        const Frame& frame = contacts.motion.frames[chain];
        const Vec2 along = -perpendicular(line.normal[0]), there = frame.turn_back(between + core);
        const Vec2 v = velocity_at(state, other, core) - velocity_at(state, chain, between + core);
        return {dot(there - line.corner[0], line.normal[0]) - radius, dot(line.corner[1] - there, along),
                dot(there - line.corner[0], along), ample * h * length(v),
                -ample * h * dot(v, frame.turn(line.normal[0]))};
    }

  private:
    OverLine(const SoftScene& scene, const Near& near, const Candidate& c, const SoftContacts& contacts)
        : OverLine(scene, near, c, contacts.pieces.tags[c.piece_b].is_of_chain, contacts) {}
    OverLine(const SoftScene& scene, const Near& near, const Candidate& c, bool of_b, const SoftContacts& contacts)
        : line(scene.pieces[of_b ? c.piece_b : c.piece_a].outline),
          chain(of_b ? near.b : near.a),
          other(of_b ? near.a : near.b),
          piece(of_b ? c.piece_b : c.piece_a),
          others_piece(of_b ? c.piece_a : c.piece_b),
          between(contacts.motion.frames[other].position - contacts.motion.frames[chain].position),
          radius(contacts.pieces.tags[others_piece].radius + line.radius) {}
};

}  // namespace

bool may_come(const SoftScene& scene, const State& state, double h, const Near& near, const Manifold& m,
              const SoftContacts& contacts) {
    if (!m.beside) return true;
    const OverLine over(scene, near, contacts);
    const Vec2 between = contacts.motion.frames[near.b].position - contacts.motion.frames[near.a].position;
    const Vec2 core = over.other == near.b ? m.point[0].core_b : core_a_of(false, m, 0, between);
    const OverLine::Point at = over.at(core, state, h, contacts);
    const double beyond = std::max(at.before_start - over.line.previous_length, at.behind_end - over.line.next_length);
    if (beyond <= 0) return true;  // over the next one
    return at.nearer > 0 && at.gap <= at.nearer && beyond <= at.way && !is_spare(scene.pieces[over.piece], at.way);
}

bool may_land_on(const SoftScene& scene, const State& state, double h, const Near& near, const SoftContacts& contacts) {
    constexpr double hair = 1e-3;  // of the smaller one's size
    const Candidate& candidate = contacts.search.candidates[near.candidate];
    if (is_fast(state, h, near.a, near.b, thickness(candidate, contacts.pieces), contacts)) return true;
    const OverLine over(scene, near, contacts);
    const Convex& outline = scene.pieces[over.others_piece].outline;
    const double low = hair * size_of(candidate, contacts.pieces);
    for (int i = 0; i < outline.count; ++i) {
        const Vec2 core = contacts.motion.frames[over.other].turn(outline.corner[i]);
        const OverLine::Point at = over.at(core, state, h, contacts);
        const double most = at.gap > low ? at.way : at.nearer;
        if (most > low && at.gap <= most && std::max(at.before_start, at.behind_end) <= at.way) return true;
    }
    return false;
}

FromBehind comes_from_behind(const SoftScene& scene, const State& state, const Near& near, const Manifold& manifold,
                             const SoftContacts& contacts) {
    constexpr double hair = 1e-9;  // of the size
    const Candidate& candidate = contacts.search.candidates[near.candidate];
    if (candidate.is_at_wall() || !is_at_chain(candidate, contacts.pieces)) return FromBehind::no;
    const Encounter c(near, manifold, contacts);
    const double gap = least_gap(manifold);
    if (gap >= -hair * c.size) return FromBehind::no;
    const auto was_put_there = [&](std::uint32_t row) { return moves(scene, row) && contacts.rest.was_put_down(row); };
    if (was_put_there(c.a) || was_put_there(c.b)) return FromBehind::no;
    const auto key_of = [](const auto& warm) -> const ContactKey& { return warm.key; };
    if (has_at_chain(scene, candidate, contacts.warm, key_of)) return FromBehind::no;
    const bool passes = has_at_chain(scene, candidate, contacts.passing, std::identity{});
    if (passes || gap < -(contacts.outlook.reach[c.a] + contacts.outlook.reach[c.b] + speculation * c.size))
        return FromBehind::until_out;
    const Vec2 between = contacts.motion.frames[c.b].position - contacts.motion.frames[c.a].position;
    const Vec2 on_a = core_a_of(false, manifold, 0, between), on_b = manifold.point[0].core_b;
    const double parts = dot(velocity_at(state, c.b, on_b) - velocity_at(state, c.a, on_a), manifold.normal);
    if (!(parts > 0)) return FromBehind::no;
    // His middle has just come across, if he is not deep: who rebounds as slowly as that was in front.
    const double thick = c.least_thickness < HUGE_VAL ? 0.25 * c.least_thickness : 0;
    return contacts.outlook.ahead * parts - gap >= thick ? FromBehind::now : FromBehind::no;
}

namespace {

/// A body in one of its meetings: of its two the one called b, or the one called a.
struct OneSide {
    Encounter meeting;
    bool of_b;

    std::uint32_t row() const { return of_b ? meeting.b : meeting.a; }
    std::uint32_t piece() const { return of_b ? meeting.piece_b : meeting.piece_a; }
    /// Away from the other one.
    Vec2 up() const { return (of_b ? 1 : -1) * meeting.manifold.normal; }
    /// How high the other one reaches at its nearest point, from where the body is.
    double height(Vec2 up, const SoftContacts& contacts) const {
        return of_b ? dot(core_a(contacts) - between(contacts), up) + meeting.radius_a
                    : dot(between(contacts) + meeting.manifold.point[0].core_b, up) + meeting.radius_b;
    }
    /// How that point of the other one moves.
    Vec2 velocity(const State& state, const SoftContacts& contacts) const {
        return of_b ? velocity_at(state, meeting.a, core_a(contacts))
                    : velocity_at(state, meeting.b, meeting.manifold.point[0].core_b);
    }

  private:
    Vec2 between(const SoftContacts& contacts) const {
        return contacts.motion.frames[meeting.b].position - contacts.motion.frames[meeting.a].position;
    }
    Vec2 core_a(const SoftContacts& contacts) const {
        return core_a_of(meeting.at_wall, meeting.manifold, 0, between(contacts));
    }
};

/// How low a piece reaches, from where its body is.
double lowest(const Placed& piece, Vec2 up) {
    double low = dot(piece.corner(0), up);
    for (int i = 1; i < piece.count; ++i) low = std::min(low, dot(piece.corner(i), up));
    return low - piece.radius;
}

}  // namespace

void drop_covered(const SoftScene& scene, const State& state, double h, const SoftContacts& contacts,
                  Scratch<std::uint32_t>& touching) {
    constexpr double hair = 1e-3;  // of the smaller one's size
    constexpr std::uint32_t none = 0xffffffff;
    const auto meeting = [&](std::uint32_t k) {
        return Encounter(contacts.search.near[k], contacts.search.manifolds[k], contacts);
    };
    const Scratch<std::uint32_t> turning = those_of(scene.threads, touching, [&](std::uint32_t k) {
        const Manifold& m = contacts.search.manifolds[k];
        return m.corners && !m.past_neighbours && turns(meeting(k), state, contacts.outlook.ahead);
    });
    if (turning.empty()) return;
    Scratch<std::uint32_t> first(scene.bodies.size() + 1, none), next(2 * touching.size(), none);
    const auto side = [&](std::uint32_t k) { return OneSide{meeting(touching[k / 2]), k % 2 != 0}; };
    for (std::uint32_t k = 0; k < next.size(); ++k) {
        const Near& near = contacts.search.near[touching[k / 2]];
        if (!contacts.search.manifolds[touching[k / 2]].corners)
            next[k] = std::exchange(first[k % 2 != 0 ? near.b : near.a], k);
    }
    // What a body stands on keeps off the others none of its pieces that reaches lower than the one that stands there.
    const auto stands_out = [&](std::uint32_t piece, std::uint32_t standing, Vec2 up, double by) {
        return piece != standing &&
               lowest(contacts.pieces.placed[piece], up) < lowest(contacts.pieces.placed[standing], up) - by;
    };
    // Who flies at the body from behind the plane is no seam in it, and is not to be far in when he is next looked at.
    const auto flies_out = [&](const OneSide& corner, const OneSide& standing) {
        const Vec2 leaves = corner.velocity(state, contacts) - standing.velocity(state, contacts);
        return contacts.outlook.ahead * dot(leaves, standing.up()) > 0.25 * corner.meeting.least_thickness;
    };
    const auto is_below = [&](const OneSide& corner, std::uint32_t k) {
        const OneSide standing = side(k);
        const Encounter& on = standing.meeting;
        const Vec2 up = standing.up();
        const double little_way = hair * corner.meeting.size;
        return corner.height(up, contacts) - standing.height(up, contacts) <= little_way &&
               !flies_out(corner, standing) && !stands_out(corner.piece(), standing.piece(), up, little_way) &&
               !is_fast(state, h, on.a, on.b, on.least_thickness, contacts);
    };
    const auto is_covered = [&](const OneSide& corner) {
        if (!moves(scene, corner.row())) return false;
        for (std::uint32_t k = first[corner.row()]; k != none; k = next[k])
            if (is_below(corner, k)) return true;
        return false;
    };
    const Scratch<std::uint32_t> covered = those_of(scene.threads, turning, [&](std::uint32_t k) {
        return is_covered({meeting(k), false}) || is_covered({meeting(k), true});
    });
    auto next_covered = covered.begin();  // both are in order
    std::erase_if(touching, [&](std::uint32_t k) {
        const bool goes = next_covered != covered.end() && *next_covered == k;
        next_covered += goes;
        return goes;
    });
}

}  // namespace carom
