// Bodies that turn on what they lean on, as a block that tips over its edge. Levers that stayed as they were at the
// start of a substep would make a turn a way along its tangent: with those of its middle the way of a point is right to
// second order, and so are its forces. At the end the points are to be at rest that are there then.

#include "solvers/pivots.hpp"

#include <algorithm>

#include "solvers/shared.hpp"

namespace carom {

bool turns_in(double time, const SoftContact& c, double spin_a, double spin_b) {
    constexpr double hair = 1e-6;  // of the smaller one's size
    const auto turns = [&](double spin, Vec2 core) {
        const double angle = time * spin, least = hair * c.size;
        return angle * angle * squared_length(core) > least * least;
    };
    return std::any_of(c.manifold.point, c.manifold.point + c.manifold.count,
                       [&](const ManifoldPoint& p) { return turns(spin_a, p.core_a) || turns(spin_b, p.core_b); });
}

namespace {
/// Whether what is driven, or far larger, bends the way of a contact's points so much in that time [s] that a crowd on
/// it would sink in.
bool is_bent(double time, const SoftScene& scene, const SoftContact& c, double spin_a, double spin_b) {
    constexpr double little = 0.01, far = 4;  // of the smaller one's size
    const auto bends = [&](std::uint32_t row, double spin, Vec2 core) {
        const double lever = length(core), angle = time * spin;
        return (lever > far * c.size || !moves(scene, row)) && angle * angle * lever > little * c.size;
    };
    return std::any_of(c.manifold.point, c.manifold.point + c.manifold.count, [&](const ManifoldPoint& p) {
        return bends(c.a, spin_a, p.core_a) || bends(c.b, spin_b, p.core_b);
    });
}
}  // namespace

void note_pivots(const SoftScene& scene, const State& state, SoftContacts& contacts) {
    const auto spin = [&](std::uint32_t row) { return row < state.size() ? state.v.angular[row] : 0; };
    const double time = contacts.outlook.ahead;
    act_on_all(scene.threads, contacts.all, [&](SoftContact& c) {
        const double a = spin(c.a), b = spin(c.b);
        c.pivots = c.rests && c.touched_before && (c.crowded ? is_bent(time, scene, c, a, b) : turns_in(time, c, a, b));
    });
}

Frame frame_ahead(const State& state, const BodyMotion& motion, std::uint32_t row, double time) {
    if (time == 0 || row >= state.size()) return motion.frames[row];
    return frame_at(state.x.linear[row] + time * state.v.linear[row],
                    state.x.angular[row] + time * state.v.angular[row]);
}

void turn_levers(SoftContacts& contacts) {
    for (const std::uint32_t index : contacts.lists.changing) {
        const SoftContact& c = contacts.all[index];
        if (!c.pivots) continue;
        ContactBlock& block = contacts.layout.blocks[c.block];
        const std::uint32_t k = c.row;
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        const auto turned = [&](std::uint32_t row, Vec2 core, Vec2 rim, Vec2 lever) {
            return cross(contacts.motion.movers[row].w, contacts.motion.frames[row].turn(core) + rim - lever);
        };
        for (int i = 0; i < c.manifold.count; ++i) {
            auto& more = block.more[i];
            const Vec2 core_a{more.core_a_x[k], more.core_a_y[k]}, core_b{more.core_b_x[k], more.core_b_y[k]};
            const Vec2 faster = turned(c.b, core_b, -c.radius_b * n, lever_b_of(block, i, k)) -
                                turned(c.a, core_a, c.radius_a * n, lever_a_of(block, i, k));
            more.turned_normal[k] = dot(n, faster), more.turned_tangent[k] = cross(n, faster);
        }
    }
}

}  // namespace carom
