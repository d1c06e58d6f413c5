// Gauss-Radau collocation of order 15 with its own step size and compensated sums: the method of Everhart (1985) and of
// IAS15 (Rein, Spiegel, MNRAS 446, 1424, 2015).
//
// Within a step the acceleration is the polynomial of degree 7 through its values at the eight nodes cᵢ of Gauss-Radau,
// c₀ = 0; velocity and place are its integrals. Where those papers write the polynomial by divided differences, here it
// is a Runge-Kutta method: v(cᵢ) = v + h Σ Aᵢⱼ aⱼ, x(cᵢ) = x + cᵢ h v + h² Σ Bᵢⱼ aⱼ, and at the end the weights wⱼ and
// wⱼ (1 − cⱼ). All terms have the size of the acceleration, so that sums lose nothing to cancellation.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <carom/error.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "forces/gains.hpp"
#include "integrators/gauss_radau_tables.hpp"
#include "integrators/propose.hpp"
#include "math/bits.hpp"
#include "math/double_double.hpp"
#include "simd/single.hpp"

namespace carom {

namespace {

using namespace gauss_radau;

/// lⱼ at two places s.
using Pairs = std::array<Two, nodes>;
Pairs lagrange(Two s) {
    Pairs out;
    Two before{1, 1}, behind{1, 1};
    for (std::size_t j = 0; j < nodes; ++j) {
        out[j] = lagrange_scales[j] * before;
        before *= s - node_time[j];
    }
    for (std::size_t j = nodes; j-- > 0;) {
        out[j] *= behind;
        behind *= s - node_time[j];
    }
    return out;
}

bool stands(const Dynamics& dynamics, const State& state, std::size_t i) {
    return dynamics.mass()[i] == 0 && state.v.linear[i] == Vec2{} && state.v.angular[i] == 0;
}

/// The accelerations at the nodes of one kind, vectors or angles or one of their coordinates.
template <class Kind>
using Arrays = std::array<Kind*, nodes>;

/// Where the numbers of one kind lie of the rows that move.
template <class Kind>
struct Numbers {
    std::size_t count = 0;
    const Kind *x, *v, *low_x, *low_v;  ///< at the start
    Kind *at_x, *at_v;                  ///< at a node
    Kind* before;                       ///< what a node's acceleration was
    Arrays<Kind> known;                 ///< memory.nodes
    std::array<Kind*, 2 * nodes> now;   ///< memory.stages, twice: from any node on round to the one before it

    void exchange() {
        for (std::size_t j = 0; j < nodes; ++j) {
            std::swap(now[j], known[j]);
            now[nodes + j] = now[j];
        }
    }
};

/// Forces, and the rows that move: those before and behind stand still.
struct Moving {
    const Dynamics& dynamics;
    std::size_t first = 0, last;
    Numbers<Vec2> linear;
    Numbers<double> angular;  ///< none if no force turns anybody

    Moving(const Dynamics& forces, const State& state) : dynamics(forces), last(state.size()) {
        while (first < last && stands(dynamics, state, first)) ++first;
        while (first < last && stands(dynamics, state, last - 1)) --last;
    }
    /// Where all numbers lie.
    void find(const State& state, Memory& memory) {
        if (first == last) return;
        const auto find_kind = [&](auto& arrays, auto of) {
            arrays.count = last - first;
            const auto place = [of, k = first](auto& motion) { return of(motion).data() + k; };
            arrays.x = place(state.x), arrays.v = place(state.v);
            arrays.low_x = place(memory.low_x), arrays.low_v = place(memory.low_v);
            arrays.at_x = place(memory.trial.x), arrays.at_v = place(memory.trial.v);
            arrays.before = place(memory.last);
            for (std::size_t j = 0; j < nodes; ++j) {
                arrays.now[j] = arrays.now[nodes + j] = place(memory.stages[j].acceleration);
                arrays.known[j] = place(memory.nodes[j].acceleration);
            }
        };
        find_kind(
            linear, [](auto& motion) -> auto& { return motion.linear; });
        if (dynamics.turns())
            find_kind(
                angular, [](auto& motion) -> auto& { return motion.angular; });
    }
    /// Stages and nodes change their roles.
    void exchange(Memory& memory) {
        std::swap(memory.nodes, memory.stages);
        linear.exchange();
        if (angular.count > 0) angular.exchange();
    }
    /// Calls f(arrays) for vectors, and for angles if anybody turns.
    template <class F>
    void each_kind(F f) const {
        f(linear);
        if (angular.count > 0) f(angular);
    }
};

/// A vector's x and y in one register, or an angle.
template <class Kind>
using Number = std::conditional_t<std::is_same_v<std::remove_const_t<Kind>, Vec2>, Two, double>;
inline double load(const double* from) { return *from; }
inline void store(double* to, double number) { *to = number; }
// By a pointer to doubles: after a copy of bytes the compiler would read all else anew.
inline Two load(const Vec2* from) { return *reinterpret_cast<const Two_anywhere*>(&from->x); }
inline void store(Vec2* to, Two pair) { *reinterpret_cast<Two_anywhere*>(&to->x) = pair; }

/// Σ weight(j) a[j] over the nodes of vector or number k.
template <class Weight, class Pointers>
[[gnu::always_inline]] inline auto sum_over_nodes(Weight weight, const Pointers& a, std::size_t k) {
    const auto term = [&](std::size_t j) { return weight(j) * load(a[j] + k); };
    return ((term(0) + term(1)) + (term(2) + term(3))) + ((term(4) + term(5)) + (term(6) + term(7)));
}
template <class Pointers>
[[gnu::always_inline]] inline auto combined(const Weights& w, const Pointers& a, std::size_t k) {
    using N = decltype(load(a[0]));
    return sum_over_nodes([&w](std::size_t j) { return w.of<N>(j); }, a, k);
}
/// start + h Σ w a, the last term added last: a processor that knows the others meanwhile does all else.
template <class N, class Kind>
[[gnu::always_inline]] inline N combined_from(N start, double h, const Weights& w, Kind* const* a, std::size_t k) {
    const auto term = [&](std::size_t j) { return w.of<N>(j) * load(a[j] + k); };
    const N known = ((term(0) + term(1)) + (term(2) + term(3))) + ((term(4) + term(5)) + term(6));
    return (start + h * known) + (h * w.of<N>(nodes - 1)) * load(a[nodes - 1] + k);
}

double size_of(double a) { return std::abs(a); }
template <class N>
N larger(N a, N b) {
    return a < b ? b : a;
}
double largest_of(double a) { return a; }
double largest_of(Two a) { return larger(a[0], a[1]); }
bool is_zero(double a) { return a == 0; }
bool is_zero(Two a) { return a[0] == 0 && a[1] == 0; }

/// The largest of the numbers in an array.
template <class Kind>
double largest(const Kind* a, std::size_t count) {
    Number<Kind> most{};
    for (std::size_t k = 0; k < count; ++k) most = larger(most, size_of(load(a + k)));
    return largest_of(most);
}
/// One of vectors and one of angles: which is larger would be a matter of units.
struct Both {
    double of_vectors = 0, of_angles = 0;
};
/// Of two, what belongs to numbers of a kind.
auto& among(const Numbers<Vec2>&, auto& of_vectors, auto&) { return of_vectors; }
auto& among(const Numbers<double>&, auto&, auto& of_angles) { return of_angles; }

/// The largest numbers in the arrays of either kind: in.x, say, or the accelerations at a node.
template <class ArrayOf>
Both largest(const Moving& moving, ArrayOf array_of) {
    Both most;
    moving.each_kind(
        [&](const auto& in) { among(in, most.of_vectors, most.of_angles) = largest(array_of(in), in.count); });
    return most;
}
Both largest_at(const Moving& moving, std::size_t node) {
    return largest(moving, [node](const auto& in) { return in.now[node]; });
}
Both larger(Both a, Both b) { return {larger(a.of_vectors, b.of_vectors), larger(a.of_angles, b.of_angles)}; }
/// Whether both are at most such a part of others.
bool within(Both a, double part, Both b) {
    return a.of_vectors <= part * b.of_vectors && a.of_angles <= part * b.of_angles;
}

/// First guesses for the nodes of a step by the polynomial through memory.nodes: the last step's, which goes on from
/// its end, 1, or that of an attempt to make this step, from its start, 0. Without one the acceleration stays, as so
/// far from it that of its seventh power nothing but rounding would be left.
void predict(const Moving& moving, double from, double h, const Memory& memory) {
    constexpr double far = 100;
    if (memory.length * far < h)
        return moving.each_kind([](const auto& in) {
            for (std::size_t i = 1; i < nodes; ++i) std::copy_n(in.now[0], in.count, in.now[i]);
        });
    const double ratio = h / memory.length;
    for (std::size_t i = 1; i < nodes; i += 2) {
        const std::size_t next = std::min(i + 1, nodes - 1);
        const Pairs weights = lagrange(Two{from + node_time[i] * ratio, from + node_time[next] * ratio});
        moving.each_kind([&](const auto& in) {
            for (std::size_t k = 0; k < in.count; ++k) {
                store(in.now[i] + k, sum_over_nodes([&](std::size_t j) { return weights[j][0]; }, in.known, k));
                store(in.now[next] + k, sum_over_nodes([&](std::size_t j) { return weights[j][1]; }, in.known, k));
            }
        });
    }
}

/// The polynomial of an attempt at a step of length h becomes the one that predicts.
void adopt(double h, Moving& moving, Memory& memory) {
    moving.exchange(memory);
    memory.stages[0] = memory.nodes[0];
    memory.length = h;
}

/// Of a round over the nodes: the largest change of an acceleration, the largest acceleration, and a sum that is finite
/// if all of them are: a maximum says nothing of what is not a number.
template <class N>
struct Changes {
    N change{}, scale{}, sum{};

    void add(N before, N now) {
        change = larger(change, size_of(now - before));
        scale = larger(scale, size_of(now));
        sum += now;
    }
};
struct Round {
    Both change, scale;
    bool finite;
};

/// Places, and velocities if they are asked for, at a node.
template <class Kind>
[[gnu::always_inline]] inline void go_to_node(const Numbers<Kind>& in, std::size_t node, double h, bool moves) {
    const double ch = node_time[node] * h, hh = h * h;
    Kind* const* const now = &in.now[node];
    for (std::size_t k = 0; k < in.count; ++k) {
        const auto v = load(in.v + k), low_x = load(in.low_x + k), low_v = load(in.low_v + k);
        store(in.at_x + k, load(in.x + k) + combined_from(low_x + ch * v, hh, to_place[node - 1], now, k));
        if (moves) store(in.at_v + k, v + combined_from(low_v, h, to_velocity[node - 1], now, k));
        store(in.before + k, load(*now + k));
    }
}
template <class Kind, class N>
[[gnu::always_inline]] inline void look_at_node(const Numbers<Kind>& in, std::size_t node, Changes<N>& changes) {
    const Kind* const now = in.now[node];
    for (std::size_t k = 0; k < in.count; ++k) changes.add(load(in.before + k), load(now + k));
}
/// What a node turned out to be corrects those after it.
template <class Kind>
[[gnu::always_inline]] inline void hand_on(const Numbers<Kind>& in, std::size_t node) {
    for (std::size_t k = 0; k < in.count; ++k) {
        const auto change = load(in.now[node] + k) - load(in.before + k);
        for (std::size_t j = node + 1; j < nodes; ++j)
            store(in.now[j] + k, load(in.now[j] + k) + handed_on[node][j] * change);
    }
}

/// One round over the nodes, each with the newest values of the others. Guesses from outside the polynomial's step are
/// off by more at every node: what one of them turns out to be corrects those after it (Everhart).
enum class Guesses { continued, close };
Round improve(Guesses guesses, Dynamics::Wanted wanted, const Moving& moving, const State& start, double h,
              Memory& memory) {
    Changes<Two> of_vectors;
    Changes<double> of_angles;
    const bool moves = moving.dynamics.needs_velocity();
    for (std::size_t i = 1; i < nodes; ++i) {
        memory.trial.time = start.time + node_time[i] * h;
        moving.each_kind([&](const auto& in) { go_to_node(in, i, h, moves); });
        moving.dynamics.evaluate(memory.trial, memory.stages[i], wanted);
        moving.each_kind([&](const auto& in) {
            look_at_node(in, i, among(in, of_vectors, of_angles));
            if (guesses == Guesses::continued) hand_on(in, i);
        });
    }
    return {{largest_of(of_vectors.change), of_angles.change},
            {largest_of(of_vectors.scale), of_angles.scale},
            is_zero(of_vectors.sum - of_vectors.sum) && is_zero(of_angles.sum - of_angles.sum)};
}

/// Whether one of two that are not small enough yet has become smaller.
bool gains(Both change, Both before, double enough, Both scale) {
    const auto one = [enough](double now, double was, double all) { return now > enough * all && now < was; };
    return one(change.of_vectors, before.of_vectors, scale.of_vectors) ||
           one(change.of_angles, before.of_angles, scale.of_angles);
}

/// Solves for the accelerations at the nodes, from guesses that one round has been over; whether that succeeded. Of
/// places collocation makes an error that is the square of the last coefficient's size, and a small part of that: for a
/// tolerance above rounding's the accelerations need not be better than the rest.
///
/// Flows are asked for in the round that may be the last one, as the first gains up to three digits and later ones up
/// to four, and in one more if it was the last unawares.
bool converge(double tolerance, const Moving& moving, const State& start, double h, Both change, Memory& memory) {
    using Wanted = Dynamics::Wanted;
    const double enough = std::max(1e-16, 1e-4 * tolerance * tolerance);
    const Both first = largest_at(moving, 0);
    Both before, scale = first;
    Wanted wanted = Wanted::accelerations;
    for (int round = 1; round < 13; ++round) {
        if (within(change, (round == 1 ? 1e3 : 1e4) * enough, scale)) wanted = Wanted::all;
        const Round now = improve(Guesses::close, wanted, moving, start, h, memory);
        if (!now.finite) return false;
        change = now.change, scale = larger(now.scale, first);
        bool done = within(change, enough, scale);
        // Rounding moves the accelerations to and fro: from there on no round improves them. Far from the origin stiff
        // forces feel the last bit of a place; that is no reason for a shorter step as long as the place does not.
        if (!done && round >= 2 && !gains(change, before, enough, scale)) {
            done = within(change, 1e-9, scale) ||
                   within(change, 4e-16 / (h * h), largest(moving, [](const auto& in) { return in.x; }));
            if (!done) return false;
        }
        if (done && std::exchange(wanted, Wanted::all) == Wanted::all) return true;
        before = change;
    }
    return false;
}

/// The largest of coefficients against sizes, and what rounding makes of a place so far out.
struct Worst {
    double least, rounding, value = 0;

    void add(double coefficient, double size, double far) {
        if (coefficient == 0) return;
        value = std::max(value, std::abs(coefficient) / (std::max(least, size) + rounding * far));
    }
    /// What is rounded in one direction is felt in both.
    void add(Two coefficient, Two size, double far) {
        for (const int k : {0, 1}) add(coefficient[k], size[k], far);
    }
};

/// Of the last coefficient of the polynomial against the acceleration, for each number, the largest. A number that is
/// small beside the others is not asked for more. Nor is one that moves the place by less than 1e-12 of itself: the
/// error of the step is some 1e7 times smaller than that, and the coefficient, a sum of terms up to 2000 times the
/// accelerations, is full of what the rounding of the place makes of stiff forces.
double last_coefficient(double tolerance, const Moving& moving, double h) {
    Both most;
    for (std::size_t j = 0; j < nodes; ++j) most = larger(most, largest_at(moving, j));
    Worst worst{0, 1e-12 / (tolerance * h * h)};
    moving.each_kind([&](const auto& in) {
        worst.least = 1e-3 * among(in, most.of_vectors, most.of_angles);
        for (std::size_t k = 0; k < in.count; ++k) {
            auto size = size_of(load(in.now[0] + k));
            for (std::size_t j = 1; j < nodes; ++j) size = larger(size, size_of(load(in.now[j] + k)));
            worst.add(combined(highest, in.now, k), size, largest_of(size_of(load(in.x + k))));
        }
    });
    return worst.value;
}

DoubleDouble multiply(double a, DoubleDouble b) {
    const DoubleDouble product = two_product(a, b.high);
    return fast_two_sum(product.high, product.low + a * b.low);
}

/// One number's sum over the nodes, its weights in two doubles: they would pull all steps to one side, as the rounding
/// of the sum does not.
DoubleDouble combined(const Weights& high, const Weights& low, const Arrays<const double>& a, std::size_t k) {
    return fast_two_sum(combined(high, a, k), combined(low, a, k));
}

/// The new velocity and place of one number: x + low are each a sum of two doubles.
struct Moved {
    double dx, dv;
};
Moved move(double h, const Arrays<const double>& a, std::size_t k, double& x, double& low_x, double& v, double& low_v) {
    const DoubleDouble dv = combined(end_velocity, end_velocity_low, a, k);
    const DoubleDouble dx = combined(end_place, end_place_low, a, k);
    const DoubleDouble mean = add({v, low_v}, multiply(h, dx));
    const DoubleDouble step_v = multiply(h, dv), step_x = multiply(h, mean);
    const DoubleDouble new_v = add({v, low_v}, step_v), new_x = add({x, low_x}, step_x);
    v = new_v.high, low_v = new_v.low;
    x = new_x.high, low_x = new_x.low;
    return {step_x.high, step_v.high};
}

template <class Of>
Arrays<const double> arrays_of(const std::vector<Rates>& a, Of of) {
    Arrays<const double> out;
    for (std::size_t j = 0; j < nodes; ++j) out[j] = of(a[j].acceleration);
    return out;
}

void finish(Moving& moving, double h, State& state, Memory& memory) {
    const std::vector<Rates>& a = memory.stages;
    const Dynamics& dynamics = moving.dynamics;
    Gains gains(dynamics);
    for (std::size_t i = moving.first; i < moving.last; ++i) {
        if (stands(dynamics, state, i)) continue;
        Vec2 &x = state.x.linear[i], &v = state.v.linear[i], &lx = memory.low_x.linear[i], &lv = memory.low_v.linear[i];
        double& spin = state.v.angular[i];
        const Vec2 from = x, before = v;
        const double spin_before = spin;
        const auto linear = arrays_of(a, [i](auto& motion) { return &motion.linear[i].x; });
        const Moved in_x = move(h, linear, 0, x.x, lx.x, v.x, lv.x);
        const Moved in_y = move(h, linear, 1, x.y, lx.y, v.y, lv.y);
        Moved in_angle{};
        if (dynamics.turns() || spin != 0)
            in_angle = move(h, arrays_of(a, [i](auto& motion) { return &motion.angular[i]; }), 0, state.x.angular[i],
                            memory.low_x.angular[i], spin, memory.low_v.angular[i]);
        gains.add(i, from, before, spin_before, {in_x.dx, in_y.dx}, {in_x.dv, in_y.dv}, in_angle.dv);
    }
    gains.book(state.account);
    for (std::size_t j = 0; j < nodes; ++j) state.account.add(h * end_velocity[j], a[j].flow);
    moving.exchange(memory);
    memory.length = h;
}

void restart(const State& state, double h, Memory& memory) {
    memory.step = h;
    memory.length = 0;
    for (Motion* m : {&memory.low_x, &memory.low_v}) m->resize(state.size());
    memory.low_x.fill_zero();
    memory.low_v.fill_zero();
    memory.last.resize(state.size());
    for (auto* rates : {&memory.stages, &memory.nodes}) {
        rates->resize(nodes);
        for (Rates& node : *rates) node.acceleration.resize(state.size());
    }
}

/// The seventh root of a number between 1e-14 and 4⁷, to 1e-3: for the length of a step that is enough, and it is a
/// tenth of the work of pow. A seventh of the bits is a seventh of the exponent and nearly that of the fraction's
/// logarithm; a step of Newton's does the rest.
double seventh_root(double x) {
    const double root = from_bits(to_bits(x) / 7 + to_bits(1) / 7 * 6), cube = root * root * root;
    return root + (x / (cube * cube) - root) * (1.0 / 7);
}

/// How much longer the step may be by its last coefficient, at most fourfold, or how much shorter it should be.
double room(double tolerance, const Moving& moving, double h) {
    constexpr double safety = 0.95;
    const double size = last_coefficient(tolerance, moving, h);
    return safety * (size == 0 ? 4.0 : seventh_root(std::clamp(tolerance / size, 1e-14, 16384.0)));
}

/// Moves the state by a step of at most `most` [s]; returns how long it was.
double step(double tolerance, Moving& moving, double most, State& state, Memory& memory) {
    memory.trial.v = state.v;
    moving.dynamics.evaluate(state, memory.stages[0]);
    double h = std::min(memory.step, most);
    for (double from = 1;;) {
        if (!(h >= 1e-14 * most))
            throw Error(fmt::format("the integrator 'gauss-radau' found no step short enough at t = {:.6g} s: a force "
                                    "grows without bound or is not smooth",
                                    state.time),
                        Error::Cause::run);
        predict(moving, from, h, memory);
        const Round first = improve(Guesses::continued, Dynamics::Wanted::accelerations, moving, state, h, memory);
        // Where the guesses were as good as the last coefficient may be large, one round tells how long the step can
        // be. It is not lost: what it found is the better guess.
        if (first.finite && within(first.change, tolerance, first.scale)) {
            const double change = room(tolerance, moving, h);
            if (change < 0.85 || (change > 1.15 && from == 1 && h < most)) {
                adopt(h, moving, memory);
                from = 0;
                h = std::min(h * std::clamp(change, 0.3, 1.3), most);
                predict(moving, from, h, memory);
            }
        }
        double change = 0.225;
        if (first.finite && converge(tolerance, moving, state, h, first.change, memory)) {
            change = room(tolerance, moving, h);
            if (change >= 0.66) {  // the coefficient is at most twelve times too large
                // A step cut short by the end of the frame says nothing against a longer one.
                const bool cut = h >= most && h < memory.step;
                memory.step = cut ? std::max(memory.step, change * h) : change * h;
                break;
            }
            adopt(h, moving, memory);
            from = 0;
        }
        h *= std::max(change, 0.02);
    }
    finish(moving, h, state, memory);
    return h;
}

}  // namespace

void propose(const GaussRadau& options, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    const double start = state.time;
    if (!memory.continues) restart(state, h, memory);
    Moving moving(dynamics, state);
    memory.trial.x = state.x;  // with those that stand still
    memory.trial.v = state.v;
    moving.find(state, memory);
    for (CompensatedSum left(h); left.value() > 1e-16 * h;) {
        state.time = start + (h - left.value());
        left.add(-step(options.tolerance, moving, left.value(), state, memory));
    }
    state.time = start + h;
    dynamics.place_driven(state);
}

}  // namespace carom
