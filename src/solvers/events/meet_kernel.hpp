#pragma once
// The text of the kernel in solvers/events/meet.hpp, compiled once for each instruction set. A point flies straight as
// another sees it, for both fall alike: |d + u t|² = r². Solved without a difference of like numbers.

#include "simd/lanes.hpp"
#include "solvers/events/meet.hpp"

namespace carom {
namespace {

/// A disc at its own time, and what is the same of all that it meets.
struct Looking {
    double x, y, vx, vy, clock, radius;
    bool fall, alike;
};

Lanes times(const GasView& discs, const Looking& a, const uint32_t* slots, const uint8_t* cells,
            const double* offsets) {
    const Lanes zero{};
    // A record is two rows of four numbers, of which the second begins with the clock.
    const Lanes4 xv = quads_of(discs.discs, [slots](int lane) { return 2 * static_cast<size_t>(slots[lane]); });
    Lanes clock{};
    for (int lane = 0; lane < lanes; ++lane) clock[lane] = discs.discs[8 * static_cast<size_t>(slots[lane]) + 4];
    const Lanes2 offset = pairs(offsets, [cells](int lane) { return cells[lane]; });
    const Lanes reach = all(a.radius) + (a.alike ? all(a.radius) : numbers(discs.radii, slots));
    // From the later of their two clocks on: whoever foresees the meeting, and when, the bits are the same.
    const Lanes from = select(clock > all(a.clock), clock, all(a.clock));
    const Lanes t = from - clock, s = from - all(a.clock);
    Lanes2 d, u;
    if (a.fall) {
        const Lanes half_t = all(0.5) * t, half_s = all(0.5) * s, gx = all(discs.gravity_x), gy = all(discs.gravity_y);
        d = {(xv.x + t * (xv.z + half_t * gx)) - (all(a.x) + s * (all(a.vx) + half_s * gx)),
             (xv.y + t * (xv.w + half_t * gy)) - (all(a.y) + s * (all(a.vy) + half_s * gy))};
        u = {(xv.z + t * gx) - (all(a.vx) + s * gx), (xv.w + t * gy) - (all(a.vy) + s * gy)};
    } else {
        d = {(xv.x + t * xv.z) - (all(a.x) + s * all(a.vx)), (xv.y + t * xv.w) - (all(a.y) + s * all(a.vy))};
        u = {xv.z - all(a.vx), xv.w - all(a.vy)};
    }
    d = {offset.x + d.x, offset.y + d.y};
    const Lanes b = d.x * u.x + d.y * u.y, c = (d.x * d.x + d.y * d.y) - reach * reach;
    const Lanes inside = b * b - (u.x * u.x + u.y * u.y) * c;
    const Mask touching = c <= zero, meets = (b < zero) & ((inside >= zero) | touching) & (reach > zero);
    const Lanes later = from + c / (square_root(select(inside > zero, inside, zero)) - b);
    return select(meets, select(touching, from, later), all(__builtin_inf()));
}

GasSoonest soonest(const GasView& discs, uint32_t disc, GasOthers& others, const double* offsets) {
    const double* const own = discs.discs + 8 * static_cast<size_t>(disc);
    const bool fall = discs.gravity_x != 0 || discs.gravity_y != 0, alike = discs.radius_mask == 0;
    const Looking a{own[0], own[1], own[2], own[3], own[4], discs.radii[disc & discs.radius_mask], fall, alike};
    const size_t count = others.count;
    constexpr size_t wide = static_cast<size_t>(lanes);
    Lanes first = all(__builtin_inf());
    for (size_t k = 0; k < count; k += wide) {
        const Lanes time = times(discs, a, others.slot + k, others.cell + k, offsets);
        first = select(time < first, time, first);
        __builtin_memcpy(others.time + k, &time, sizeof time);
    }
    const double time = lowest(first);
    uint64_t which = 0;
    for (size_t k = 0; k < count; k += wide) which |= bits(load(others.time + k) == all(time)) << k;
    return {time, which};
}

}  // namespace
}  // namespace carom
