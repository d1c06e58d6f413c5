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

bool touches(std::uint32_t i, std::uint32_t wall, const Walls& walls, const Bodies& bodies, const State& state) {
    return gap_of({i, i, wall}, walls, bodies, state) <= touching * bodies.radius[i];
}

/// How a disc follows a push of 1 N s [m/s] if walls that it touches take what of it leads into them.
Vec2 along_walls(std::uint32_t i, Vec2 push, const Walls& walls, const Bodies& bodies, const State& state) {
    const auto leads_into = [&](Vec2 way, std::uint32_t w) {
        return dot(way, walls.all[w].normal) < -touching && touches(i, w, walls, bodies, state);
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
    const Vec2 i = at_wall ? -bodies.inverse_mass[c.i] * n : along_walls(c.i, -n, walls, bodies, state);
    const Vec2 j = at_wall ? Vec2{} : along_walls(c.j, n, walls, bodies, state);
    const double ease = dot(n, j - i);
    if (!(ease > 0)) return;
    shift(c.i, overlap / ease * i, bodies, gravity, state);
    if (!at_wall) shift(c.j, overlap / ease * j, bodies, gravity, state);
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

}  // namespace

bool stop_at_wall(const Contact& c, const Touch& touch, const Walls& walls, const Bodies& bodies, State& state) {
    if (c.wall != Contact::no_wall) return false;
    struct One {
        std::uint32_t row;
        Vec2 push, v, yields;  ///< in between it has no velocity across walls into which it would be pushed
    };
    const Vec2 n = touch.normal;
    const auto& v = state.v.linear;
    const double blow = dot(v[c.i] - v[c.j], n) / (bodies.inverse_mass[c.i] + bodies.inverse_mass[c.j]);
    bool is_pressed = false;
    One both[2]{{c.i, -n, v[c.i], bodies.inverse_mass[c.i] * -n}, {c.j, n, v[c.j], bodies.inverse_mass[c.j] * n}};
    for (One& one : both)
        for (std::uint32_t w = 0; bodies.inverse_mass[one.row] != 0 && w < walls.all.size(); ++w) {
            const Vec2 wall = walls.all[w].normal, after = v[one.row] + blow * bodies.inverse_mass[one.row] * one.push;
            if (!(dot(one.push, wall) < -touching && dot(after, wall) < 0)) continue;
            if (!touches(one.row, w, walls, bodies, state)) continue;
            one.v -= dot(one.v, wall) * wall;
            one.yields = along_walls(one.row, one.push, walls, bodies, state);
            is_pressed = true;
        }
    if (!is_pressed) return false;
    const double approach = dot(both[0].v - both[1].v, n), ease = dot(n, both[1].yields - both[0].yields);
    const double impulse = approach > 0 && ease > 0 ? approach / ease : 0;
    for (const One& one : both) {
        if (bodies.inverse_mass[one.row] == 0) continue;
        const Vec2 before = v[one.row], now = one.v + impulse * one.yields,
                   given = bodies.mass[one.row] * (now - before);
        state.v.linear[one.row] = now;
        state.account[Account::impact] -= 0.5 * dot(given, before + now);
        state.account[Giver::walls].add_at(state.x.linear[one.row], given - impulse * one.push);
    }
    return true;
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
            if (!stop_at_wall(c, touch, walls, bodies, state))
                collide(c, {touch.normal, 0, touch.friction}, bodies, state);  // at rest: no impact to count
            approached |= approach > touching * length(state.v.linear[c.i]);
        }
    }
}

}  // namespace carom
