// Bodies that turn on what they lean on, as a block that tips over its edge. Levers that stayed as they were at the
// start of a substep would make a turn a way along its tangent: with those of its middle the way of a point is right to
// second order, and so are its forces. At the end the points are to be at rest that are there then.

#include <algorithm>
#include <cmath>

#include "solvers/shared.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

void note_pivots(const SoftScene& scene, const State& state, SoftContacts& contacts) {
    constexpr double hair = 1e-6;  // of the smaller one's size, in the step
    const auto note = [&](SoftContact& c) {
        const auto squared_way = [&](std::uint32_t row, Vec2 core) {
            const double angle = row < state.size() ? contacts.ahead * state.v.angular[row] : 0;
            return angle * angle * squared_length(core);
        };
        const double least = hair * c.size;
        const auto turns = [&](const ManifoldPoint& p) {
            return std::max(squared_way(c.a, p.core_a), squared_way(c.b, p.core_b)) > least * least;
        };
        c.pivots = c.rests && c.touched_before && !c.crowded &&
                   std::any_of(c.manifold.point, c.manifold.point + c.manifold.count, turns);
    };
    act_on_all(scene.threads, contacts.all, note);
}

Frame frame_ahead(const State& state, const SoftContacts& contacts, std::uint32_t row, double time) {
    if (time == 0 || row >= state.size()) return contacts.frames[row];
    return frame_at(state.x.linear[row] + time * state.v.linear[row],
                    state.x.angular[row] + time * state.v.angular[row]);
}

void turn_levers(SoftContacts& contacts) {
    for (const std::uint32_t index : contacts.changing) {
        const SoftContact& c = contacts.all[index];
        if (!c.pivots) continue;
        ContactBlock& block = contacts.blocks[c.block];
        const std::uint32_t k = c.row;
        const Vec2 n{block.normal_x[k], block.normal_y[k]};
        const auto turned = [&](std::uint32_t row, Vec2 core, Vec2 rim, Vec2 lever) {
            return cross(contacts.movers[row].w, contacts.frames[row].turn(core) + rim - lever);
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
