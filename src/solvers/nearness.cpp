// How near those come to one another whose boxes may meet, if they go on as they do.

#include <algorithm>
#include <cmath>

#include "solvers/candidates.hpp"
#include "solvers/impact.hpp"

namespace carom {

double reach_ahead(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row) {
    if (row >= contacts.asleep.size() || !contacts.asleep[row]) return contacts.reach[row];
    return length(scene.flight.dynamics.gravity()) * contacts.ahead * contacts.ahead;
}

double apart(const Wall& wall, const Aabb& box) {
    const Vec2 nearest{wall.normal.x > 0 ? box.low.x : box.high.x, wall.normal.y > 0 ? box.low.y : box.high.y};
    return dot(wall.normal, nearest) - wall.offset;
}

Twist twist_of(const State& state, std::uint32_t row) {
    return row < state.size() ? Twist{state.v.linear[row], state.v.angular[row]} : Twist{};
}

bool falls(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row) {
    return moves(scene, row) && !contacts.asleep[row];
}

Twist foreseen(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row, double t) {
    const Twist then = twist_of(contacts.from, row);
    if (t == 0 || !falls(scene, contacts, row)) return then;
    return {then.velocity + t * scene.flight.dynamics.gravity(), then.angular_velocity};
}

Twist off_way(const SoftScene& scene, const State& state, const SoftContacts& contacts, std::uint32_t row, double t,
              double h) {
    if (row >= state.size()) return {};
    const auto& [time, x, v, account] = contacts.from;
    const Vec2 gone = state.x.linear[row] - x.linear[row], dv = state.v.linear[row] - v.linear[row];
    const Vec2 fallen = falls(scene, contacts, row) ? (0.5 * t + h) * t * scene.flight.dynamics.gravity() : Vec2{};
    return {gone - t * v.linear[row] + h * dv - fallen,
            state.x.angular[row] - x.angular[row] - t * v.angular[row] + h * (state.v.angular[row] - v.angular[row])};
}

double foreseen_approach(const SoftScene& scene, const SoftContacts& contacts, const Passing& pair, const Twist& s,
                         const Twist& l, double t) {
    const bool fall_together = falls(scene, contacts, pair.small) && falls(scene, contacts, pair.large);
    const double falling = fall_together ? 0 : length(scene.flight.dynamics.gravity()) * t;
    // While the one goes straight on the other one turns under it.
    const double bend = 0.5 * t * std::abs(l.angular_velocity) * length(s.velocity - l.velocity);
    return t * (pair.most(s, l) + falling + bend);
}

namespace {

/// How far apart the boxes of a candidate are, along an axis; less than 0 if they overlap.
double boxes_apart(const SoftScene& scene, const Candidate& c, const SoftContacts& contacts) {
    const Aabb& b = contacts.boxes[c.piece_b];
    if (c.is_at_wall()) return apart(scene.walls.all[c.piece_a], b);
    const Aabb& a = contacts.boxes[c.piece_a];
    return std::max({a.low.x - b.high.x, b.low.x - a.high.x, a.low.y - b.high.y, b.low.y - a.high.y});
}

}  // namespace

double spare_of(const Candidate& c, const SoftContacts& contacts) {
    const double b = contacts.sizes[c.piece_b];
    return speculation * (c.is_at_wall() ? b : std::min(b, contacts.sizes[c.piece_a]));
}

Near nearness(const SoftScene& scene, const State& state, std::uint32_t index, double h, const SoftContacts& contacts) {
    constexpr std::size_t few = 50;  // pieces: to look at all in reach costs little, and each blow is at its instant
    const Candidate& candidate = contacts.candidates[index];
    const PieceTag& b = contacts.tags[candidate.piece_b];
    const bool at_wall = candidate.is_at_wall();
    const std::uint32_t row = at_wall ? static_cast<std::uint32_t>(state.size()) : contacts.tags[candidate.piece_a].row;
    const double reach = reach_ahead(scene, contacts, row) + reach_ahead(scene, contacts, b.row);
    const double spare = spare_of(candidate, contacts);
    const double other =
        at_wall ? scene.walls.all[candidate.piece_a].restitution : contacts.tags[candidate.piece_a].restitution;
    Near near{index, row, b.row, reach + spare, HUGE_VAL};
    const double apart = boxes_apart(scene, candidate, contacts);
    near.is_far = apart > near.margin;
    const bool goes_on = scene.pieces.size() > few && mixed_restitution(scene.bodies, other, b.restitution) <= little;
    if (near.is_far || !goes_on) return near;  // who is out of reach need not be watched
    const Passing pair(contacts, row, b.row);
    const double t = state.time - contacts.from.time;
    const double approach = foreseen_approach(scene, contacts, pair, foreseen(scene, contacts, pair.small, t),
                                              foreseen(scene, contacts, pair.large, t), contacts.ahead - t);
    const double jump = reach * h / contacts.ahead - 0.25 * thickness(candidate, contacts);
    const double margin = std::max(approach + spare, jump);
    if (margin >= near.margin) return near;
    near.margin = margin, near.spare = std::max(margin, apart) - approach, near.span = pair.span();
    if (t > 0)
        near.spare -= pair.most(off_way(scene, state, contacts, pair.small, t, 0),
                                off_way(scene, state, contacts, pair.large, t, 0));
    near.is_far = apart > margin;
    return near;
}

double thickness(const Candidate& c, const SoftContacts& contacts) {
    const double b = contacts.tags[c.piece_b].thickness;
    return c.is_at_wall() ? b : std::min(b, contacts.tags[c.piece_a].thickness);
}

double closing_speed(const State& state, std::uint32_t a, std::uint32_t b, const SoftContacts& contacts) {
    const Passing pair(contacts, a, b);
    return pair.most(twist_of(state, pair.small), twist_of(state, pair.large));
}

}  // namespace carom
