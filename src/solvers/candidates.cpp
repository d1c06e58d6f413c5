// Which pieces may meet: whose boxes are near one another, and of those who move towards one another.

#include <algorithm>
#include <cmath>

#include "solvers/impact.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/soft_step.hpp"
#include "threads/parallel.hpp"

namespace carom {

namespace {

/// How far a body may get in dt: with what speed it has and gravity gives it, and by turning.
double reach_of(std::size_t row, const SoftScene& scene, const State& state, double extent, double dt) {
    const double speed = length(state.v.linear[row]) + std::abs(state.v.angular[row]) * extent;
    const double fall = scene.bodies.inverse_mass[row] == 0 ? 0 : length(scene.flight.dynamics.gravity()) * dt;
    return (speed + fall) * dt;
}

/// Calls act(piece) for all that may not be as the last search left them.
template <class Act>
void each_piece_looked_at(const SoftScene& scene, const SoftContacts& contacts, const Act& act) {
    if (contacts.knows_resting)
        for (const std::uint32_t i : contacts.awake_pieces) act(i);
    else
        for (std::uint32_t i = 0; i < scene.pieces.size(); ++i) act(i);
}

/// For how long to look ahead: to the end of a step, in dt [s]; or where all move fast, on average, to the end of the
/// substep of h, for pairs grow in number with the square of how far all may get.
double time_ahead(const SoftScene& scene, const State& state, double dt, double h, const SoftContacts& contacts) {
    constexpr double far = 1;  // of its size
    double reach = 0, size = contacts.knows_resting ? contacts.rest_size : 0;
    each_row_looked_at(contacts, [&](std::size_t i) {
        if (contacts.extent[i] == 0 || contacts.asleep[i]) return;
        reach += reach_of(i, scene, state, contacts.extent[i], dt);
        size += 2 * contacts.extent[i];
    });
    return reach > far * size ? std::min(dt, h) : dt;
}

/// The box of a piece where it is.
void bound_piece(const SoftScene& scene, std::uint32_t i, SoftContacts& contacts) {
    const Piece& piece = scene.pieces[i];
    const Aabb& box = contacts.boxes[i] = bounds(piece.outline, contacts.frames[piece.row]);
    contacts.sizes[i] = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

/// The boxes of all pieces, and how far bodies stretch.
void bound_pieces(const SoftScene& scene, SoftContacts& contacts) {
    contacts.boxes.resize(scene.pieces.size()), contacts.sizes.resize(scene.pieces.size());
    each_piece_looked_at(scene, contacts, [&](std::uint32_t i) {
        bound_piece(scene, i, contacts);
        const Piece& piece = scene.pieces[i];
        double farthest = 0;
        for (int k = 0; k < piece.outline.count; ++k)
            farthest = std::max(farthest, dot(piece.outline.corner[k], piece.outline.corner[k]));
        const double extent = std::sqrt(farthest) + piece.outline.radius;
        contacts.extent[piece.row] = piece.number == 0 ? extent : std::max(contacts.extent[piece.row], extent);
    });
}

/// Notes how all bodies move, and how far they may get in the time to look ahead.
void note_reach(const SoftScene& scene, const State& state, SoftContacts& contacts) {
    if (contacts.knows_resting)
        take_moving(contacts, state, contacts.from);
    else
        contacts.from = state;
    const auto note = [&](std::size_t row) {
        contacts.reach[row] = reach_of(row, scene, state, contacts.extent[row], contacts.ahead);
    };
    if (contacts.knows_rooms()) return each_row_looked_at(contacts, note);
    for (std::size_t row = 0; row < state.size(); ++row) note(row);
}

/// How far [m] a body may get in the time to look ahead: those left out fall, if they wake.
double reach_ahead(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row) {
    if (row >= contacts.asleep.size() || !contacts.asleep[row]) return contacts.reach[row];
    return length(scene.flight.dynamics.gravity()) * contacts.ahead * contacts.ahead;
}

/// A piece's box with the room in which it may get, and so much more [m].
Aabb with_room(const SoftScene& scene, const SoftContacts& contacts, std::size_t piece, double more = 0) {
    const double room = contacts.reach[scene.pieces[piece].row] + speculation * contacts.sizes[piece] + more;
    const Aabb& box = contacts.boxes[piece];
    return {{box.low.x - room, box.low.y - room}, {box.high.x + room, box.high.y + room}};
}

bool is_point(const Piece& piece) { return piece.outline.count == 1 && piece.outline.radius == 0; }

/// Makes two pieces whose rooms overlap a candidate, unless they cannot meet.
void add_pair(const SoftScene& scene, BoxPair pair, SoftContacts& contacts) {
    const auto& ids = scene.bodies.id;
    const auto& apart = scene.mechanisms.apart;
    const Piece* a = &scene.pieces[pair.a];
    const Piece* b = &scene.pieces[pair.b];
    if (a->row == b->row || a->sensor || b->sensor || !may_meet(a->filter, b->filter)) return;
    if (is_point(*a) && is_point(*b)) return;  // such never meet
    if (!moves(scene, a->row) && !moves(scene, b->row)) return;
    const auto joined = std::minmax(a->row, b->row);
    if (std::binary_search(apart.begin(), apart.end(), std::pair(joined.first, joined.second))) return;
    if (ids[b->row].index < ids[a->row].index) std::swap(a, b), std::swap(pair.a, pair.b);
    contacts.candidates.push_back({{ids[a->row], ids[b->row], a->number, b->number}, pair.a, pair.b});
}

void add_pairs(const SoftScene& scene, bool again, SoftContacts& contacts) {
    Scratch<bool> movable(again ? 0 : scene.pieces.size());
    if (!again)
        each_piece_looked_at(scene, contacts, [&](std::uint32_t i) {
            movable[i] = contacts.knows_resting || moves(scene, scene.pieces[i].row);
        });
    for (const BoxPair pair : again ? contacts.sweep.pairs_again(contacts.rooms, contacts.awake_pieces)
                                    : contacts.sweep.pairs(contacts.rooms, movable))
        add_pair(scene, pair, contacts);
}

/// How far a box is from a wall; less than 0 if it reaches into it.
double apart(const Wall& wall, const Aabb& box) {
    const Vec2 nearest{wall.normal.x > 0 ? box.low.x : box.high.x, wall.normal.y > 0 ? box.low.y : box.high.y};
    return dot(wall.normal, nearest) - wall.offset;
}

void add_wall(const SoftScene& scene, std::uint32_t wall, std::uint32_t piece, SoftContacts& contacts) {
    const Piece& b = scene.pieces[piece];
    if (b.sensor || !moves(scene, b.row)) return;
    contacts.candidates.push_back({{{wall, 0}, scene.bodies.id[b.row], 0, b.number}, wall, piece});
}

void add_walls(const SoftScene& scene, SoftContacts& contacts) {
    for (std::uint32_t w = 0; w < scene.walls.all.size(); ++w)
        each_piece_looked_at(scene, contacts, [&](std::uint32_t i) {
            if (apart(scene.walls.all[w], contacts.rooms[i]) <= 0) add_wall(scene, w, i, contacts);
        });
}

bool is_within(const Aabb& box, const Aabb& room) {
    return box.low.x >= room.low.x && box.low.y >= room.low.y && box.high.x <= room.high.x && box.high.y <= room.high.y;
}

bool overlap(const Aabb& a, const Aabb& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

Aabb hull(const Aabb& a, const Aabb& b) {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

/// Whether all pieces stay in the rooms for which pairs were looked for the last time.
bool are_known(const SoftScene& scene, const SoftContacts& contacts) {
    if (!contacts.knows_pairs || contacts.left_out != contacts.knows_resting) return false;
    const auto is_outside = [&](std::uint32_t i) {
        return !is_within(with_room(scene, contacts, i), contacts.rooms[i]);
    };
    if (contacts.knows_rooms())
        return std::none_of(contacts.awake_pieces.begin(), contacts.awake_pieces.end(), is_outside);
    for (std::uint32_t i = 0; i < scene.pieces.size(); ++i)
        if (is_outside(i)) return false;
    return true;
}

/// In the order of their keys. They are in that of the first bodies already if rows are in the order of indices, and in
/// order altogether if bodies have one piece.
void put_in_order(std::vector<Candidate>& candidates) {
    const auto in_order = [](const Candidate& c, const Candidate& d) { return c.key < d.key; };
    const auto first_in_order = [](const Candidate& c, const Candidate& d) {
        const BodyId a = c.key.a, b = d.key.a;
        return a.generation < b.generation || (a.generation == b.generation && a.index < b.index);
    };
    if (!std::is_sorted(candidates.begin(), candidates.end(), first_in_order))
        return std::sort(candidates.begin(), candidates.end(), in_order);
    for (auto run = candidates.begin(); run != candidates.end();) {
        const auto next = std::upper_bound(run, candidates.end(), *run, first_in_order);
        if (!std::is_sorted(run, next, in_order)) std::sort(run, next, in_order);
        run = next;
    }
}

/// The pairs whose boxes meet or may soon, in the order of their keys. What it costs to look for them depends on how
/// long they last, and nothing else does: who is near enough is found without asking who else is a candidate.
void search(const SoftScene& scene, SoftContacts& contacts) {
    constexpr double ample = 0.1;  // of a piece's size
    constexpr int seldom = 16;
    const bool lasts = contacts.lasts || ++contacts.vain == seldom;
    if (lasts) contacts.vain = 0;
    contacts.rooms.resize(contacts.boxes.size());
    const auto give_room = [&](std::size_t i) {
        const bool may_leave = lasts && moves(scene, scene.pieces[i].row);
        contacts.rooms[i] = with_room(scene, contacts, i, may_leave ? ample * contacts.sizes[i] : 0);
    };
    const bool again = contacts.knows_rooms();
    if (again) {
        for (const std::uint32_t i : contacts.awake_pieces) give_room(i);
    } else {
        for (std::size_t i = 0; i < contacts.boxes.size(); ++i) give_room(i);
        contacts.rest_ahead = contacts.ahead;
    }
    contacts.candidates.clear();
    add_walls(scene, contacts);
    add_pairs(scene, again, contacts);
    put_in_order(contacts.candidates);
    contacts.any_late = false;
    contacts.knows_pairs = true, contacts.left_out = contacts.knows_resting, contacts.lasts = false;
}

/// Two bodies, and how the one that stretches less far moves as the other one's material sees it where it is.
class Passing {
  public:
    Passing(const SoftContacts& contacts, std::uint32_t a, std::uint32_t b) {
        const bool a_is_small = contacts.extent[a] < contacts.extent[b];
        small = a_is_small ? a : b, large = a_is_small ? b : a;
        extent_ = contacts.extent[small];
        lever_ = contacts.frames[small].position - contacts.frames[large].position;
    }
    std::uint32_t small, large;

    /// The most that any point of it does, for the twists of both.
    double most(const Twist& s, const Twist& l) const {
        return length(s.velocity - l.velocity - cross(l.angular_velocity, lever_)) +
               std::abs(s.angular_velocity - l.angular_velocity) * extent_;
    }

  private:
    double extent_;
    Vec2 lever_;
};

Twist twist_of(const State& state, std::uint32_t row) {
    return row < state.size() ? Twist{state.v.linear[row], state.v.angular[row]} : Twist{};
}

bool falls(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row) {
    return moves(scene, row) && !contacts.asleep[row];
}

/// How a body moves in t [s] after contacts were looked for, if it goes on as it did.
Twist foreseen(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row, double t) {
    const Twist then = twist_of(contacts.from, row);
    if (t == 0 || !falls(scene, contacts, row)) return then;
    return {then.velocity + t * scene.flight.dynamics.gravity(), then.angular_velocity};
}

/// How far a body is off the way that was foreseen, t [s] after contacts were looked for, or in h [s] from then on.
Twist off_way(const SoftScene& scene, const State& state, const SoftContacts& contacts, std::uint32_t row, double t,
              double h) {
    if (row >= state.size()) return {};
    const auto& [time, x, v, account] = contacts.from;
    const Vec2 gone = state.x.linear[row] - x.linear[row], dv = state.v.linear[row] - v.linear[row];
    const Vec2 fallen = falls(scene, contacts, row) ? (0.5 * t + h) * t * scene.flight.dynamics.gravity() : Vec2{};
    return {gone - t * v.linear[row] + h * dv - fallen,
            state.x.angular[row] - x.angular[row] - t * v.angular[row] + h * (state.v.angular[row] - v.angular[row])};
}

/// How much nearer [m] two bodies may come in so much time, if they go on as they do.
double foreseen_approach(const SoftScene& scene, const SoftContacts& contacts, const Passing& pair, const Twist& s,
                         const Twist& l, double t) {
    const bool fall_together = falls(scene, contacts, pair.small) && falls(scene, contacts, pair.large);
    const double falling = fall_together ? 0 : length(scene.flight.dynamics.gravity()) * t;
    // While the one goes straight on the other one turns under it.
    const double bend = 0.5 * t * std::abs(l.angular_velocity) * length(s.velocity - l.velocity);
    return t * (pair.most(s, l) + falling + bend);
}

/// How far apart the boxes of a candidate are, along an axis; less than 0 if they overlap.
double boxes_apart(const SoftScene& scene, const Candidate& c, const SoftContacts& contacts) {
    const Aabb& b = contacts.boxes[c.piece_b];
    if (c.is_at_wall()) return apart(scene.walls.all[c.piece_a], b);
    const Aabb& a = contacts.boxes[c.piece_a];
    return std::max({a.low.x - b.high.x, b.low.x - a.high.x, a.low.y - b.high.y, b.low.y - a.high.y});
}

/// How far apart [m] the two of a candidate are looked at in any case.
double spare_of(const Candidate& c, const SoftContacts& contacts) {
    const double b = contacts.sizes[c.piece_b];
    return speculation * (c.is_at_wall() ? b : std::min(b, contacts.sizes[c.piece_a]));
}

/// How near the pieces of a candidate have to be to be a contact, in substeps of h [s]. What bounces much, or is one of
/// few, may be struck by whoever is in reach. The others are taken to go on as they do; who does not is looked at a
/// substep later, and is not to be through the other one by then.
Near nearness(const SoftScene& scene, const State& state, std::uint32_t index, double h, const SoftContacts& contacts) {
    constexpr std::size_t few = 50;  // pieces: to look at all in reach costs little, and each blow is at its instant
    const Candidate& candidate = contacts.candidates[index];
    const Piece& b = scene.pieces[candidate.piece_b];
    const bool at_wall = candidate.is_at_wall();
    const std::uint32_t row = at_wall ? static_cast<std::uint32_t>(state.size()) : scene.pieces[candidate.piece_a].row;
    const double reach = reach_ahead(scene, contacts, row) + reach_ahead(scene, contacts, b.row);
    const double spare = spare_of(candidate, contacts);
    const double other =
        at_wall ? scene.walls.all[candidate.piece_a].restitution : scene.pieces[candidate.piece_a].restitution;
    Near near{index, row, b.row, reach + spare, HUGE_VAL};
    const double apart = boxes_apart(scene, candidate, contacts);
    near.is_far = apart > near.margin;
    const bool goes_on = scene.pieces.size() > few && mixed_restitution(scene.bodies, other, b.restitution) <= little;
    if (near.is_far || !goes_on) return near;  // who is out of reach need not be watched
    const Passing pair(contacts, row, b.row);
    const double t = state.time - contacts.from.time;
    const double approach =
        foreseen_approach(scene, contacts, pair, foreseen(scene, contacts, pair.small, t),
                          foreseen(scene, contacts, pair.large, t), contacts.ahead - t);
    const double jump = reach * h / contacts.ahead - 0.25 * thickness(scene, candidate);
    const double margin = std::max(approach + spare, jump);
    if (margin >= near.margin) return near;
    near.margin = margin, near.spare = std::max(margin, apart) - approach;
    if (t > 0)
        near.spare -= pair.most(off_way(scene, state, contacts, pair.small, t, 0),
                                off_way(scene, state, contacts, pair.large, t, 0));
    near.is_far = apart > margin;
    return near;
}

}  // namespace

double thickness(const SoftScene& scene, const Candidate& c) {
    const auto of = [](const Convex& outline) {
        const double thick = (outline.count > 2 ? outline.width : 0) + 2 * outline.radius;
        return thick > 0 ? thick : HUGE_VAL;
    };
    const double b = of(scene.pieces[c.piece_b].outline);
    return c.is_at_wall() ? b : std::min(b, of(scene.pieces[c.piece_a].outline));
}

double closing_speed(const State& state, std::uint32_t a, std::uint32_t b, const SoftContacts& contacts) {
    const Passing pair(contacts, a, b);
    return pair.most(twist_of(state, pair.small), twist_of(state, pair.large));
}

void find_candidates(const SoftScene& scene, const State& state, double dt, double h, SoftContacts& contacts) {
    const Timed timed(scene.profile, Work::pairs);
    if (!contacts.knows_resting) {
        recall_resting(contacts);
        contacts.reach.assign(scene.bodies.size() + 1, 0), contacts.extent.assign(scene.bodies.size() + 1, 0);
        contacts.extent.back() = HUGE_VAL;  // the ground's
    }
    bound_pieces(scene, contacts);
    contacts.ahead = time_ahead(scene, state, dt, h, contacts);
    note_reach(scene, state, contacts);
    if (are_known(scene, contacts))
        contacts.lasts = true;
    else
        search(scene, contacts);
    if (contacts.any_late) put_in_order(contacts.candidates), contacts.any_late = false;
    contacts.near.resize(contacts.candidates.size());
    constexpr std::size_t some = 1024;
    parallel_ranges(scene.threads, contacts.candidates.size(), some, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k)
            contacts.near[k] = nearness(scene, state, static_cast<std::uint32_t>(k), h, contacts);
    });
    contacts.passed_over.clear();
    for (const Near& near : contacts.near)
        if (near.is_far && near.is_watched()) contacts.passed_over.push_back(near);
    std::erase_if(contacts.near, [](const Near& near) { return near.is_far; });
}

bool is_time_over(const State& state, double h, const SoftContacts& contacts) {
    constexpr double rounding = 1e-9;
    return state.time - contacts.from.time + h > (1 + rounding) * contacts.ahead;
}

Scratch<std::uint32_t> find_outrunners(const SoftScene& scene, const State& state, double h,
                                       const SoftContacts& contacts) {
    Scratch<std::uint32_t> found;
    contacts.moving.each_row([&](std::size_t i) {
        if (contacts.extent[i] == 0 || contacts.asleep[i]) return;  // nothing that could touch
        const double gone = length(state.x.linear[i] - contacts.from.x.linear[i]);
        const double room = contacts.reach[i] + speculation * contacts.extent[i];
        if (gone + reach_of(i, scene, state, contacts.extent[i], h) > room)
            found.push_back(static_cast<std::uint32_t>(i));
    });
    return found;
}

namespace {

/// From now on a body is taken to go on as it does now.
void foresee_anew(const SoftScene& scene, const State& state, std::uint32_t row, SoftContacts& contacts) {
    auto& [time, x, v, account] = contacts.from;
    const double t = state.time - time;
    const Vec2 g = falls(scene, contacts, row) ? scene.flight.dynamics.gravity() : Vec2{};
    v.linear[row] = state.v.linear[row] - t * g, v.angular[row] = state.v.angular[row];
    x.linear[row] = state.x.linear[row] - t * (v.linear[row] + 0.5 * t * g);
    x.angular[row] = state.x.angular[row] - t * v.angular[row];
    contacts.reach[row] = reach_of(row, scene, state, contacts.extent[row], contacts.ahead);
}

/// A room that grew.
struct Widened {
    Aabb room;  ///< as it is now
    Aabb before;
    std::uint32_t piece;
};

/// Gives pieces the rooms that they need now, and makes those candidates whom they may meet there and were not known to.
void widen_rooms(const SoftScene& scene, const Scratch<std::uint32_t>& pieces, SoftContacts& contacts) {
    Scratch<Widened> widened;
    for (const std::uint32_t i : pieces) {
        const Aabb needed = with_room(scene, contacts, i), before = contacts.rooms[i];
        if (!is_within(needed, before)) widened.push_back({hull(needed, before), before, i});
    }
    if (widened.empty()) return;
    const auto is_left_of = [](const Widened& v, const Widened& w) { return v.room.low.x < w.room.low.x; };
    std::sort(widened.begin(), widened.end(), is_left_of);
    double widest = 0;
    Scratch<const Widened*> of_piece(contacts.rooms.size());
    for (const Widened& w : widened) {
        widest = std::max(widest, w.room.high.x - w.room.low.x);
        of_piece[w.piece] = &w;
        for (std::uint32_t k = 0; k < scene.walls.all.size(); ++k)
            if (apart(scene.walls.all[k], w.room) <= 0 && apart(scene.walls.all[k], w.before) > 0)
                add_wall(scene, k, w.piece, contacts);
    }
    for (std::uint32_t other = 0; other < contacts.rooms.size(); ++other) {
        const Widened* its = of_piece[other];
        const Aabb &before = contacts.rooms[other], &room = its ? its->room : before;
        auto w = std::partition_point(widened.begin(), widened.end(),
                                      [&](const Widened& v) { return v.room.low.x < room.low.x - widest; });
        for (; w != widened.end() && w->room.low.x <= room.high.x; ++w)
            if ((!its || w->piece < other) && overlap(w->room, room) && !overlap(w->before, before))
                add_pair(scene, {w->piece, other}, contacts);
    }
    for (const Widened& w : widened) contacts.rooms[w.piece] = w.room;
    contacts.any_late = true;
}

/// Some bodies, known by their rows or by the index of their ids.
class Some {
  public:
    Some(const SoftScene& scene, const Scratch<std::uint32_t>& rows) : by_row_(scene.bodies.size() + 1) {
        std::uint32_t last = 0;
        for (const std::uint32_t row : rows) last = std::max(last, scene.bodies.id[row].index);
        by_index_.resize(last + 1);
        for (const std::uint32_t row : rows) by_row_[row] = by_index_[scene.bodies.id[row].index] = true;
    }
    bool hold(std::uint32_t row) const { return by_row_[row]; }
    bool hold(BodyId id) const { return id.index < by_index_.size() && by_index_[id.index]; }

  private:
    Scratch<bool> by_row_, by_index_;
};

}  // namespace

Scratch<Near> look_around(const SoftScene& scene, const State& state, double h, const Scratch<std::uint32_t>& rows,
                          SoftContacts& contacts) {
    const Some some(scene, rows);
    Scratch<std::uint32_t> pieces;
    for (const std::uint32_t row : rows) {
        foresee_anew(scene, state, row, contacts);
        const auto first = std::partition_point(scene.pieces.begin(), scene.pieces.end(),
                                                [row](const Piece& p) { return p.row < row; });
        for (auto i = static_cast<std::uint32_t>(first - scene.pieces.begin());
             i < scene.pieces.size() && scene.pieces[i].row == row; ++i)
            bound_piece(scene, i, contacts), pieces.push_back(i);
    }
    widen_rooms(scene, pieces, contacts);
    std::erase_if(contacts.passed_over, [&](const Near& near) { return some.hold(near.a) || some.hold(near.b); });
    Scratch<ContactKey> known;
    for (const SoftContact& c : contacts.all)
        if (some.hold(c.a) || some.hold(c.b)) known.push_back(c.key);
    std::sort(known.begin(), known.end());
    Scratch<Near> found;
    for (std::uint32_t k = 0; k < contacts.candidates.size(); ++k) {
        const Candidate& c = contacts.candidates[k];
        if (!some.hold(c.key.b) && (c.is_at_wall() || !some.hold(c.key.a))) continue;
        if (std::binary_search(known.begin(), known.end(), c.key)) continue;
        bound_piece(scene, c.piece_b, contacts);
        if (!c.is_at_wall()) bound_piece(scene, c.piece_a, contacts);
        const Near near = nearness(scene, state, k, h, contacts);
        if (!near.is_far)
            found.push_back(near);
        else if (near.is_watched())
            contacts.passed_over.push_back(near);
    }
    return found;
}

void take_astray(const SoftScene& scene, const State& state, double h, SoftContacts& contacts, Scratch<Near>& astray) {
    if (contacts.passed_over.empty()) return;
    const double t = state.time - contacts.from.time;
    Scratch<Twist> off(state.size() + 1);
    contacts.moving.each_row([&](std::size_t i) {
        if (contacts.extent[i] == 0 || contacts.asleep[i]) return;
        off[i] = off_way(scene, state, contacts, static_cast<std::uint32_t>(i), t, h);
    });
    std::size_t kept = 0;
    for (const Near& p : contacts.passed_over) {
        const Passing pair(contacts, p.a, p.b);
        if (pair.most(off[pair.small], off[pair.large]) <= p.spare) {
            contacts.passed_over[kept++] = p;
            continue;
        }
        const double left = foreseen_approach(scene, contacts, pair, twist_of(state, pair.small),
                                              twist_of(state, pair.large), contacts.ahead - t);
        astray.push_back(p);
        astray.back().margin = left + spare_of(contacts.candidates[p.candidate], contacts);
    }
    contacts.passed_over.resize(kept);
}

}  // namespace carom
