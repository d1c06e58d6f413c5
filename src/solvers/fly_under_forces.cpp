#include <algorithm>

#include "solvers/paths.hpp"
#include "solvers/time_of_impact.hpp"

namespace carom {

namespace {

struct FirstImpact {
    double time;
    Contact pair;
};

/// The earliest impact of all on these paths, ties by the order of pairs; pairs at rest do not count.
std::optional<FirstImpact> first_impact(const Impulse& solver, const std::vector<Path>& paths, const Walls& walls,
                                        const Bodies& bodies, double end, const std::vector<Contact>& resting,
                                        Contacts& contacts) {
    std::optional<FirstImpact> first;
    const auto consider = [&](const std::optional<double>& time, const Contact& pair) {
        if (!time || (first && *time >= first->time)) return;
        if (std::find(resting.begin(), resting.end(), pair) == resting.end()) first = FirstImpact{*time, pair};
    };
    const auto n = static_cast<std::uint32_t>(paths.size());
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t w = 0; bodies.inverse_mass[i] != 0 && w < walls.all.size(); ++w)
            consider(first_touch(paths[i], bodies.radius[i], walls.all[w], 0, end), {i, i, w});
    if (!solver.disc_collisions) return first;

    std::vector<Vec2> centre(n);
    std::vector<double> radius(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        const Reach r = reach(paths[i], end);
        centre[i] = r.centre;
        radius[i] = r.radius + bodies.radius[i];
    }
    contacts.grid.build(centre, radius, walls.periodic);
    for (std::uint32_t i = 0; i < n; ++i) {
        contacts.candidates.clear();
        contacts.grid.near(centre[i], radius[i], contacts.candidates);
        std::sort(contacts.candidates.begin(), contacts.candidates.end());
        for (const std::uint32_t j : contacts.candidates) {
            const double distance = bodies.radius[i] + bodies.radius[j];
            if (j <= i || distance == 0 || (bodies.inverse_mass[i] == 0 && bodies.inverse_mass[j] == 0)) continue;
            consider(first_touch(paths[i], paths[j], distance, 0, end, walls.periodic), {i, j});
        }
    }
    return first;
}

}  // namespace

void fly_under_forces(const Impulse& solver, const Flight& flight, const Walls& walls, const Bodies& bodies,
                      State& state, double h, Contacts& contacts) {
    std::vector<Contact> resting;
    std::vector<Path> paths(state.size());
    double left = h;
    const std::size_t most = most_impacts * (state.size() + 1);
    for (std::size_t impacts = 0; left > 0; ++impacts) {
        const State before = state;
        const Memory remembered = flight.memory;
        flight.propose(state, left);
        for (std::size_t i = 0; i < paths.size(); ++i)
            paths[i] = hermite(before.x.linear[i], before.v.linear[i], state.x.linear[i], state.v.linear[i], left);
        const auto hit =
            impacts < most ? first_impact(solver, paths, walls, bodies, left, resting, contacts) : std::nullopt;
        if (!hit) break;

        const Contact& pair = hit->pair;
        state = before;
        flight.memory = remembered;
        if (hit->time > 0) flight.propose(state, hit->time);
        left -= hit->time;
        Touch touch = touch_of(pair, walls, bodies, state);
        const bool at_wall = pair.wall != Contact::no_wall;
        const Vec2 v = state.v.linear[pair.i] - (at_wall ? Vec2{} : state.v.linear[pair.j]);
        const Vec2 a =
            paths[pair.i].acceleration(hit->time) - (at_wall ? Vec2{} : paths[pair.j].acceleration(hit->time));
        const double rebound = touch.restitution * dot(v, touch.normal), pull = dot(a, touch.normal);
        if (pull > 0 && 2 * rebound <= shortest_bounce * h * pull) {
            resting.push_back(pair);
            touch.restitution = 0;
        }
        if (dot(v, touch.normal) > 0) collide(pair, touch, bodies, state, contacts);
        flight.memory.continues = false;
    }
    if (resting.empty()) return;
    settle_resting(resting, walls, bodies, flight.dynamics.gravity(), state, contacts);
    flight.memory.continues = false;
}

}  // namespace carom
