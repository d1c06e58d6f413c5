// Bodies that turn on what they lean on, as a block that tips over its edge. Levers that stayed as they were at the
// start of a substep would make a turn a way along its tangent: with those of its middle the way of a point is right to
// second order, and so are its forces. At the end the points are to be at rest that are there then.

#include "solvers/pivots.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/shared.hpp"

namespace carom {

bool turns_in(double time, const SoftContact& c, double spin_a, double spin_b) {
    constexpr double hair = 1e-6;              // of the smaller one's size
    const bool rolls = c.manifold.count == 1;  // a round rim, over which the point goes on: of a side it turns along
    const auto turns = [&](double spin, Vec2 core, double radius) {
        const double angle = time * spin, least = hair * c.size, rim = rolls ? 0 : radius;
        return angle * angle * (squared_length(core) + rim * rim) > least * least;
    };
    return std::any_of(c.manifold.point, c.manifold.point + c.manifold.count, [&](const ManifoldPoint& p) {
        return turns(spin_a, p.core_a, c.radius_a) || turns(spin_b, p.core_b, c.radius_b);
    });
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

namespace {

/// Where the bodies of a contact meet at the end of a substep: a corner, and what it has gone on to since the middle.
struct Meeting {
    Vec2 normal, core_a, core_b;  ///< from the bodies' positions
};

/// A normal that has turned on by a little [rad].
Vec2 turned_on(Vec2 normal, double angle) {
    const Vec2 m = normal + angle * perpendicular(normal);
    return m / length(m);
}

/// How corners go round one another of which one is round.
Meeting go_round(Vec2 between, Meeting m) {
    const Vec2 way = between + m.core_b - m.core_a;
    if (dot(way, m.normal) > 0) m.normal = way / length(way);
    return m;
}

/// How a corner, or a round rim, goes on along a straight edge that has turned by so much [rad] since its foot was
/// found there: the normal is the edge's.
Meeting go_along(bool edge_of_a, double turned, Vec2 between, Meeting m) {
    m.normal = turned_on(m.normal, turned);
    const Vec2 way = between + m.core_b - m.core_a, aside = way - dot(way, m.normal) * m.normal;
    (edge_of_a ? m.core_a : m.core_b) += (edge_of_a ? 1 : -1) * aside;
    return m;
}

}  // namespace

void turn_levers(double h, SoftContacts& contacts) {
    const std::vector<Mover>& movers = contacts.motion.movers;
    const std::vector<Frame>& frames = contacts.motion.frames;
    for (const std::uint32_t index : contacts.lists.changing) {
        const SoftContact& c = contacts.all[index];
        if (!c.pivots) continue;
        ContactBlock& block = contacts.layout.blocks[c.block];
        const std::uint32_t k = c.row;
        const Mover &a = movers[c.a], &b = movers[c.b];
        const Vec2 n{block.normal_x[k], block.normal_y[k]}, between = frames[c.b].position - frames[c.a].position;
        const auto speed = [&](const Meeting& m) {
            const Vec2 on_a = m.core_a + c.radius_a * m.normal, on_b = m.core_b - c.radius_b * m.normal;
            return Vec2{b.vx, b.vy} + cross(b.w, on_b) - Vec2{a.vx, a.vy} - cross(a.w, on_a);
        };
        for (int i = 0; i < c.manifold.count; ++i) {
            auto& more = block.more[i];
            // Gaps stay those between the points that the first half brought together.
            Meeting end{n, frames[c.a].turn({more.core_a_x[k], more.core_a_y[k]}),
                        frames[c.b].turn({more.core_b_x[k], more.core_b_y[k]})};
            if (rounds_a_corner(c))
                end = go_round(between, end);
            else if (const bool of_a = c.manifold.point[i].is_on_edge_of_a(); !c.manifold.corners)
                end = go_along(of_a, 0.5 * h * (of_a ? a : b).w, between, end);
            const Vec2 now = speed(end);
            const Vec2 of_block = Vec2{b.vx, b.vy} + cross(b.w, lever_b_of(block, i, k)) - Vec2{a.vx, a.vy} -
                                  cross(a.w, lever_a_of(block, i, k));
            more.turned_normal[k] = dot(end.normal, now) - dot(n, of_block);
            more.turned_tangent[k] = cross(end.normal, now) - cross(n, of_block);
        }
        block.corners[k] = 0;
    }
}

}  // namespace carom
