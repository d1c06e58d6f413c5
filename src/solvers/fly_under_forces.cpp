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
    // Next to the roots of polynomials a glance costs nothing, and does for most once an early impact is known.
    const auto until = [&] { return first ? first->time : end; };
    const auto n = static_cast<std::uint32_t>(paths.size());
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t w = 0; bodies.inverse_mass[i] != 0 && w < walls.all.size(); ++w)
            if (!stay_apart(paths[i], bodies.radius[i], walls.all[w], 0, until()))
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
            if (!stay_apart(paths[i], paths[j], distance, 0, until(), walls.periodic))
                consider(first_touch(paths[i], paths[j], distance, 0, end, walls.periodic), {i, j});
        }
    }
    return first;
}

/// Lets a pair bounce, or come to rest, at a time [s] of the step of h. A bounce harder than what presses the two in a
/// step ends the rest of others on them.
void bounce(const FirstImpact& hit, const std::vector<Path>& paths, const Walls& walls, const Bodies& bodies, double h,
            double time, std::size_t impacts, State& state, std::vector<Contact>& resting, Squeezed& squeezed,
            Contacts& contacts) {
    const auto [i, j, wall] = hit.pair;
    const bool at_wall = wall != Contact::no_wall;
    Touch touch = touch_of(hit.pair, walls, bodies, state);
    const double approach = dot(state.v.linear[i] - (at_wall ? Vec2{} : state.v.linear[j]), touch.normal);
    const Vec2 a = paths[i].acceleration(hit.time), b = at_wall ? Vec2{} : paths[j].acceleration(hit.time);
    const double press = std::max(length(a), length(b));
    const double distance = bodies.radius[i] + bodies.radius[at_wall ? i : j];
    double pull = dot(a - b, touch.normal);
    if (!at_wall) pull = pull_of(pull, touch.restitution, press, distance, h);
    const Bounce how{touch.restitution, approach, pull, distance};
    if (squeezed.hold(hit.pair, touch.normal, how, time, bodies, state, impacts) || comes_to_rest(how, h, impacts)) {
        touch.restitution = 0;
        resting.push_back(hit.pair);
    } else if (approach > h * press) {
        std::erase_if(resting,
                      [i = i, j = j](const Contact& c) { return c.i == i || c.j == i || c.i == j || c.j == j; });
    }
    if (approach <= 0) return;
    collide(hit.pair, touch, bodies, state);
    ++contacts.collisions;
}

}  // namespace

void fly_under_forces(const Impulse& solver, const Flight& flight, const Walls& walls, const Bodies& bodies,
                      State& state, double h, Contacts& contacts) {
    std::vector<Contact> resting;
    Squeezed squeezed(bodies);
    std::vector<Path> paths(state.size());
    double left = h;
    for (std::size_t impacts = 0; left > 0; ++impacts) {
        const State before = state;
        const Memory remembered = flight.memory;
        flight.propose(state, left);
        for (std::size_t i = 0; i < paths.size(); ++i)
            paths[i] = hermite(before.x.linear[i], before.v.linear[i], state.x.linear[i], state.v.linear[i], left);
        const auto hit = first_impact(solver, paths, walls, bodies, left, resting, contacts);
        if (!hit) break;

        state = before;
        flight.memory = remembered;
        if (hit->time > 0) flight.propose(state, hit->time);
        left -= hit->time;
        bounce(*hit, paths, walls, bodies, h, h - left, impacts / (state.size() + 1), state, resting, squeezed,
               contacts);
        flight.memory.continues = false;
    }
    if (resting.empty()) return;
    settle_resting(resting, solver, walls, bodies, flight.dynamics.gravity(), state, contacts);
    flight.memory.continues = false;
}

}  // namespace carom
