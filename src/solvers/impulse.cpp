#include "solvers/impulse.hpp"

#include <algorithm>

#include "solvers/time_of_impact.hpp"

namespace carom {

bool anything_collides(const Impulse& solver, const Bodies& bodies, const Walls& walls) {
    if (!walls.all.empty()) return true;
    return solver.disc_collisions && bodies.size() > 1 &&
           std::any_of(bodies.radius.begin(), bodies.radius.end(), [](double r) { return r > 0; });
}

void advance(const Impulse& solver, const Flight& flight, const Walls& walls, const Bodies& bodies, State& state,
             double h, Contacts& contacts) {
    if (solver.time_of_impact) return advance_to_impacts(solver, flight, walls, bodies, state, h, contacts);
    flight.propose(state, h);
    collide_overlapping(solver, walls, bodies, flight.dynamics.gravity(), state, contacts);
    flight.memory.continues = false;
}

namespace {

void bounce_off_walls(const Walls& walls, const Bodies& bodies, Vec2 gravity, State& state, Contacts& contacts) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.inverse_mass[i] == 0) continue;
        for (const Wall& wall : walls.all) {
            const double depth = wall.offset + bodies.radius[i] - dot(wall.normal, state.x.linear[i]);
            if (depth <= 0) continue;
            shift(i, depth * wall.normal, bodies, gravity, state);
            if (dot(state.v.linear[i], wall.normal) < 0)
                contacts.collisions +=
                    collide(i,
                            {-wall.normal, mixed_restitution(bodies, wall.restitution, bodies.restitution[i]),
                             mixed_friction(bodies, wall.friction, bodies.friction[i])},
                            bodies, state);
        }
    }
}

/// Returns whether body i was moved.
bool separate(std::size_t i, std::size_t j, const Walls& walls, const Bodies& bodies, Vec2 gravity, State& state,
              Contacts& contacts) {
    const bool i_moves = bodies.inverse_mass[i] != 0, j_moves = bodies.inverse_mass[j] != 0;
    if (!i_moves && !j_moves) return false;
    const Vec2 d = nearest_image(walls.periodic, state.x.linear[j] - state.x.linear[i]);
    const double distance = length(d), overlap = bodies.radius[i] + bodies.radius[j] - distance;
    if (overlap <= 0) return false;
    const Vec2 n = distance > 0 ? d / distance : Vec2{1, 0};
    const double share = i_moves && j_moves ? 0.5 : 1;
    if (i_moves) shift(i, -share * overlap * n, bodies, gravity, state);
    if (j_moves) shift(j, share * overlap * n, bodies, gravity, state);
    contacts.collisions += collide(i, j,
                                   {n, mixed_restitution(bodies, bodies.restitution[i], bodies.restitution[j]),
                                    mixed_friction(bodies, bodies.friction[i], bodies.friction[j])},
                                   bodies, state);
    return true;
}

/// All pairs i < j in order, as if every one were looked at. A push may bring new neighbours: a disc that was pushed
/// looks for them with some room around it, and again when it has left that room; the grid follows the discs.
void separate_discs(const Walls& walls, const Bodies& bodies, Vec2 gravity, State& state, Contacts& contacts) {
    Grid& grid = contacts.grid;
    auto& near = contacts.candidates;
    grid.build(state.x.linear, bodies.radius, walls.periodic);
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
        double room = 0;
        Vec2 seen_from{};
        const auto look = [&](std::uint32_t after) {
            near.clear();
            seen_from = state.x.linear[i];
            grid.near(seen_from, bodies.radius[i] + room, near);
            std::erase_if(near, [after](std::uint32_t j) { return j <= after; });
            std::sort(near.begin(), near.end());
        };
        look(i);
        for (std::size_t k = 0; k < near.size(); ++k) {
            const std::uint32_t j = near[k];
            if (!separate(i, j, walls, bodies, gravity, state, contacts)) continue;
            grid.move(j, state.x.linear[j], bodies.radius[j]);
            if (length(state.x.linear[i] - seen_from) <= 0.99 * room) continue;
            room = 0.25 * bodies.radius[i];
            look(j);
            k = static_cast<std::size_t>(-1);
        }
        grid.move(i, state.x.linear[i], bodies.radius[i]);
    }
}

}  // namespace

void collide_overlapping(const Impulse& solver, const Walls& walls, const Bodies& bodies, Vec2 gravity, State& state,
                         Contacts& contacts) {
    bounce_off_walls(walls, bodies, gravity, state, contacts);
    if (solver.disc_collisions) separate_discs(walls, bodies, gravity, state, contacts);
}

}  // namespace carom
