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

/// Moves the two apart by an overlap, the lighter one farther.
void put_apart(const Contact& c, double overlap, const Walls& walls, const Bodies& bodies, Vec2 gravity, State& state) {
    const Vec2 normal = touch_of(c, walls, bodies, state).normal;
    const double ease_i = bodies.inverse_mass[c.i], ease_j = c.wall != Contact::no_wall ? 0 : bodies.inverse_mass[c.j];
    const auto move = [&](std::uint32_t i, double share) {
        shift(i, share * overlap * normal, bodies, gravity, state);
    };
    move(c.i, -ease_i / (ease_i + ease_j));
    if (ease_j != 0) move(c.j, ease_j / (ease_i + ease_j));
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
            collide(c, {touch.normal, 0, touch.friction}, bodies, state);  // at rest: no impact to count
            approached |= approach > touching * length(state.v.linear[c.i]);
        }
    }
}

}  // namespace carom
