#pragma once
// Where parts are when they have drifted, and what hinges between them miss there.
//
// Without std and in an unnamed namespace, for wide kernels include it (src/simd/lanes.hpp).

#include "math/small_turn.hpp"
#include "solvers/desk_matrix.hpp"

namespace carom {
namespace {

/// Has a part's velocity follow from what it was given.
template <class V>
[[gnu::always_inline]] inline void feel_given(typename Ops<V>::Mask where, DeskPart<V>& p) {
    using O = Ops<V>;
    for (int i = 0; i < 3; ++i) {
        p.v[i] = O::select(where, p.v[i] + p.ease[i] * (p.given[i] - p.known[i]), p.v[i]);
        p.known[i] = O::select(where, p.given[i], p.known[i]);
    }
}

/// Turns a part from where it began.
template <class V>
[[gnu::always_inline]] inline void turn_part(const DeskTask& task, V angle, DeskPart<V>& p) {
    using O = Ops<V>;
    const auto [s, v] = small_turn(angle);
    p.now.cosine = p.start.cosine - (v * p.start.cosine + s * p.start.sine);
    p.now.sine = p.start.sine - (v * p.start.sine - s * p.start.cosine);
    p.now.angle = p.start.angle + angle;
    const V size = magnitude(angle);
    if (!O::any(size > small_turn_most)) return;
    for (int lane = 0; lane < O::lanes; ++lane) {
        if (!(O::at(size, lane) > small_turn_most)) continue;
        double turn[2];
        task.turn(O::at(p.now.angle, lane), &turn[0], &turn[1]);
        O::put(p.now.cosine, lane, turn[0]), O::put(p.now.sine, lane, turn[1]);
    }
}
/// Moves a part to where the drift ends with its velocity.
template <class V>
[[gnu::always_inline]] inline void drift_part(const DeskTask& task, DeskPart<V>& p) {
    p.now.x = p.start.x + task.h * p.v[0], p.now.y = p.start.y + task.h * p.v[1];
    turn_part(task, task.h * p.v[2], p);
}

/// Of a hinge: from the centres to its points, and from one of these to the other.
template <class V>
struct HingeEnds {
    V ax, ay, bx, by, x, y;

    [[gnu::always_inline]] HingeEnds(const DeskPlace<V>& a, const DeskPlace<V>& b, const DeskAnchors<V>& at)
        : ax(a.cosine * at.a[0] - a.sine * at.a[1]),
          ay(a.sine * at.a[0] + a.cosine * at.a[1]),
          bx(b.cosine * at.b[0] - b.sine * at.b[1]),
          by(b.sine * at.b[0] + b.cosine * at.b[1]),
          x((b.x - a.x) + (bx - ax)),
          y((b.y - a.y) + (by - ay)) {}

    /// Its rows along x and y; their directions never change.
    [[gnu::always_inline]] void put_levers(DeskLine<V>* lines) const {
        lines[0].a[2] = ay, lines[0].b[2] = -by;
        lines[1].a[2] = -ax, lines[1].b[2] = bx;
    }
};

}  // namespace
}  // namespace carom
