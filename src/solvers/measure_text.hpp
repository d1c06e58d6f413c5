#pragma once
// How far the contacts of a block are apart, and which way the normals of those that pass one another on a circle turn:
// part of the text of the kernels in solvers/contact_rows.hpp.

#include "simd/lanes.hpp"
#include "solvers/contact_rows.hpp"

namespace carom {
namespace {

struct Moving {
    Lanes2 v;
    Lanes w, inverse_mass;
};

/// The movers in these rows, which are four numbers each.
inline Moving gather(const Mover* movers, const uint32_t* rows) {
    static_assert(sizeof(Mover) == 4 * sizeof(double));
    const Lanes4 m = quads(&movers->vx, rows);
    return {{m.x, m.y}, m.z, m.w};
}
/// Bodies that nothing moves may be in several rows at once, and are left alone.
inline void scatter(const Moving& in, Mover* movers, const uint32_t* rows) {
    store_quads(&movers->vx, rows, {in.v.x, in.v.y, in.w, in.inverse_mass});
}

inline Lanes larger(Lanes a, Lanes b) { return select(a > b, a, b); }
inline Lanes smaller(Lanes a, Lanes b) { return select(a < b, a, b); }

inline Lanes2 turned(Lanes x, Lanes y, Lanes cosine, Lanes sine) {
    return {cosine * x - sine * y, sine * x + cosine * y};
}

/// Where two corners of some contacts are, from their bodies, and on the way from a to b.
struct Cores {
    Lanes2 on_a, on_b, between;
};

/// By what the gap of two rounded corners with these cores will be more after the way of a substep than that makes of
/// it along the normal: sweeps look along the normal, and so stop who goes past a corner as if he ran into its tangent.
inline Lanes bend_on_circle(const ContactBlock& block, size_t row, const Cores& cores, const Mover* movers, double h) {
    const auto at = [row](const double* numbers) { return load(numbers + row); };
    const Moving a = gather(movers, block.a + row), b = gather(movers, block.b + row);
    const Lanes2 n{at(block.normal_x), at(block.normal_y)};
    const Lanes2 way{all(h) * (b.v.x - b.w * cores.on_b.y - a.v.x + a.w * cores.on_a.y),
                     all(h) * (b.v.y + b.w * cores.on_b.x - a.v.y - a.w * cores.on_a.x)};
    const Lanes x = cores.between.x + way.x, y = cores.between.y + way.y;
    const Lanes along = x * n.x + y * n.y, across = y * n.x - x * n.y;
    // Who gets farther round meets another side of the corner.
    const Lanes beside = select(across < Lanes{}, -across, across);
    const Lanes bent = square_root(along * along + across * across) - along;
    return select((beside < along) & (at(block.corners) != Lanes{}), bent, Lanes{});
}

/// How rows have turned: impulses along the normals of now, less the same along those before.
struct Turned {
    Lanes2 normal, was;         ///< normals
    Lanes2 on_a, on_b;          ///< levers, along the normal and across
    Lanes2 was_on_a, was_on_b;  ///< before

    /// By what the two move more for it; sign is that of the body.
    Moving more(Lanes pressed, Lanes rubbed, double sign, Lanes inverse_mass, Lanes inverse_inertia) const {
        const Lanes2 &on = sign < 0 ? on_a : on_b, &was_on = sign < 0 ? was_on_a : was_on_b;
        const Lanes x = normal.x - was.x, y = normal.y - was.y, ease = all(sign) * inverse_mass;
        return {{ease * (pressed * x - rubbed * y), ease * (pressed * y + rubbed * x)},
                all(sign) * inverse_inertia * (rubbed * (on.x - was_on.x) - pressed * (on.y - was_on.y)),
                inverse_mass};
    }
};

/// Adds what both bodies of rows move more to how they move.
inline void add_more(const ContactBlock& block, size_t row, Mask where, const Turned& turned, Lanes pressed,
                     Lanes rubbed, Mover* movers) {
    if (!any(where & ((pressed != Lanes{}) | (rubbed != Lanes{})))) return;
    const auto add = [&](const uint32_t* rows, double sign, const double* inverse_inertia) {
        const Moving of = gather(movers, rows);
        const Moving more = turned.more(pressed, rubbed, sign, of.inverse_mass, load(inverse_inertia + row));
        const auto sum = [&](Lanes a, Lanes b) { return a + select(where, b, Lanes{}); };
        scatter({{sum(of.v.x, more.v.x), sum(of.v.y, more.v.y)}, sum(of.w, more.w), of.inverse_mass}, movers, rows);
    };
    add(block.a + row, -1, block.inverse_inertia_a), add(block.b + row, 1, block.inverse_inertia_b);
}

/// Turns the normals, and with them the levers, of rounded corners that pass one another to where their bodies are now,
/// in the midst of a substep. The impulses so far were along the normals before, where the bodies were then, and stay
/// so; what these would be more along those of now is their bodies' lead, with which they begin again. What is given
/// from now on, of the forces before to begin with, is along those of now.
inline void turn_normals(ContactBlock& block, size_t row, const Lanes4& a, const Lanes4& b, const Cores& c,
                         Mover* movers, const HalfBegin& half) {
    constexpr double least_turn = 1e-9;  // rad
    const auto at = [row](const double* numbers) { return load(numbers + row); };
    ContactBlock::Point& p = block.point[0];
    ContactBlock::More& more = block.more[0];
    const Lanes one = all(1), zero{};
    const Lanes2 n{at(block.normal_x), at(block.normal_y)};
    const Mask follows = (at(block.follows) != zero) & (c.between.x * n.x + c.between.y * n.y > zero);
    const Lanes distance = select(follows, square_root(c.between.x * c.between.x + c.between.y * c.between.y), one);
    const Lanes2 m{c.between.x / distance, c.between.y / distance};
    const Lanes sine = n.x * m.y - n.y * m.x;
    const Mask turns = follows & (sine * sine > all(least_turn * least_turn));
    const Lanes pressed = at(p.normal_impulse), rubbed = at(p.tangent_impulse);
    const auto note = [row, turns](double* numbers, Lanes value) {
        const Lanes now = select(turns, value, Lanes{});
        __builtin_memcpy(numbers + row, &now, sizeof now);
    };
    if (!any(turns)) {
        note(block.lag_along, zero), note(block.lag_across, zero);
        note(block.lag_turn_a, zero), note(block.lag_turn_b, zero);
        return;
    }
    const Lanes x = b.x - a.x, y = b.y - a.y;
    const Lanes2 between{x * m.x + y * m.y, y * m.x - x * m.y};
    const Lanes2 on_a{c.on_a.x * m.x + c.on_a.y * m.y + all(0.5) * (at(block.uneven) + distance),
                      c.on_a.y * m.x - c.on_a.x * m.y};
    const Lanes2 on_b{on_a.x - between.x, on_a.y - between.y};
    const Lanes2 was_on_a{at(p.lever_a_along), at(p.lever_a_across)};
    const Lanes2 was_on_b{was_on_a.x - at(block.between_along), was_on_a.y - at(block.between_across)};
    const Turned turned{m, n, on_a, on_b, was_on_a, was_on_b};
    const Lanes versine = one - (n.x * m.x + n.y * m.y);
    note(block.lag_along, versine * pressed - sine * rubbed);
    note(block.lag_across, sine * pressed + versine * rubbed);
    note(block.lag_turn_a, rubbed * (on_a.x - was_on_a.x) - pressed * (on_a.y - was_on_a.y));
    note(block.lag_turn_b, rubbed * (on_b.x - was_on_b.x) - pressed * (on_b.y - was_on_b.y));
    add_more(block, row, turns, turned, pressed, rubbed, half.leads);
    add_more(block, row, turns, turned, all(half.warm) * at(more.normal_force), all(half.warm) * at(more.tangent_force),
             movers);
    const auto put = [row, turns](double* numbers, Lanes value) {
        const Lanes now = select(turns, value, load(numbers + row));
        __builtin_memcpy(numbers + row, &now, sizeof now);
    };
    put(block.normal_x, m.x), put(block.normal_y, m.y);
    put(block.between_along, between.x), put(block.between_across, between.y);
    put(p.lever_a_along, on_a.x), put(p.lever_a_across, on_a.y);
    const Lanes of_both = gather(movers, block.a + row).inverse_mass + gather(movers, block.b + row).inverse_mass;
    const auto effective_mass = [&](Lanes arm_a, Lanes arm_b) {
        return one /
               (of_both + at(block.inverse_inertia_a) * arm_a * arm_a + at(block.inverse_inertia_b) * arm_b * arm_b);
    };
    put(p.normal_mass, effective_mass(on_a.y, on_b.y)), put(p.tangent_mass, effective_mass(on_a.x, on_b.x));
}

/// Measures the gaps of a block for bodies in these frames, that are about to move like this.
inline void measure(ContactBlock& block, const HalfBegin& half, Mover* movers) {
    constexpr double far = 1e300, hair = 1e-9, least_bend = 1e-12;  // of the radii
    block.any_deep = false;
    Mask any_bends{};
    for (size_t row = 0; row < block_rows; row += static_cast<size_t>(lanes)) {
        const auto at = [row](const double* numbers) { return load(numbers + row); };
        const Lanes4 a = quads(half.frames, block.a + row), b = quads(half.frames, block.b + row);
        for (uint32_t i = 0; i < block.points; ++i) {
            const ContactBlock::More& p = block.more[i];
            const Lanes2 on_a = turned(at(p.core_a_x), at(p.core_a_y), a.z, a.w);
            const Lanes2 on_b = turned(at(p.core_b_x), at(p.core_b_y), b.z, b.w);
            const Lanes dx = (b.x - a.x) + on_b.x - on_a.x, dy = (b.y - a.y) + on_b.y - on_a.y;
            if (block.any_corners && half.leads && i == 0)
                turn_normals(block, row, a, b, Cores{on_a, on_b, {dx, dy}}, movers, half);
            Lanes between = dx * at(block.normal_x) + dy * at(block.normal_y) - at(block.radii);
            if (block.any_corners && i == 0) {
                const Lanes bend = bend_on_circle(block, row, Cores{on_a, on_b, {dx, dy}}, movers, half.h);
                const Mask bends = bend > all(least_bend) * at(block.radii);
                any_bends |= bends;
                const Lanes after = between + bend;
                if (half.leads) {
                    // Who was pressed to where he is now is off by an error of the bend, and touches: he is to turn.
                    const Mask pressed = at(block.point[0].normal_impulse) > Lanes{};
                    const Mask touches = (between <= all(hair) * at(block.radii)) | (pressed & (between <= bend));
                    const Lanes closed = select(bends, smaller(between, Lanes{}), between);
                    between = select(touches, closed, after);
                } else {
                    between = after;
                }
            }
            if (block.any_preload && !block.is_precise) {
                const Lanes mass = at(block.point[i].normal_mass),
                            pressed_in = all(half.preload_way) * at(p.preload) / mass;
                between -= select(mass > Lanes{}, pressed_in, Lanes{});
            }
            const Lanes gap = select(at(p.open) != Lanes{}, all(far), between);
            block.any_deep |= any(gap < -at(block.shallow));
            __builtin_memcpy(block.point[i].gap + row, &gap, sizeof gap);
        }
    }
    block.is_measured = !any(any_bends);  // else for the velocities of now, and anew for those of the next half
}

}  // namespace
}  // namespace carom
