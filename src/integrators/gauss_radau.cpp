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

#include "forces/gains.hpp"
#include "integrators/propose.hpp"
#include "math/double_double.hpp"
#include "math/elementary.hpp"

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
/// wⱼ = ∫₀¹ lⱼ and wⱼ (1 − cⱼ), in two doubles each
constexpr DoubleDouble end_velocity[] = {
    {0x1.0000000000000p-6, -0x1.0000000000000p-129},
    {0x1.7b9d0e6767d62p-4, -0x1.d91d92ab694bep-58},
    {0x1.376e04758f7cdp-3, -0x1.0e3508468b861p-57},
    {0x1.818dd0bf440e1p-3, -0x1.ab1357b2ea883p-57},
    {0x1.90f84b54eddeep-3, 0x1.b9762c2c07b4bp-57},
    {0x1.6357d8b9e9c93p-3, 0x1.34c674c7b5488p-58},
    {0x1.ff47661dd07f2p-4, -0x1.8ea0376449ef2p-58},
    {0x1.d50731e6e289ep-5, 0x1.94dde716d52d8p-61},
};
constexpr DoubleDouble end_place[] = {
    {0x1.0000000000000p-6, -0x1.1000000000000p-128},
    {0x1.664166b55113ep-4, -0x1.58442b55dc29ep-61},
    {0x1.fe984a2f000e9p-4, 0x1.09ef7ffae4656p-58},
    {0x1.f3323b3a25193p-4, 0x1.2b6b0e45a6db0p-58},
    {0x1.6b27d0cdeda54p-4, -0x1.49ace79c7af67p-59},
    {0x1.79c94fb0f03e9p-5, -0x1.b1b9b59f1f7f2p-62},
    {0x1.d5105803a1d27p-7, 0x1.d6d28cfc6a24dp-61},
    {0x1.51640eabf1610p-10, -0x1.4e92d34b6327fp-64},
};
/// The coefficient of s⁷ in lⱼ.
constexpr Weights highest = {
    -804.375, 1903.1148339559419188, -2271.9920421295194977, 2246.4886031842272434, -1916.0856046504753257, 1381.9003387178451666,
    -769.90929430944615863, 230.85816523142665334};
// clang-format on

/// Σ weights[j] a[j] of every number of the acceleration.
void combine(const Weights& weights, const std::vector<Rates>& a, Motion& out) {
    const auto* r = a.data();
    each(
        [&w = weights](double& sum, double a0, double a1, double a2, double a3, double a4, double a5, double a6,
                       double a7) {
            sum = ((w[0] * a0 + w[1] * a1) + (w[2] * a2 + w[3] * a3)) +
                  ((w[4] * a4 + w[5] * a5) + (w[6] * a6 + w[7] * a7));
        },
        out, r[0].acceleration, r[1].acceleration, r[2].acceleration, r[3].acceleration, r[4].acceleration,
        r[5].acceleration, r[6].acceleration, r[7].acceleration);
}

/// The larger one; what is not a number stays.
double larger(double a, double b) { return a < b || b != b ? b : a; }

double largest(const Motion& m) {
    double most = 0;
    const auto look = [&](double x) { most = larger(most, std::abs(x)); };
    for (const Vec2 x : m.linear) look(x.x), look(x.y);
    for (const double x : m.angular) look(x);
    return most;
}

double largest_difference(const Motion& a, const Motion& b) {
    double most = 0;
    const auto look = [&](double x) { most = larger(most, std::abs(x)); };
    for (std::size_t i = 0; i < a.size(); ++i) {
        look(a.linear[i].x - b.linear[i].x), look(a.linear[i].y - b.linear[i].y);
        look(a.angular[i] - b.angular[i]);
    }
    return most;
}

/// First guesses for the nodes of a step: the polynomial of the last step goes on, or the acceleration stays.
void predict(double h, const Memory& memory, std::vector<Rates>& now) {
    for (std::size_t i = 1; i < nodes; ++i) {
        now[i] = now[0];
        if (memory.length == 0) continue;
        const double s = 1 + c[i] * h / memory.length;
        Weights lagrange;
        for (std::size_t j = 0; j < nodes; ++j) {
            lagrange[j] = 1;
            for (std::size_t k = 0; k < nodes; ++k)
                if (k != j) lagrange[j] *= (s - c[k]) / (c[j] - c[k]);
        }
        combine(lagrange, memory.nodes, now[i].acceleration);
    }
}

/// One round over the nodes, each with the newest values of the others. Returns the largest change of an acceleration.
double improve(const Dynamics& dynamics, const State& start, double h, Memory& memory) {
    std::vector<Rates>& a = memory.stages;
    State& at = memory.trial;
    double change = 0;
    for (std::size_t i = 1; i < nodes; ++i) {
        at.time = start.time + c[i] * h;
        combine(to_place[i - 1], a, at.x);
        each([h, ch = c[i] * h](double& x, double from, double low,
                                double v) { x = from + (low + (ch * v + h * h * x)); },
             at.x, start.x, memory.low_x, start.v);
        if (dynamics.needs_velocity()) {
            combine(to_velocity[i - 1], a, at.v);
            each([h](double& v, double from, double low) { v = from + (low + h * v); }, at.v, start.v, memory.low_v);
        }
        dynamics.evaluate(at, memory.fresh);
        change = larger(change, largest_difference(memory.fresh.acceleration, a[i].acceleration));
        std::swap(memory.fresh, a[i]);
    }
    return change;
}

/// Solves for the accelerations at the nodes; whether that succeeded.
bool converge(const Dynamics& dynamics, const State& start, double h, Memory& memory) {
    memory.trial.v = start.v;
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 12; ++round) {
        const double change = improve(dynamics, start, h, memory);
        double scale = 0;
        for (std::size_t i = 0; i < nodes; ++i) scale = larger(scale, largest(memory.stages[i].acceleration));
        if (!(scale - scale == 0)) return false;
        if (change <= 1e-16 * scale) return true;
        // Rounding moves the accelerations to and fro: from there on no round improves them. Far from the origin stiff
        // forces feel the last bit of a place; that is no reason for a shorter step as long as the place does not.
        if (round >= 2 && change >= before) return change <= 1e-9 * scale || h * h * change <= 4e-16 * largest(start.x);
        before = change;
    }
    return false;
}

/// Of the last coefficient of the polynomial against the acceleration, for each number, the largest. A number that is
/// small beside the others is not asked for more. Nor is one that moves the place by less than 1e-12 of itself: the
/// error of the step is some 1e7 times smaller than that, and the coefficient, a sum of terms up to 2000 times the
/// accelerations, is full of what the rounding of the place makes of stiff forces.
double last_coefficient(double tolerance, const State& start, double h, Memory& memory) {
    const auto& a = memory.stages;
    combine(highest, a, memory.last);
    double most = 0, worst = 0;
    for (const Rates& node : a) most = std::max(most, largest(node.acceleration));
    const auto look = [&, rounding = 1e-12 / (tolerance * h * h)](double last, double x, auto acceleration) {
        double size = 1e-3 * most;
        for (const Rates& node : a) size = std::max(size, std::abs(acceleration(node.acceleration)));
        if (last != 0) worst = std::max(worst, std::abs(last) / (size + rounding * std::abs(x)));
    };
    for (std::size_t i = 0; i < start.size(); ++i) {
        const Vec2 x = start.x.linear[i], last = memory.last.linear[i];
        const double far = std::max(std::abs(x.x), std::abs(x.y));  // what is rounded in one direction is felt in both
        look(last.x, far, [i](const Motion& m) { return m.linear[i].x; });
        look(last.y, far, [i](const Motion& m) { return m.linear[i].y; });
        look(memory.last.angular[i], start.x.angular[i], [i](const Motion& m) { return m.angular[i]; });
    }
    return worst;
}

DoubleDouble multiply(double a, DoubleDouble b) {
    const DoubleDouble product = two_product(a, b.high);
    return fast_two_sum(product.high, product.low + a * b.low);
}

struct Change {
    double dx, dv;
};

/// The new velocity and place of one number, rounded once: x + low are each a sum of two doubles.
Change move(double h, const Weights& a, double& x, double& low_x, double& v, double& low_v) {
    DoubleDouble dv, dx;
    for (std::size_t j = 0; j < nodes; ++j) {
        dv = add(dv, multiply(a[j], end_velocity[j]));
        dx = add(dx, multiply(a[j], end_place[j]));
    }
    const DoubleDouble mean = add({v, low_v}, multiply(h, dx));
    const DoubleDouble step_v = multiply(h, dv), step_x = multiply(h, mean);
    const DoubleDouble new_v = add({v, low_v}, step_v), new_x = add({x, low_x}, step_x);
    v = new_v.high, low_v = new_v.low;
    x = new_x.high, low_x = new_x.low;
    return {step_x.high, step_v.high};
}

void finish(const Dynamics& dynamics, double h, State& state, Memory& memory) {
    const std::vector<Rates>& a = memory.stages;
    Gains gains(dynamics);
    for (std::size_t i = 0; i < state.size(); ++i) {
        Weights ax, ay, turn;
        for (std::size_t j = 0; j < nodes; ++j) {
            ax[j] = a[j].acceleration.linear[i].x, ay[j] = a[j].acceleration.linear[i].y;
            turn[j] = a[j].acceleration.angular[i];
        }
        Vec2 &x = state.x.linear[i], &v = state.v.linear[i], &lx = memory.low_x.linear[i], &lv = memory.low_v.linear[i];
        const Vec2 from = x, before = v;
        const double spin = state.v.angular[i];
        const Change in_x = move(h, ax, x.x, lx.x, v.x, lv.x), in_y = move(h, ay, x.y, lx.y, v.y, lv.y);
        const Change in_angle =
            move(h, turn, state.x.angular[i], memory.low_x.angular[i], state.v.angular[i], memory.low_v.angular[i]);
        gains.add(i, from, before, spin, {in_x.dx, in_y.dx}, {in_x.dv, in_y.dv}, in_angle.dv);
    }
    gains.book(state.account);
    for (std::size_t j = 0; j < nodes; ++j) state.account.add(h * end_velocity[j].high, a[j].flow);
    std::swap(memory.nodes, memory.stages);
    memory.length = h;
}

void restart(const State& state, double h, Memory& memory) {
    memory.step = h;
    memory.length = 0;
    for (Motion* m : {&memory.low_x, &memory.low_v, &memory.trial.x, &memory.trial.v}) m->resize(state.size());
    memory.low_x.fill_zero();
    memory.low_v.fill_zero();
    memory.last.resize(state.size());
    memory.stages.resize(nodes);
    memory.nodes.resize(nodes);
}

/// Moves the state by a step of at most `most` [s]; returns how long it was.
double step(double tolerance, const Dynamics& dynamics, double most, State& state, Memory& memory) {
    dynamics.evaluate(state, memory.stages[0]);
    double h = std::min(memory.step, most);
    const bool shortened = h < memory.step;
    for (;;) {
        if (!(h >= 1e-14 * most))
            throw Error(fmt::format("the integrator 'gauss-radau' found no step short enough at t = {:.6g} s: a force "
                                    "grows without bound or is not smooth",
                                    state.time),
                        Error::Cause::run);
        predict(h, memory, memory.stages);
        double change = 0.25;
        if (converge(dynamics, state, h, memory)) {
            const double size = last_coefficient(tolerance, state, h, memory);
            change = std::min(4.0, size == 0 ? 4.0 : portable::pow(tolerance / size, 1.0 / 7));
            if (change >= 0.25) {
                // A step cut short by the end of the frame says nothing against a longer one.
                memory.step = shortened ? std::max(memory.step, change * h) : change * h;
                break;
            }
        }
        h *= std::max(change, 0.02);
    }
    finish(dynamics, h, state, memory);
    return h;
}

}  // namespace

void propose(const GaussRadau& options, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    const double start = state.time;
    if (!memory.continues) restart(state, h, memory);
    for (CompensatedSum left(h); left.value() > 0;) {
        state.time = start + (h - left.value());
        left.add(-step(options.tolerance, dynamics, left.value(), state, memory));
    }
    state.time = start + h;
    dynamics.place_driven(state);
}

}  // namespace carom
