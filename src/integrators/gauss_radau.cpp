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
#include <cstring>

#include "forces/gains.hpp"
#include "integrators/propose.hpp"
#include "math/double_double.hpp"
#include "math/elementary.hpp"
#include "simd/single.hpp"

namespace carom {

namespace {

constexpr std::size_t nodes = 8;
using Weights = std::array<double, nodes>;

// From the nodes, the zeros of P₇ + P₈ moved from [−1, 1] to [0, 1], all else by integrating Lagrange's polynomials lⱼ
// in 40 digits.
constexpr Weights c = {0,
                       0.05626256053692214646565219,
                       0.1802406917368923649875799,
                       0.3526247171131696373739078,
                       0.5471536263305553830014486,
                       0.7342101772154105315232106,
                       0.8853209468390957680903598,
                       0.9775206135612875018911745};
// clang-format off
/// Aᵢⱼ = ∫₀^cᵢ lⱼ, from i = 1
constexpr Weights to_velocity[] = {
    {0.021857535779335354114, 0.038966589954939523904, -0.0065559771505040762008, 0.0030479879977018412421, -0.001628352413490498773, 0.0008640846291827019806, -0.00039674407313727199937, 0.00010743581289457219795},
    {0.011090199967163970027, 0.10740387315951029646, 0.069628285565890753845, -0.011198116248637602202, 0.004966269979023949392, -0.0024441544664894991644, 0.001082958425545010155, -0.00028862464511451352156},
    {0.019246850204038950993, 0.082609430896324600471, 0.17134061913393613327, 0.089071766949726276935, -0.013416165037591300803, 0.0054190273978849050176, -0.0022192108184776913095, 0.00057239838732776280342},
    {0.01265460246028185957, 0.10047771517939044813, 0.13981803602799555184, 0.20945496909311433704, 0.0943551795688308622, -0.012906886501240751419, 0.004346289187593836978, -0.0010462786854107613343},
    {0.018042353782598899634, 0.086498176484482097439, 0.1610353360774351426, 0.17562775047413557145, 0.21610856956325583508, 0.084677215918120714835, -0.0097480691895116739937, 0.0019688441048939444885},
    {0.013752925505557453596, 0.097402894775481532545, 0.14545825342496956194, 0.19683417354264255364, 0.18450950776306673285, 0.19027356543855260202, 0.061516045229646676503, -0.0044264188408213449977},
    {0.016848820725630455192, 0.089609664052348710341, 0.15628861997340240624, 0.18295873167726415662, 0.2022791573227825378, 0.16543838761339925882, 0.13564564871694811844, 0.028451583479511858444},
};
/// Bᵢⱼ = ∫₀^cᵢ (cᵢ − s) lⱼ(s) ds, from i = 1
constexpr Weights to_place[] = {
    {0.00087353650169760871933, 0.00084281087013890979707, -0.00019337353802831657205, 0.000091568618525100597016, -0.000049211436419278180413, 0.000026182406364877380694, -0.000012036991259588211854, 3.2614280661010952033e-6},
    {0.0028292347051319090482, 0.011351209728611370473, 0.0023453013456999826243, -0.00038859864365825317674, 0.00015572234983542465128, -0.000072502477767323579003, 0.000031178994120808169689, -8.1925230771883815583e-6},
    {0.0054894889207087436661, 0.02755196071664002872, 0.025871749150114341295, 0.00362350041260359882, -0.00048074103031652312681, 0.00016113046343799799728, -0.000059669083439954921593, 0.00001467600982322340845},
    {0.0085750732492800094539, 0.045417275639677850384, 0.055964541006026898834, 0.036133899976258363767, 0.0039329608813314024458, -0.00042217353782967075951, 0.00011054428293927696261, -0.000023576094345616630422},
    {0.011443861864242943824, 0.062907091328151491392, 0.084115960074074918512, 0.072052531850012614235, 0.036129590740306422638, 0.003097549093471841167, -0.00025272430103219904048, 0.000038431514114236273599},
    {0.01385944752077314434, 0.076769141824479518111, 0.10731541047639489015, 0.10015053714352104, 0.066405780829977668238, 0.025859831083015792499, 0.0016115518718575036985, -0.00007511129398303949423},
    {0.015254770539488652096, 0.085428967131920236778, 0.12117311393235516437, 0.11772429326840344577, 0.084159331986607466838, 0.042340745979270191484, 0.011343257469873599652, 0.00034879466069923058318},
};
/// wⱼ = ∫₀¹ lⱼ and wⱼ (1 − cⱼ), and what rounding cuts off them
constexpr Weights end_velocity = {0x1.0000000000000p-6, 0x1.7b9d0e6767d62p-4, 0x1.376e04758f7cdp-3, 0x1.818dd0bf440e1p-3, 0x1.90f84b54eddeep-3, 0x1.6357d8b9e9c93p-3, 0x1.ff47661dd07f2p-4, 0x1.d50731e6e289ep-5},
    end_velocity_low = {-0x1.0000000000000p-129, -0x1.d91d92ab694bep-58, -0x1.0e3508468b861p-57, -0x1.ab1357b2ea883p-57, 0x1.b9762c2c07b4bp-57, 0x1.34c674c7b5488p-58, -0x1.8ea0376449ef2p-58, 0x1.94dde716d52d8p-61};
constexpr Weights end_place = {0x1.0000000000000p-6, 0x1.664166b55113ep-4, 0x1.fe984a2f000e9p-4, 0x1.f3323b3a25193p-4, 0x1.6b27d0cdeda54p-4, 0x1.79c94fb0f03e9p-5, 0x1.d5105803a1d27p-7, 0x1.51640eabf1610p-10},
    end_place_low = {-0x1.1000000000000p-128, -0x1.58442b55dc29ep-61, 0x1.09ef7ffae4656p-58, 0x1.2b6b0e45a6db0p-58, -0x1.49ace79c7af67p-59, -0x1.b1b9b59f1f7f2p-62, 0x1.d6d28cfc6a24dp-61, -0x1.4e92d34b6327fp-64};
/// The coefficient of s⁷ in lⱼ.
constexpr Weights highest = {
    -804.375, 1903.1148339559419188, -2271.9920421295194977, 2246.4886031842272434, -1916.0856046504753257, 1381.9003387178451666,
    -769.90929430944615863, 230.85816523142665334};
// clang-format on

/// 1 / Π (cⱼ − cₖ) over k ≠ j
constexpr Weights lagrange_scales = [] {
    Weights out{};
    for (std::size_t j = 0; j < nodes; ++j) {
        double product = 1;
        for (std::size_t k = 0; k < nodes; ++k)
            if (k != j) product *= c[j] - c[k];
        out[j] = 1 / product;
    }
    return out;
}();

/// What a change at node i makes at each later node j if the values at the earlier nodes stay, and the divided
/// differences of higher order: Π (cⱼ − cₖ) / (cᵢ − cₖ) over k < i.
constexpr std::array<Weights, nodes> handed_on = [] {
    std::array<Weights, nodes> out{};
    for (std::size_t i = 1; i < nodes; ++i)
        for (std::size_t j = i + 1; j < nodes; ++j) {
            out[i][j] = 1;
            for (std::size_t k = 0; k < i; ++k) out[i][j] *= (c[j] - c[k]) / (c[i] - c[k]);
        }
    return out;
}();

/// lⱼ(s)
Weights lagrange(double s) {
    Weights out = lagrange_scales;
    double before = 1, behind = 1;
    for (std::size_t j = 0; j < nodes; ++j) {
        const std::size_t back = nodes - 1 - j;
        out[j] *= before, out[back] *= behind;
        before *= s - c[j], behind *= s - c[back];
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
    Arrays<Kind> now, known;            ///< memory.stages and memory.nodes
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
    /// Where all numbers lie: until stages and nodes change their roles.
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
                arrays.now[j] = place(memory.stages[j].acceleration);
                arrays.known[j] = place(memory.nodes[j].acceleration);
            }
        };
        find_kind(
            linear, [](auto& motion) -> auto& { return motion.linear; });
        if (dynamics.turns())
            find_kind(
                angular, [](auto& motion) -> auto& { return motion.angular; });
    }
    /// Calls f(arrays) for vectors, and for angles if anybody turns.
    template <class F>
    void each_kind(F f) const {
        f(linear);
        if (angular.count > 0) f(angular);
    }
};

/// Σ w[j] a[j] of eight numbers or vectors.
template <class Number>
[[gnu::always_inline]] inline Number weighted(const Weights& w, const std::array<Number, nodes>& a) {
    return ((w[0] * a[0] + w[1] * a[1]) + (w[2] * a[2] + w[3] * a[3])) +
           ((w[4] * a[4] + w[5] * a[5]) + (w[6] * a[6] + w[7] * a[7]));
}
/// That of vector or number k at the nodes; of a vector x and y at once.
template <class Kind>
[[gnu::always_inline]] inline std::remove_const_t<Kind> combined(const Weights& w, const Arrays<Kind>& a,
                                                                 std::size_t k) {
    using Number = std::conditional_t<std::is_same_v<Kind, Vec2>, Two, double>;
    std::array<Number, nodes> values;
    for (std::size_t j = 0; j < nodes; ++j) std::memcpy(&values[j], a[j] + k, sizeof(Number));
    const Number sum = weighted(w, values);
    std::remove_const_t<Kind> out;
    std::memcpy(static_cast<void*>(&out), &sum, sizeof out);
    return out;
}

/// The largest coordinate's size.
double size_of(double a) { return std::abs(a); }
double size_of(Vec2 a) { return std::max(std::abs(a.x), std::abs(a.y)); }
/// The larger size of each coordinate.
double larger(double size, double a) { return std::max(size, std::abs(a)); }
Vec2 larger(Vec2 size, Vec2 a) { return {larger(size.x, a.x), larger(size.y, a.y)}; }

/// The largest of the accelerations at a node.
double largest(const Moving& moving, std::size_t node) {
    double most = 0;
    moving.each_kind([&](const auto& in) {
        for (std::size_t k = 0; k < in.count; ++k) most = std::max(most, size_of(in.now[node][k]));
    });
    return most;
}
double farthest(const Moving& moving) {
    double most = 0;
    moving.each_kind([&](const auto& in) {
        for (std::size_t k = 0; k < in.count; ++k) most = std::max(most, size_of(in.x[k]));
    });
    return most;
}

/// First guesses for the nodes of a step by the polynomial through memory.nodes: the last step's, which goes on from
/// its end, 1, or that of an attempt to make this step, from its start, 0. Without one the acceleration stays.
void predict(const Moving& moving, double from, double h, const Memory& memory) {
    for (std::size_t i = 1; i < nodes; ++i) {
        const bool known = memory.length != 0;
        const Weights weights = known ? lagrange(from + c[i] * h / memory.length) : Weights{};
        moving.each_kind([&](const auto& in) {
            for (std::size_t k = 0; k < in.count; ++k)
                in.now[i][k] = known ? combined(weights, in.known, k) : in.now[0][k];
        });
    }
}

/// The polynomial of an attempt at a step of length h becomes the one that predicts.
void adopt(double h, const State& state, Moving& moving, Memory& memory) {
    std::swap(memory.nodes, memory.stages);
    memory.stages[0] = memory.nodes[0];
    memory.length = h;
    moving.find(state, memory);
}

/// Of a round over the nodes: the largest change of an acceleration, the largest acceleration, and a sum that is finite
/// if all of them are: a maximum says nothing of what is not a number.
struct Round {
    double change = 0, scale = 0, sum = 0;

    bool is_finite() const { return sum - sum == 0; }
    void add(double before, double now) {
        change = std::max(change, std::abs(now - before));
        scale = std::max(scale, std::abs(now));
        sum += now;
    }
    void add(Vec2 before, Vec2 now) { add(before.x, now.x), add(before.y, now.y); }
};

/// One round over the nodes, each with the newest values of the others. Guesses from outside the polynomial's step are
/// off by more at every node: what one of them turns out to be corrects those after it (Everhart).
enum class Guesses { continued, close };
Round improve(Guesses guesses, Dynamics::Wanted wanted, const Moving& moving, const State& start, double h,
              Memory& memory) {
    Round round;
    const bool moves = moving.dynamics.needs_velocity();
    for (std::size_t i = 1; i < nodes; ++i) {
        memory.trial.time = start.time + c[i] * h;
        moving.each_kind([&](const auto& in) {
            const double ch = c[i] * h, hh = h * h;
            for (std::size_t k = 0; k < in.count; ++k) {
                in.at_x[k] = in.x[k] + (in.low_x[k] + (ch * in.v[k] + hh * combined(to_place[i - 1], in.now, k)));
                if (moves) in.at_v[k] = in.v[k] + (in.low_v[k] + h * combined(to_velocity[i - 1], in.now, k));
                in.before[k] = in.now[i][k];
            }
        });
        moving.dynamics.evaluate(memory.trial, memory.stages[i], wanted);
        moving.each_kind([&](const auto& in) {
            for (std::size_t k = 0; k < in.count; ++k) round.add(in.before[k], in.now[i][k]);
            if (guesses == Guesses::close) return;
            for (std::size_t j = i + 1; j < nodes; ++j)
                for (std::size_t k = 0; k < in.count; ++k)
                    in.now[j][k] += handed_on[i][j] * (in.now[i][k] - in.before[k]);
        });
    }
    return round;
}

/// Solves for the accelerations at the nodes, from guesses that one round has been over; whether that succeeded. Of
/// places collocation makes an error that is the square of the last coefficient's size, and a small part of that: for a
/// tolerance above rounding's the accelerations need not be better than the rest.
///
/// Flows are asked for in the round that may be the last one, as one round gains some three to four digits, and in one
/// more if it was the last unawares.
bool converge(double tolerance, const Moving& moving, const State& start, double h, double change, Memory& memory) {
    using Wanted = Dynamics::Wanted;
    const double enough = std::max(1e-16, 1e-4 * tolerance * tolerance), first = largest(moving, 0);
    double before = std::numeric_limits<double>::infinity(), scale = first;
    Wanted wanted = Wanted::accelerations;
    for (int round = 1; round < 13; ++round) {
        if (1e-4 * change <= enough * scale) wanted = Wanted::all;
        const Round now = improve(Guesses::close, wanted, moving, start, h, memory);
        if (!now.is_finite()) return false;
        change = now.change, scale = std::max(now.scale, first);
        bool done = change <= enough * scale;
        // Rounding moves the accelerations to and fro: from there on no round improves them. Far from the origin stiff
        // forces feel the last bit of a place; that is no reason for a shorter step as long as the place does not.
        if (!done && round >= 2 && change >= before) {
            done = change <= 1e-9 * scale || h * h * change <= 4e-16 * farthest(moving);
            if (!done) return false;
        }
        if (done && wanted == Wanted::all) return true;
        if (done) wanted = Wanted::all;
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
    void add(Vec2 coefficient, Vec2 size, double far) {
        add(coefficient.x, size.x, far), add(coefficient.y, size.y, far);
    }
};

/// Of the last coefficient of the polynomial against the acceleration, for each number, the largest. A number that is
/// small beside the others is not asked for more. Nor is one that moves the place by less than 1e-12 of itself: the
/// error of the step is some 1e7 times smaller than that, and the coefficient, a sum of terms up to 2000 times the
/// accelerations, is full of what the rounding of the place makes of stiff forces.
double last_coefficient(double tolerance, const Moving& moving, double h) {
    double most = 0;
    for (std::size_t j = 0; j < nodes; ++j) most = std::max(most, largest(moving, j));
    Worst worst{1e-3 * most, 1e-12 / (tolerance * h * h)};
    moving.each_kind([&](const auto& in) {
        for (std::size_t k = 0; k < in.count; ++k) {
            std::remove_cvref_t<decltype(in.x[0])> size{};
            for (const auto* node : in.now) size = larger(size, node[k]);
            worst.add(combined(highest, in.now, k), size, size_of(in.x[k]));
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

void finish(const Moving& moving, double h, State& state, Memory& memory) {
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
    std::swap(memory.nodes, memory.stages);
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

/// How much longer the step may be by its last coefficient, at most fourfold, or how much shorter it should be.
double room(double tolerance, const Moving& moving, double h) {
    constexpr double safety = 0.95;
    const double size = last_coefficient(tolerance, moving, h);
    return safety * (size == 0 ? 4.0 : std::min(4.0, portable::pow(tolerance / size, 1.0 / 7)));
}

/// Moves the state by a step of at most `most` [s]; returns how long it was.
double step(double tolerance, Moving& moving, double most, State& state, Memory& memory) {
    memory.trial.v = state.v;
    moving.find(state, memory);
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
        if (first.is_finite() && first.change <= tolerance * first.scale) {
            const double change = room(tolerance, moving, h);
            if (change < 0.85 || (change > 1.15 && from == 1 && h < most)) {
                adopt(h, state, moving, memory);
                from = 0;
                h = std::min(h * std::clamp(change, 0.3, 1.3), most);
                predict(moving, from, h, memory);
            }
        }
        double change = 0.225;
        if (first.is_finite() && converge(tolerance, moving, state, h, first.change, memory)) {
            change = room(tolerance, moving, h);
            if (change >= 0.66) {  // the coefficient is at most twelve times too large
                // A step cut short by the end of the frame says nothing against a longer one.
                const bool cut = h >= most && h < memory.step;
                memory.step = cut ? std::max(memory.step, change * h) : change * h;
                break;
            }
            adopt(h, state, moving, memory);
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
    for (CompensatedSum left(h); left.value() > 0;) {
        state.time = start + (h - left.value());
        left.add(-step(options.tolerance, moving, left.value(), state, memory));
    }
    state.time = start + h;
    dynamics.place_driven(state);
}

}  // namespace carom
