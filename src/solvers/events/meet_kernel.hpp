#pragma once
// The text of the kernel in solvers/events/meet.hpp, compiled once for each instruction set. A point flies straight as
// another sees it, for both fall alike: |d + u t|² = r². Solved without a difference of like numbers.

#include "simd/lanes.hpp"
#include "solvers/events/meet.hpp"

namespace carom {
namespace {

void times(const GasView& a, const uint32_t* slots, const double* offset_x, const double* offset_y, double* out) {
    const bool falls = a.gravity_x != 0 || a.gravity_y != 0;
    const Lanes zero{};
    for (size_t k = 0; k < cells_around; k += static_cast<size_t>(lanes)) {
        // A record is four pairs of numbers.
        const auto part = [&](size_t which) {
            return pairs(a.discs + 2 * which,
                         [slots, k](int lane) { return 4 * static_cast<size_t>(slots[k + lane]); });
        };
        const Lanes2 x = part(0), v = part(1);
        const Lanes clock = part(2).x;
        Lanes reach = all(a.radius + a.radii[0]);
        if (a.radius_mask != 0)
            for (int lane = 0; lane < lanes; ++lane) reach[lane] = a.radius + a.radii[slots[k + lane]];
        // From the later of their two clocks on: whoever foresees the meeting, and when, the bits are the same.
        const Lanes from = select(clock > all(a.clock), clock, all(a.clock));
        const Lanes t = from - clock, s = from - all(a.clock);
        Lanes2 d, u;
        if (falls) {
            const Lanes half_t = all(0.5) * t, half_s = all(0.5) * s, gx = all(a.gravity_x), gy = all(a.gravity_y);
            d = {(x.x + t * (v.x + half_t * gx)) - (all(a.x) + s * (all(a.vx) + half_s * gx)),
                 (x.y + t * (v.y + half_t * gy)) - (all(a.y) + s * (all(a.vy) + half_s * gy))};
            u = {(v.x + t * gx) - (all(a.vx) + s * gx), (v.y + t * gy) - (all(a.vy) + s * gy)};
        } else {
            d = {(x.x + t * v.x) - (all(a.x) + s * all(a.vx)), (x.y + t * v.y) - (all(a.y) + s * all(a.vy))};
            u = {v.x - all(a.vx), v.y - all(a.vy)};
        }
        d = {load(offset_x + k) + d.x, load(offset_y + k) + d.y};
        const Lanes b = d.x * u.x + d.y * u.y, c = (d.x * d.x + d.y * d.y) - reach * reach;
        const Lanes inside = b * b - (u.x * u.x + u.y * u.y) * c;
        const Mask touching = c <= zero, meets = (b < zero) & ((inside >= zero) | touching);
        const Lanes later = from + c / (square_root(select(inside > zero, inside, zero)) - b);
        const Lanes time = select(meets, select(touching, from, later), all(__builtin_inf()));
        __builtin_memcpy(out + k, &time, sizeof time);
    }
}

}  // namespace
}  // namespace carom
