#include "solvers/time_of_impact.hpp"

#include <algorithm>
#include <tuple>

namespace carom {

void advance_to_impacts(const Impulse& solver, const Flight& flight, const Walls& walls, const Bodies& bodies,
                        State& state, double h, Contacts& contacts) {
    const auto fly = flight.dynamics.is_free_flight() ? fly_freely : fly_under_forces;
    fly(solver, flight, walls, bodies, state, h, contacts);
}

Touch touch_of(const Contact& p, const Walls& walls, const Bodies& bodies, const State& state) {
    if (p.wall != Contact::no_wall) {
        const Wall& wall = walls.all[p.wall];
        return {-wall.normal, mixed_restitution(bodies, wall.restitution, bodies.restitution[p.i]),
                mixed_friction(bodies, wall.friction, bodies.friction[p.i])};
    }
    const Vec2 d = nearest_image(walls.periodic, state.x.linear[p.j] - state.x.linear[p.i]);
    const double distance = length(d);
    return {distance > 0 ? d / distance : Vec2{1, 0},
            mixed_restitution(bodies, bodies.restitution[p.i], bodies.restitution[p.j]),
            mixed_friction(bodies, bodies.friction[p.i], bodies.friction[p.j])};
}

void collide(const Contact& p, const Touch& touch, const Bodies& bodies, State& state) {
    if (p.wall != Contact::no_wall)
        collide(p.i, touch, bodies, state);
    else
        collide(p.i, p.j, touch, bodies, state);
}

namespace {

/// Gaps below this part of a radius are contact.
constexpr double touching = 1e-9;

double gap_of(const Contact& c, const Walls& walls, const Bodies& bodies, const State& state) {
    if (c.wall != Contact::no_wall) {
        const Wall& wall = walls.all[c.wall];
        return dot(wall.normal, state.x.linear[c.i]) - wall.offset - bodies.radius[c.i];
    }
    return length(nearest_image(walls.periodic, state.x.linear[c.j] - state.x.linear[c.i])) - bodies.radius[c.i] -
           bodies.radius[c.j];
}

/// What counts as a gap of none between a pair, or one of it, and a wall [m].
double hair_of(const Contact& c, const Bodies& bodies) {
    return touching * std::max(bodies.radius[c.i], bodies.radius[c.j]);
}

/// How a disc follows a push of 1 N s [m/s] if walls that it touches take what of it leads into them.
Vec2 along_walls(std::uint32_t i, Vec2 push, double hair, const Walls& walls, const Bodies& bodies,
                 const State& state) {
    const auto leads_into = [&](Vec2 way, std::uint32_t w) {
        return dot(way, walls.all[w].normal) < -touching && gap_of({i, i, w}, walls, bodies, state) <= hair;
    };
    Vec2 way = push;
    for (std::uint32_t w = 0; w < walls.all.size(); ++w)
        if (leads_into(way, w)) way -= dot(way, walls.all[w].normal) * walls.all[w].normal;
    for (std::uint32_t w = 0; w < walls.all.size(); ++w)
        if (leads_into(way, w)) return {};  // it is wedged
    return bodies.inverse_mass[i] * way;
}

/// Moves the two apart by an overlap, the lighter one farther, and none into a wall.
void put_apart(const Contact& c, double overlap, const Walls& walls, const Bodies& bodies, Vec2 gravity, State& state) {
    const Vec2 n = touch_of(c, walls, bodies, state).normal;
    const bool at_wall = c.wall != Contact::no_wall;
    const double hair = hair_of(c, bodies);
    const Vec2 i = at_wall ? -bodies.inverse_mass[c.i] * n : along_walls(c.i, -n, hair, walls, bodies, state);
    const Vec2 j = at_wall ? Vec2{} : along_walls(c.j, n, hair, walls, bodies, state);
    const double ease = dot(n, j - i);
    if (!(ease > 0)) return;
    shift(c.i, overlap / ease * i, bodies, gravity, state);
    if (at_wall) return;
    shift(c.j, overlap / ease * j, bodies, gravity, state);
    // Who is put away from where he was, across his way, would turn the faster about the other one by that.
    const double apart = bodies.radius[c.i] + bodies.radius[c.j];
    const bool is_alone = i == -bodies.inverse_mass[c.i] * n && j == bodies.inverse_mass[c.j] * n;
    if (is_alone && overlap < apart) keep_turning(c.i, c.j, n, 1 - overlap / apart, bodies, state);
}

/// The contacts given, and all others that pushing their bodies apart may lead to; in order, each once.
std::vector<Contact> whole_pile(const std::vector<Contact>& resting, const Impulse& solver, const Walls& walls,
                                const Bodies& bodies, const State& state, Contacts& contacts) {
    std::vector<Contact> pile;
    std::vector<std::uint32_t> next;
    std::vector<bool> seen(bodies.size());
    const auto visit = [&](std::uint32_t i) {
        if (!seen[i] && bodies.inverse_mass[i] != 0) next.push_back(i);
        seen[i] = true;
    };
    double deepest = 0;
    for (const Contact& c : resting) {
        deepest = std::max(deepest, -gap_of(c, walls, bodies, state));
        visit(c.i), visit(c.j);
    }
    while (!next.empty()) {
        const std::uint32_t i = next.back();
        next.pop_back();
        for (std::uint32_t w = 0; w < walls.all.size(); ++w) pile.push_back({i, i, w});
        if (!solver.disc_collisions) continue;
        const double room = 2 * deepest + touching * bodies.radius[i];
        contacts.candidates.clear();
        contacts.grid.near(state.x.linear[i], bodies.radius[i] + room, contacts.candidates);
        for (const std::uint32_t j : contacts.candidates) {
            const Contact pair{std::min(i, j), std::max(i, j)};
            if (j == i || bodies.radius[i] + bodies.radius[j] == 0 || gap_of(pair, walls, bodies, state) > room)
                continue;
            pile.push_back(pair);
            visit(j);
        }
    }
    const auto key = [](const Contact& c) { return std::tie(c.i, c.j, c.wall); };
    std::sort(pile.begin(), pile.end(), [&](const Contact& c, const Contact& d) { return key(c) < key(d); });
    pile.erase(std::unique(pile.begin(), pile.end()), pile.end());
    return pile;
}

/// One of two that come to rest on one another.
struct Resting {
    std::uint32_t row;
    Vec2 push;    ///< which way the other one pushes it
    Vec2 v;       ///< [m/s], without what walls take of it
    Vec2 yields;  ///< how it follows a push of 1 N s [m/s]
    bool at_wall = false;

    /// If a blow of e = 0 [N s] would push it into a wall that it touches, that takes its part.
    Resting(std::uint32_t i, Vec2 along, double blow, double hair, const Walls& walls, const Bodies& bodies,
            const State& state)
        : row(i), push(along), v(state.v.linear[i]), yields(bodies.inverse_mass[i] * along) {
        const Vec2 after = v + blow * yields;
        for (std::uint32_t w = 0; bodies.inverse_mass[i] != 0 && w < walls.all.size(); ++w) {
            const Vec2 wall = walls.all[w].normal;
            const bool is_pushed_in = dot(push, wall) < -touching && dot(after, wall) < 0;
            if (!is_pushed_in || gap_of({i, i, w}, walls, bodies, state) > hair) continue;
            v -= dot(v, wall) * wall;
            at_wall = true;
        }
        if (at_wall) yields = along_walls(i, push, hair, walls, bodies, state);
    }
};

/// Gives one its velocity, and books that; what does not move is worked on or works.
void bring_to_rest(const Resting& one, const Resting& other, double impulse, const Bodies& bodies, State& state) {
    Vec2& v = state.v.linear[one.row];
    const Vec2 before = v, given = impulse * one.push;
    if (bodies.inverse_mass[one.row] == 0) {
        state.account[Account::driven] -= dot(given, before);
        state.account[Account::impact] -= dot(given, before);
        state.account[Giver::held].add_at(state.x.linear[other.row], -given);
        return;
    }
    v = one.v + impulse * one.yields;
    const Vec2 gained = bodies.mass[one.row] * (v - before);
    state.account[Account::impact] -= 0.5 * dot(gained, before + v);
    state.account[Giver::walls].add_at(state.x.linear[one.row], gained - given);
}

}  // namespace

void bring_to_rest(const Contact& c, const Touch& touch, const Walls& walls, const Bodies& bodies, State& state) {
    const Touch still{touch.normal, 0, touch.friction};
    if (c.wall != Contact::no_wall) return collide(c, still, bodies, state);
    const Vec2 n = touch.normal;
    const double blow =
        dot(state.v.linear[c.i] - state.v.linear[c.j], n) / (bodies.inverse_mass[c.i] + bodies.inverse_mass[c.j]);
    const double hair = hair_of(c, bodies);
    const Resting i(c.i, -n, blow, hair, walls, bodies, state), j(c.j, n, blow, hair, walls, bodies, state);
    if (!i.at_wall && !j.at_wall) return collide(c, still, bodies, state);
    const double approach = dot(i.v - j.v, n), ease = dot(n, j.yields - i.yields);
    const double impulse = approach > 0 && ease > 0 ? approach / ease : 0;
    bring_to_rest(i, j, impulse, bodies, state), bring_to_rest(j, i, impulse, bodies, state);
    rub(c.i, c.j, n, touch.friction * impulse, bodies, state);
}

void settle_resting(const std::vector<Contact>& resting, const Impulse& solver, const Walls& walls,
                    const Bodies& bodies, Vec2 gravity, State& state, Contacts& contacts) {
    if (resting.empty()) return;
    constexpr int sweeps = 100;
    const std::vector<Contact> all = whole_pile(resting, solver, walls, bodies, state, contacts);
    const auto overlap = [&](const Contact& c) { return -gap_of(c, walls, bodies, state); };
    bool moved = true;
    for (int sweep = 0; moved && sweep < sweeps; ++sweep) {
        moved = false;
        for (const Contact& c : all) {
            const double depth = overlap(c);
            if (depth <= 0) continue;
            put_apart(c, depth, walls, bodies, gravity, state);
            moved |= depth > touching * bodies.radius[c.i];
        }
    }
    bool approached = true;
    for (int sweep = 0; approached && sweep < sweeps; ++sweep) {
        approached = false;
        for (const Contact& c : all) {
            if (overlap(c) < -touching * bodies.radius[c.i]) continue;
            const Touch touch = touch_of(c, walls, bodies, state);
            const Vec2 other = c.wall != Contact::no_wall ? Vec2{} : state.v.linear[c.j];
            const double approach = dot(state.v.linear[c.i] - other, touch.normal);
            if (approach <= 0) continue;
            bring_to_rest(c, touch, walls, bodies, state);  // no impact to count
            approached |= approach > touching * length(state.v.linear[c.i]);
        }
    }
}

}  // namespace carom
