#pragma once
// What a row of a block is made of, for as many contacts as there are lanes (solvers/contact_kernel.hpp) and for one
// (contact_rows.cpp). R says how numbers of contacts and bodies are read, and where columns are written.

#include "simd/single.hpp"
#include "solvers/contact_rows.hpp"

namespace carom {
namespace {

/// Sizes in a second by which overlap is undone at most.
constexpr double sizes_recovered = 0.5;
/// A contact is a spring down to an overlap of so many sizes: see docs/theory/softstep.md, deep ones.
constexpr double shallow_size = 0.01;

/// What is the same for both points of a contact.
template <class Number>
struct RowFrame {
    Number normal_x, normal_y, between_x, between_y, radius_a, radius_b;
    Number along, across;  ///< between, along the normal and across
    Number inverse_mass, inverse_inertia_a, inverse_inertia_b;

    Number along_normal(Number x, Number y) const { return x * normal_x + y * normal_y; }
    Number across_normal(Number x, Number y) const { return x * -normal_y + y * normal_x; }
    /// Of both bodies, with these levers.
    Number effective_mass(Number arm_a, Number arm_b) const {
        return 1 / (inverse_mass + inverse_inertia_a * arm_a * arm_a + inverse_inertia_b * arm_b * arm_b);
    }
};

template <class R, class Frame>
inline void write_point(const R& r, const Frame& f, uint32_t i, ContactBlock& block) {
    using Number = typename R::Number;
    const Number zero{};
    ContactBlock::Point& p = block.point[i];
    ContactBlock::More& more = block.more[i];
    const auto exists = r.has_point(i);
    r.put(more.open, select(exists, zero, zero + 1));
    if (!any(exists) && r.is_blank()) return;
    const auto put = [&](double* numbers, Number value) { r.put(numbers, select(exists, value, zero)); };
    const auto a = r.frame_a(), b = r.frame_b();  // x, y, cosine, sine
    const auto core = r.four(r.from.at.point + i * r.from.at.point_length);
    // A wall's point is where its contact is, as seen from the body.
    const Number core_x = select(r.is_at_wall(), f.between_x + core.x, core.x);
    const Number core_y = select(r.is_at_wall(), f.between_y + core.y, core.y);
    put(more.core_a_x, a.z * core_x + a.w * core_y), put(more.core_a_y, a.z * core_y - a.w * core_x);
    put(more.core_b_x, b.z * core.z + b.w * core.w), put(more.core_b_y, b.z * core.w - b.w * core.z);
    const Number lever_x = 0.5 * (core_x + f.radius_a * f.normal_x + f.between_x + core.z - f.radius_b * f.normal_x);
    const Number lever_y = 0.5 * (core_y + f.radius_a * f.normal_y + f.between_y + core.w - f.radius_b * f.normal_y);
    const Number along = f.along_normal(lever_x, lever_y), across = f.across_normal(lever_x, lever_y);
    put(p.lever_a_along, along), put(p.lever_a_across, across);
    put(p.normal_mass, f.effective_mass(across, across - f.across));
    put(p.tangent_mass, f.effective_mass(along, along - f.along));
    put(more.normal_force, r.number(r.from.at.normal_force + i));
    put(more.tangent_force, r.number(r.from.at.tangent_force + i));
    put(more.rolling_moment, r.number(r.from.at.rolling_moment + i));
    put(more.turned_normal, zero), put(more.turned_tangent, zero);
    if (block.any_preload) put(more.preload, r.number(r.from.at.preload + i));
}

/// Writes rows for bodies in their frames, whose numbers stand in the block already, with the impulses as they are.
template <class R>
inline void write_rows(const R& r, ContactBlock& block) {
    using Number = typename R::Number;
    const Number zero{};
    const auto extent = r.four(r.from.at.size);       // size, thickness, restitution
    const auto surface = r.four(r.from.at.friction);  // friction, surface speed, rolling, radius a
    const auto turned = r.four(r.from.at.radius_b);   // radius b, normal
    const auto a = r.frame_a(), b = r.frame_b();
    const Number iia = r.inverse_inertia_a(), iib = r.inverse_inertia_b(), ii = iia + iib;
    RowFrame<Number> f{turned.y, turned.z, b.x - a.x,        b.y - a.y, surface.w, turned.x,
                       {},       {},       r.inverse_mass(), iia,       iib};
    f.along = f.along_normal(f.between_x, f.between_y), f.across = f.across_normal(f.between_x, f.between_y);
    r.put(block.normal_x, turned.y), r.put(block.normal_y, turned.z);
    r.put(block.between_along, f.along), r.put(block.between_across, f.across);
    r.put(block.inverse_inertia_a, iia), r.put(block.inverse_inertia_b, iib);
    r.put(block.friction, surface.x), r.put(block.surface_speed, surface.y), r.put(block.rolling, surface.z);
    r.put(block.restitution, select(r.is_let_bounce(), extent.z, zero));
    r.put(block.rolling_mass, select(ii > zero, 1 / ii, zero));
    r.put(block.recovery, sizes_recovered * extent.x), r.put(block.shallow, shallow_size * extent.x);
    r.put(block.radii, surface.w + turned.x), r.put(block.uneven, surface.w - turned.x);
    r.put(block.follows, select(r.follows_corner(), zero + 1, zero));
    r.put(block.lag_along, zero), r.put(block.lag_across, zero);
    r.put(block.lag_turn_a, zero), r.put(block.lag_turn_b, zero);
    r.put(block.corners, select(r.rounds_a_corner(), zero + 1, zero));
    for (uint32_t i = 0; i < block.points; ++i) write_point(r, f, i, block);
}

}  // namespace
}  // namespace carom
