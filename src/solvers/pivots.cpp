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

/// Where the bodies of a contact meet at the end of a substep: at the point that was found in the middle, or where a
/// round rim has rolled on to since.
struct Meeting {
    Vec2 normal, core_a, core_b;  ///< from the bodies' positions
};

/// A normal that has turned on by a little [rad].
Vec2 turned_on(Vec2 normal, double angle) {
    const Vec2 m = normal + angle * perpendicular(normal);
    return m / length(m);
}

/// As much as two turn alike: so do sides that lie on one another, and their normal.
double common(double spin_a, double spin_b) {
    return spin_a * spin_b <= 0 ? 0 : std::abs(spin_a) < std::abs(spin_b) ? spin_a : spin_b;
}

/// How a round rim meets a corner, or a straight edge that has turned by so much [rad] since its foot was found there.
Meeting roll_on(const SoftContact& c, bool edge_of_a, double turned, Vec2 between, Meeting m) {
    const Vec2 way = between + m.core_b - m.core_a;
    if (c.manifold.corners) {
        if (dot(way, m.normal) > 0) m.normal = way / length(way);
        return m;
    }
    m.normal = turned_on(m.normal, turned);
    const Vec2 aside = way - dot(way, m.normal) * m.normal;
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
        const bool rolls = c.manifold.count == 1 && (rounds_a_corner(c) || (c.is_single && !c.at_wall));
        const bool edge_of_a = c.piece_a < contacts.pieces.tags.size() && !contacts.pieces.tags[c.piece_a].is_single;
        const auto speed = [&](const Meeting& m) {
            const Vec2 on_a = m.core_a + c.radius_a * m.normal, on_b = m.core_b - c.radius_b * m.normal;
            return Vec2{b.vx, b.vy} + cross(b.w, on_b) - Vec2{a.vx, a.vy} - cross(a.w, on_a);
        };
        for (int i = 0; i < c.manifold.count; ++i) {
            auto& more = block.more[i];
            Meeting end{n, frames[c.a].turn({more.core_a_x[k], more.core_a_y[k]}),
                        frames[c.b].turn({more.core_b_x[k], more.core_b_y[k]})};
            if (rolls)
                end = roll_on(c, edge_of_a, 0.5 * h * (edge_of_a ? a : b).w, between, end);
            else if (c.manifold.count == 2)
                end.normal = turned_on(n, 0.5 * h * common(a.w, b.w));
            const Vec2 now = speed(end);
            const Vec2 of_block = Vec2{b.vx, b.vy} + cross(b.w, lever_b_of(block, i, k)) - Vec2{a.vx, a.vy} -
                                  cross(a.w, lever_a_of(block, i, k));
            more.turned_normal[k] = dot(end.normal, now) - dot(n, of_block);
            more.turned_tangent[k] = cross(end.normal, now) - cross(n, of_block);
            if (!rolls) continue;
            const Vec2 core_a = frames[c.a].turn_back(end.core_a), core_b = frames[c.b].turn_back(end.core_b);
            more.core_a_x[k] = core_a.x, more.core_a_y[k] = core_a.y;
            more.core_b_x[k] = core_b.x, more.core_b_y[k] = core_b.y;
            block.corners[k] = 0;
        }
    }
}

}  // namespace carom
