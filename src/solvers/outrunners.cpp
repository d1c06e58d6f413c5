// Who does not go on as was foreseen when contacts were looked for, and whom he may meet instead.

#include <algorithm>
#include <cmath>

#include "solvers/candidates.hpp"
#include "solvers/shared.hpp"

namespace carom {

bool is_time_over(const State& state, double h, const Outlook& outlook) {
    constexpr double rounding = 1e-9;
    return state.time - outlook.from.time + h > (1 + rounding) * outlook.ahead;
}

Scratch<std::uint32_t> find_outrunners(const SoftScene& scene, const State& state, double h,
                                       const SoftContacts& contacts) {
    const Outlook& outlook = contacts.outlook;
    const std::vector<double>& extent = contacts.pieces.extent;
    Scratch<std::uint32_t> found;
    const WayAhead way(scene, state, h);
    contacts.rest.moving.each_row([&](std::size_t i) {
        if (extent[i] == 0 || contacts.rest.asleep[i]) return;  // nothing that could touch
        const double gone = length(state.x.linear[i] - outlook.from.x.linear[i]);
        const double room = outlook.reach[i] + speculation * extent[i];
        if (gone + way.of(i, extent[i]) > room) found.push_back(static_cast<std::uint32_t>(i));
    });
    return found;
}

namespace {

/// From now on a body is taken to go on as it does now.
void foresee_anew(const SoftScene& scene, const State& state, std::uint32_t row, SoftContacts& contacts) {
    Outlook& outlook = contacts.outlook;
    auto& [time, x, v, account] = outlook.from;
    const double t = state.time - time;
    const Vec2 g = Foresight(scene, contacts).falls(row) ? scene.flight.dynamics.gravity() : Vec2{};
    v.linear[row] = state.v.linear[row] - t * g, v.angular[row] = state.v.angular[row];
    x.linear[row] = state.x.linear[row] - t * (v.linear[row] + 0.5 * t * g);
    x.angular[row] = state.x.angular[row] - t * v.angular[row];
    outlook.reach[row] = WayAhead(scene, state, outlook.ahead).of(row, contacts.pieces.extent[row]);
}

/// A room that grew.
struct Widened {
    Aabb room;  ///< as it is now
    Aabb before;
    std::uint32_t piece;
};

/// Gives pieces the rooms that they need now, and makes those candidates whom they may meet there and were not known
/// to.
void widen_rooms(const SoftScene& scene, const Scratch<std::uint32_t>& pieces, SoftContacts& contacts) {
    Scratch<Widened> widened;
    for (const std::uint32_t i : pieces) {
        const Aabb needed = with_room(contacts.pieces, contacts.outlook, i), before = contacts.search.rooms[i];
        if (!is_within(needed, before)) widened.push_back({hull(needed, before), before, i});
    }
    if (widened.empty()) return;
    const auto is_left_of = [](const Widened& v, const Widened& w) { return v.room.low.x < w.room.low.x; };
    std::sort(widened.begin(), widened.end(), is_left_of);
    double widest = 0;
    Scratch<const Widened*> of_piece(contacts.search.rooms.size());
    for (const Widened& w : widened) {
        widest = std::max(widest, w.room.high.x - w.room.low.x);
        of_piece[w.piece] = &w;
        for (std::uint32_t k = 0; k < scene.walls.all.size(); ++k)
            if (apart(scene.walls.all[k], w.room) <= 0 && apart(scene.walls.all[k], w.before) > 0)
                add_wall(k, w.piece, contacts);
    }
    for (std::uint32_t other = 0; other < contacts.search.rooms.size(); ++other) {
        const Widened* its = of_piece[other];
        const Aabb &before = contacts.search.rooms[other], &room = its ? its->room : before;
        auto w = std::partition_point(widened.begin(), widened.end(),
                                      [&](const Widened& v) { return v.room.low.x < room.low.x - widest; });
        for (; w != widened.end() && w->room.low.x <= room.high.x; ++w)
            if ((!its || w->piece < other) && overlap(w->room, room) && !overlap(w->before, before))
                add_pair(scene, {w->piece, other}, contacts);
    }
    for (const Widened& w : widened) contacts.search.rooms[w.piece] = w.room;
}

/// Some bodies, known by their rows or by the index of their ids.
class Followed {
  public:
    Followed(const SoftScene& scene, const Scratch<std::uint32_t>& rows) : by_row_(scene.bodies.size() + 1) {
        std::uint32_t last = 0;
        for (const std::uint32_t row : rows) last = std::max(last, scene.bodies.id[row].index);
        by_index_.resize(last + 1);
        for (const std::uint32_t row : rows) by_row_[row] = by_index_[scene.bodies.id[row].index] = 1;
    }
    bool hold(std::uint32_t row) const { return by_row_[row] != 0; }
    const Scratch<std::uint8_t>& by_row() const { return by_row_; }
    bool hold(BodyId id) const { return id.index < by_index_.size() && by_index_[id.index] != 0; }

  private:
    Scratch<std::uint8_t> by_row_, by_index_;
};

}  // namespace

Scratch<Near> look_around(const SoftScene& scene, const State& state, double h, const Scratch<std::uint32_t>& rows,
                          SoftContacts& contacts) {
    const Followed followed(scene, rows);
    Scratch<std::uint32_t> pieces;
    for (const std::uint32_t row : rows) {
        foresee_anew(scene, state, row, contacts);
        each_piece_of(scene.pieces, row, [&](std::size_t k) {
            const auto i = static_cast<std::uint32_t>(k);
            bound_piece(scene, i, contacts), pieces.push_back(i);
        });
    }
    widen_rooms(scene, pieces, contacts);
    contacts.outlook.passed_over.take_out(
        scene.threads, followed.by_row(), [](const Passed&) { return true; }, [](const Passed&) {});
    Scratch<ContactKey> known;
    for (const SoftContact& c : contacts.all)
        if (followed.hold(c.a) || followed.hold(c.b)) known.push_back(c.key);
    std::sort(known.begin(), known.end());
    Scratch<Near> found;
    const Nearness nearness(scene, state, h, contacts);
    const auto& candidates = contacts.search.candidates;
    constexpr std::size_t some = 32;
    const auto look = [&](std::size_t block) {
        std::uint32_t held = 0;
        for (std::size_t k = some * block; k < std::min(some * (block + 1), candidates.size()); ++k) {
            const auto& [a, b, piece_a, piece_b] = candidates[k].key;
            const bool holds_a = !candidates[k].is_at_wall() && followed.hold(a);
            held |= std::uint32_t{followed.hold(b) || holds_a} << k % some;
        }
        return held;
    };
    const auto note = [&](std::size_t block, std::uint32_t place) {
        const auto k = static_cast<std::uint32_t>(some * block + place);
        const Candidate& c = candidates[k];
        if (std::binary_search(known.begin(), known.end(), c.key)) return;
        bound_piece(scene, c.piece_b, contacts);
        if (!c.is_at_wall()) bound_piece(scene, c.piece_a, contacts);
        const Near near = nearness.of(k);
        if (!near.is_far)
            found.push_back(near);
        else
            pass_over_later(near, contacts.outlook);
    };
    each_row_where(scene.threads, (candidates.size() + some - 1) / some, look, note);
    return found;
}

void pass_over(const Near& near, Outlook& outlook) {
    if (!near.is_watched()) return;
    outlook.passed_over.add(near);
    for (const std::uint32_t row : {near.a, near.b}) {
        Leash& leash = outlook.leashes[row];
        leash = {std::min(leash.way, 0.5 * near.spare), std::max(leash.reach, near.span)};
    }
}

void pass_over_later(const Near& near, Outlook& outlook) {
    if (!near.is_watched()) return;
    outlook.passed_over.add(near);
    outlook.leashes[near.a].way = outlook.leashes[near.b].way = -HUGE_VAL;  // these two are asked in any case
}

namespace {

/// Calls act(row) for the rows that move.
template <class Act>
void act_on_moving(const SoftScene& scene, const Rest& rest, const Act& act) {
    for_each_moving(scene.threads, rest.moving, rest.asleep.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) act(i);
    });
}

/// Which bodies are so far off their ways that one of those passed over for them may be met; those of two others have
/// enough to spare. All that it asks for is an upper bound of Passing::most for any of a body's pairs, less the other
/// one's share.
Scratch<std::uint8_t> find_strays(const SoftScene& scene, const Scratch<Twist>& off, const SoftContacts& contacts) {
    constexpr double rounding = 1 + 1e-9;
    Scratch<std::uint8_t> strays(off.size());
    double farthest = 0;
    contacts.rest.moving.each_row([&](std::size_t i) {
        farthest =
            std::max(farthest, squared_length(contacts.motion.frames[i].position - contacts.outlook.from.x.linear[i]));
    });
    const double nearer = 2 * std::sqrt(farthest);  // two may have come by now
    act_on_moving(scene, contacts.rest, [&](std::size_t i) {
        const Leash& leash = contacts.outlook.leashes[i];
        const double turned = std::abs(off[i].angular_velocity) * (leash.reach + nearer);
        strays[i] = !(rounding * (length(off[i].velocity) + turned) <= leash.way);
    });
    return strays;
}

}  // namespace

void take_astray(const SoftScene& scene, const State& state, double h, SoftContacts& contacts, Scratch<Near>& astray) {
    if (contacts.outlook.passed_over.empty()) return;
    const double t = state.time - contacts.outlook.from.time;
    const Foresight foresight(scene, contacts);
    Scratch<Twist> off(state.size() + 1);
    act_on_moving(scene, contacts.rest, [&](std::size_t i) {
        if (contacts.pieces.extent[i] == 0 || contacts.rest.asleep[i]) return;
        make_at(off[i], [&] { return foresight.off_way(state, static_cast<std::uint32_t>(i), t, h); });
    });
    const Scratch<std::uint8_t> strays = find_strays(scene, off, contacts);
    const auto goes_astray = [&](const Passed& p) {
        const Passing pair(contacts, p.a, p.b);
        return !(pair.most(off[pair.small], off[pair.large]) <= p.spare);
    };
    const auto take = [&](const Passed& p) {
        const Passing pair(contacts, p.a, p.b);
        const double left = foresight.approach(pair, twist_of(state, pair.small), twist_of(state, pair.large),
                                               contacts.outlook.ahead - t);
        const double margin = left + spare_of(contacts.search.candidates[p.candidate], contacts.pieces);
        astray.push_back({p.candidate, p.a, p.b, false, margin, p.spare});
    };
    contacts.outlook.passed_over.take_out(scene.threads, strays, goes_astray, take);
}

}  // namespace carom
