#include "solvers/time_of_impact.hpp"

namespace carom {

void advance_to_impacts(const Impulse& solver, const Flight& flight, const Walls& walls, const Bodies& bodies,
                        State& state, double h, Contacts& contacts) {
    const auto fly = flight.dynamics.is_free_flight() ? fly_freely : fly_under_forces;
    fly(solver, flight, walls, bodies, state, h, contacts);
}

Touch touch_of(const Contact& p, const Walls& walls, const Bodies& bodies, const State& state) {
    if (p.wall != Contact::no_wall) {
        const Wall& wall = walls.all[p.wall];
        return {-wall.normal, mixed_restitution(wall.restitution, bodies.restitution[p.i]),
                mixed_friction(wall.friction, bodies.friction[p.i])};
    }
    const Vec2 d = nearest_image(walls.periodic, state.x.linear[p.j] - state.x.linear[p.i]);
    const double distance = length(d);
    return {distance > 0 ? d / distance : Vec2{1, 0},
            mixed_restitution(bodies.restitution[p.i], bodies.restitution[p.j]),
            mixed_friction(bodies.friction[p.i], bodies.friction[p.j])};
}

void collide(const Contact& p, const Touch& touch, const Bodies& bodies, State& state, Contacts& contacts) {
    if (p.wall != Contact::no_wall)
        collide(p.i, touch, bodies, state.v, contacts);
    else
        collide(p.i, p.j, touch, bodies, state.v, contacts);
}

void settle_resting(const std::vector<Contact>& resting, const Walls& walls, const Bodies& bodies, Vec2 gravity,
                    State& state, Contacts& contacts) {
    for (const Contact& p : resting) {
        const Touch touch = touch_of(p, walls, bodies, state);
        const bool at_wall = p.wall != Contact::no_wall;
        const Vec2 d = at_wall ? Vec2{} : nearest_image(walls.periodic, state.x.linear[p.j] - state.x.linear[p.i]);
        const double gap =
            at_wall ? dot(walls.all[p.wall].normal, state.x.linear[p.i]) - walls.all[p.wall].offset - bodies.radius[p.i]
                    : dot(d, touch.normal) - bodies.radius[p.i] - bodies.radius[p.j];
        if (gap > 0) continue;
        const double mobility_i = bodies.inverse_mass[p.i], mobility_j = at_wall ? 0 : bodies.inverse_mass[p.j];
        const auto shift = [&](std::uint32_t i, double share) {
            const Vec2 by = share * gap * touch.normal;
            state.x.linear[i] += by;
            if (bodies.inverse_mass[i] != 0) contacts.work_overlap -= bodies.mass[i] * dot(gravity, by);
        };
        shift(p.i, mobility_i / (mobility_i + mobility_j));
        if (!at_wall) shift(p.j, -mobility_j / (mobility_i + mobility_j));
        const Vec2 other = at_wall ? Vec2{} : state.v.linear[p.j];
        if (dot(state.v.linear[p.i] - other, touch.normal) <= 0) continue;
        const auto counted = contacts.collisions;
        collide(p, {touch.normal, 0, touch.friction}, bodies, state, contacts);
        contacts.collisions = counted;  // it was at rest: no impact
    }
}

}  // namespace carom
