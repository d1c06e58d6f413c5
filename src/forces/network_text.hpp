#pragma once
// Springs between centres: what the kernels (forces/network_kernel.hpp) do in lanes, and what a world of a few bodies
// does spring by spring, without a call through a table.

#include "forces/network_layout.hpp"
#include "simd/single.hpp"

namespace carom {
namespace {

/// One column's springs at a group, seen from its bodies.
template <class Number, class Vector>
struct Stretched {
    Vector d;                   ///< to the partner
    Number inverse;             ///< the unit vector is d × inverse; a division takes as long as all the rest
    Number stiffness, stretch;  ///< k and |d| − L
};

/// Inline even where it is long: as a call it would hand all its vectors over in memory.
template <class Number, class Vector>
[[gnu::always_inline]] inline Stretched<Number, Vector> stretched(Vector own, Vector partner, Number onward,
                                                                  Number stiffness, Number rest_length) {
    Vector d{partner.x - own.x, partner.y - own.y};
    const Number squared = d.x * d.x + d.y * d.y, length = square_root(squared), zero{};
    // At length zero Hooke's force has no direction of its own; any will do whose opposite the other end takes.
    const auto apart = squared != zero;
    d.x = select(apart, d.x, onward);
    return {d, 1 / select(apart, length, zero + 1), stiffness, length - rest_length};
}

/// Calls act(link, a, b, stretched) for all springs between a few bodies, from the lower row a to the higher, b.
template <class Act>
[[gnu::always_inline]] inline void for_each_link(const FewLinks& net, const double* x, Act act) {
    for (const Link* link = net.links; link != net.links + net.count; ++link) {
        const Single a{link->a, link->a}, b{link->b, link->b};
        act(*link, a, b, stretched(a.of(x), b.of(x), 1.0, link->stiffness, link->rest_length));
    }
}
inline void give(double* force, const Single& g, Single2 f) {
    const Single2 before = g.of(force);
    store_pairs(force + 2 * g.row, Single2{before.x + f.x, before.y + f.y}, 1);
}

/// Adds the forces of damping; returns the heat. Each body's are added up before they meet the others, as in lanes.
inline double damp_few(const FewLinks& net, const double* x, const double* v, double* force) {
    double drag[2 * most_few] = {}, heat[most_few] = {}, sum = 0;
    for_each_link(net, x, [&](const Link& link, const Single& a, const Single& b, const auto& s) {
        const Single2 from = a.of(v), to = b.of(v);
        const double rate = ((to.x - from.x) * s.d.x + (to.y - from.y) * s.d.y) * s.inverse;
        const double damped = link.damping * rate;
        const Single2 pull{damped * s.inverse * s.d.x, damped * s.inverse * s.d.y};
        give(drag, a, pull);
        give(drag, b, {-pull.x, -pull.y});
        heat[a.row] += 0.5 * damped * rate;
        heat[b.row] += 0.5 * damped * rate;
    });
    for (size_t row = 0; row < net.rows; ++row) {
        const Single g{row, row};
        give(force, g, g.of(drag));
        sum += heat[row];
    }
    return sum;
}

/// Writes the forces on the bodies of a network of so few rows that it keeps its springs one by one, in the order in
/// which a body's columns would be. Each is computed once, for both ends, and to the bits that lanes have.
template <class SumOf>
[[gnu::always_inline]] inline NetworkPowers forces_on_few(const FewLinks& net, const double* x, const double* v,
                                                          double* force) {
    for (size_t row = 0; row < net.rows; ++row) store_pairs(force + 2 * row, Single2{0, 0}, 1);
    for_each_link(net, x, [&](const Link&, const Single& a, const Single& b, const auto& s) {
        const double tension = s.stiffness * s.stretch * s.inverse;
        const Single2 pull{tension * s.d.x, tension * s.d.y};
        give(force, a, pull);
        give(force, b, {-pull.x, -pull.y});
    });
    SumOf elastic;
    for (size_t row = 0; row < net.rows; ++row) {
        const Single g{row, row};
        const Single2 velocity = g.of(v), pull = g.of(force);
        elastic.add(g, pull.x * velocity.x + pull.y * velocity.y);
    }
    return {elastic.total(), net.damped ? damp_few(net, x, v, force) : 0};
}

}  // namespace
}  // namespace carom
