#pragma once
// What a row that is not rigid is to be at, and to which step of its law it goes; and two in x and y whose force has
// one bound: friction in a plane, motors, and handles.
//
// Without std and in an unnamed namespace, for wide kernels include it (src/simd/lanes.hpp).

#include "solvers/desk_matrix.hpp"

namespace carom {
namespace {

/// A law in numbers.
template <class V>
struct DeskLaw {
    V stiffness, damping, lower, upper, speed, most;
};
/// What a row that is not rigid is to be at that had the gap `first` where the substep began, `last` where it ends, and
/// got the impulse `before` the drift; `size` is what its gaps are compared with.
template <class V>
inline DeskBound<V> wanted(const DeskTask& task, const BoundShape& b, const DeskLaw<V>& law, V first, V last, V before,
                           V size) {
    using O = Ops<V>;
    const auto clamp = [](V x, V low, V high) { return O::select(x < low, low, O::select(high < x, high, x)); };
    const V none = O::all(0), endless = O::all(__builtin_huge_val());
    const double h = task.h;
    DeskBound<V> w{none, none, -endless, endless, none, none, none, law.most, tiny * size / h};
    if (b.is_spring) {
        const double part = task.is_projected ? 1 : 0.5;
        const V stiffness = part * h * law.stiffness + law.damping;
        w.softness = 1.0 / (part * h * stiffness), w.speed = -law.stiffness * first / stiffness;
        w.most = part * h * law.most, w.least = -w.most;
    } else {
        const V whole = h * law.most, half = task.share * whole, most = task.drifts ? half : whole;
        V so_far = none;
        if (task.drifts) {
            const V below = (law.lower - first) / h, above = (law.upper - first) / h;
            w.low = O::select(below < 0.0, below, none), w.high = O::select(above > 0.0, above, none);
        } else {
            w.low = O::select(last <= law.lower + 1e3 * tiny * size, none, w.low);
            w.high = O::select(last >= law.upper - 1e3 * tiny * size, none, w.high);
            // Where no drift was found a motor may have given more: that is not taken back at once.
            so_far = clamp(before, -half, half);
        }
        w.speed = clamp(b.is_paired ? first : law.speed, w.low, w.high);
        w.most = most - so_far, w.least = -most - so_far;
    }
    w.push = w.most;
    return w;
}

/// The step of its law to which a row goes that has the speed u.
template <class V>
inline V step_of(bool is_spring, bool drifts, V u, const DeskBound<V>& w, const DeskLine<V>& line) {
    using O = Ops<V>;
    constexpr double huge = __builtin_huge_val();
    const V held = O::all(number_of(Step::held)), lower = O::all(number_of(Step::lower)),
            upper = O::all(number_of(Step::upper)), pushing = O::all(number_of(Step::pushing)),
            pulling = O::all(number_of(Step::pulling)), free = O::all(number_of(Step::free));
    if (is_spring && !drifts) return free;
    if (is_spring) {
        const V pull = O::select(is_in(line.step), line.impulse, (w.speed - u) / w.softness);
        const V within = O::select(pull > w.most, pushing, O::select(pull < w.least, pulling, held));
        return O::select(w.softness < huge, within, free);
    }
    const auto motor = w.motor > 0.0;
    const V none = O::select(motor, pushing, free), back = O::select(motor, pulling, free);
    const auto below = (u < w.low - w.hair), above = (u > w.high + w.hair);
    const auto is_at = [&](V step) { return line.step == step; };
    V next = O::select(below, lower, O::select(above, upper, free));
    next = O::select(is_at(pulling), O::select(above, upper, O::select(u < w.speed - w.hair, held, pulling)), next);
    next = O::select(is_at(pushing), O::select(below, lower, O::select(u > w.speed + w.hair, held, pushing)), next);
    const V driven = O::select(line.impulse > w.most, pushing, O::select(line.impulse < w.least, pulling, held));
    next = O::select(is_at(held), O::select(motor, driven, free), next);
    next = O::select(is_at(upper), O::select(O::both(line.impulse <= w.least, w.high < huge), upper, back), next);
    next = O::select(is_at(lower), O::select(O::both(line.impulse >= w.most, w.low > -huge), lower, none), next);
    return O::select(w.motor == huge, held, next);
}

/// How fast the easier of two rows goes for an impulse along it.
inline double easiest_of(const DeskLine<double>* pair, const double* ease_a, const double* ease_b) {
    double most = 0;
    for (int r = 0; r < 2; ++r) {
        double own = 0;
        for (int d = 0; d < 3; ++d)
            own += ease_a[d] * pair[r].a[d] * pair[r].a[d] + ease_b[d] * pair[r].b[d] * pair[r].b[d];
        most = own > most ? own : most;
    }
    return most;
}

struct PairTask {
    bool is_spring, drifts;
    bool may_turn;  ///< bodies are not yet sent anywhere
    bool may_hold;  ///< what slides
};
/// A pair is kept by a force within its bound, or pushed by one of that size: that of a spring as it pulls, that of
/// friction against the slip. Which way this goes depends on the push where one does not lead its own way: so it turns,
/// a step at a time, until it does; but after the drift it stays as before it. `u` are the rows' speeds; says whether
/// the pair goes to another step, or turned.
inline bool step_of_pair(const PairTask& task, const double (&u)[2], const double* ease_a, const double* ease_b,
                         DeskLine<double>* pair, DeskBound<double>* w) {
    constexpr double huge = __builtin_huge_val(), hardly = 1e-6;  // [rad]
    const double step = pair->step, most = 0.5 * (w->most - w->least);
    const auto go = [&](Step next) { return pair[0].step = pair[1].step = number_of(next), pair->step != step; };
    if (task.is_spring && (!task.drifts || !(w->softness < huge))) return go(Step::free);
    if (!(most < huge)) return go(Step::held);
    const bool is_held = is_in(step);
    double force[2], slip[2], middle[2];
    for (int r = 0; r < 2; ++r) {
        middle[r] = 0.5 * (w[r].most + w[r].least), slip[r] = u[r] - w[r].speed;
        force[r] = (is_held ? pair[r].impulse : w[r].push) - middle[r];
        if (task.is_spring && !is_held) force[r] = -slip[r] / w[r].softness;
    }
    const bool pulls = task.is_spring || is_held;
    const double squared = force[0] * force[0] + force[1] * force[1];
    const bool gives = force[0] * slip[0] + force[1] * slip[1] > w->hair * most;
    if (pulls ? !(squared > most * most) : gives && task.may_hold) return go(Step::held);
    const bool turns = !pulls && task.may_turn && middle[0] == 0 && middle[1] == 0;
    const double easiest = turns ? easiest_of(pair, ease_a, ease_b) : 1;
    double way[2] = {force[0], force[1]};
    for (int r = 0; r < 2 && turns; ++r) way[r] -= slip[r] / easiest;
    const double size = __builtin_sqrt(way[0] * way[0] + way[1] * way[1]);
    for (int r = 0; r < 2 && size > 0; ++r) w[r].push = middle[r] + most * (way[r] / size);
    const double turn = way[0] * force[1] - way[1] * force[0];
    return go(Step::pushing) || magnitude(turn) > hardly * most * size;
}

}  // namespace
}  // namespace carom
