#pragma once
// The kernels in solvers/mover_rows.hpp, compiled once for each instruction set.

#include "math/elementary.hpp"
#include "math/trigonometry_text.hpp"
#include "simd/groups.hpp"
#include "simd/single.hpp"

namespace carom {
namespace {

/// The bits of portable::sincos in every lane.
inline Lanes2 sine_and_cosine(Lanes x) {
    const Lanes zero{}, size = select(x < zero, -x, x);
    const auto reduced = portable::reduce_cody_waite(x);
    const Mask near = size <= all(portable::quarter_pi);
    const Lanes high = select(near, x, reduced.rest.high), low = select(near, zero, reduced.rest.low);
    const auto s = portable::sine_of_rest(high, low), c = portable::cosine_of_rest(high, low);
    const Lanes sine = s.high + s.low, cosine = c.high + c.low;
    const Mask quadrant = ~near & (Mask)reduced.multiple & 3;
    const Mask odd = (quadrant & 1) != 0, turned = (quadrant & 2) != 0, turned_next = ((quadrant + 1) & 2) != 0;
    Lanes2 out{select(odd, cosine, sine), select(odd, sine, cosine)};
    out = {select(turned, -out.x, out.x), select(turned_next, -out.y, out.y)};
    out.x = select(size < all(0x1p-27), x, out.x);
    const Mask is_usual = size <= all(portable::most_cody_waite);
    if (any(~is_usual))
        for (int lane = 0; lane < lanes; ++lane) {
            if (is_usual[lane]) continue;
            const portable::SinCos turned_far = portable::sincos(x[lane]);
            out.x[lane] = turned_far.sin, out.y[lane] = turned_far.cos;
        }
    return out;
}

}  // namespace
}  // namespace carom

#include "solvers/mover_text.hpp"

namespace carom {
namespace {

/// Calls work(group) for whole groups of rows, and for those left over one by one: a few cost no more than they do.
template <class Work>
inline void for_each_of(const MoverRows& m, size_t first, size_t last, Work work) {
    constexpr auto some = static_cast<size_t>(lanes);
    const size_t end = last < m.rows ? last : m.rows;
    for (; first + some <= end; first += some) work(Group{first, first % chunk_rows, end - first});
    for_each_single(first, end, work);
}

void place(const MoverRows& m, const double* inverse_mass, size_t first, size_t last) {
    for_each_of(m, first, last, [&](const auto& g) { place(m, g, inverse_mass); });
}
void take_drift(const MoverRows& m, double h, double share, size_t first, size_t last) {
    for_each_of(m, first, last, [&](const auto& g) { take_drift(m, g, h, share); });
}
void drift(const MoverRows& m, double h, size_t first, size_t last) {
    for_each_of(m, first, last, [&](const auto& g) { drift(m, g, h); });
}
void kick(const MoverRows& m, double share, size_t first, size_t last) {
    for_each_of(m, first, last, [&](const auto& g) { kick(m, g, share); });
}
void take_velocities(const MoverRows& m, size_t first, size_t last) {
    for_each_of(m, first, last, [&](const auto& g) { take_velocities(m, g); });
}
MoverSums sum(const MoverRows& m, const double* mass, const double* inertia, size_t first, size_t last) {
    if (are_few(m.rows))
        return sum_each<SingleSum>(m, mass, inertia, [&](auto work) { for_each_single(first, last, work); });
    return sum_each<Sums>(m, mass, inertia, [&](auto work) { for_each_group(first, last, m.rows, work); });
}

}  // namespace
}  // namespace carom
