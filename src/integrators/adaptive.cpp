// Dormand-Prince with its own step size. Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I (1993),
// II.4 and II.5. The unknowns are places, velocities and the accounts of heat and work, all treated alike; the accounts
// that only the ledger needs are summed with the others, but no step is shorter for their sake.

#include <algorithm>
#include <cmath>

#include "forces/gains.hpp"
#include "integrators/propose.hpp"
#include "integrators/runge_kutta.hpp"
#include "integrators/step_control.hpp"

namespace carom {

namespace {

/// f(double&, double...) on every unknown.
template <class F, class... In>
void each_unknown(F f, State& out, const In&... in) {
    each(f, out.x, in.x...);
    each(f, out.v, in.v...);
    for (std::size_t k = 0; k < out.account.power.size(); ++k) f(out.account.power[k], in.account.power[k]...);
    for (std::size_t k = 0; k < out.account.wrench.size(); ++k) {
        f(out.account.wrench[k].force.x, in.account.wrench[k].force.x...);
        f(out.account.wrench[k].force.y, in.account.wrench[k].force.y...);
        f(out.account.wrench[k].torque, in.account.wrench[k].torque...);
    }
}

/// The error of the step from memory.end to memory.next, in tolerances. With two estimates it is e₅² / √(e₅² + e₃²/100)
/// (Hairer, Norsett, Wanner, II.10.17).
double estimate_error(const Embedded& method, const Dynamics& dynamics, double tolerance, double h, Memory& memory) {
    State &error = memory.trial, &coarse = memory.coarse;
    const bool flows = dynamics.needs_velocity();  // else there is neither heat nor work
    const auto sum = [&](std::span<const double> weights, State& out) {
        sum_stages(h, weights, memory, out.x, out.v);
        out.account = flows ? sum_flows(h, weights, memory) : Flows{};
    };
    sum(method.error, error);
    if (!method.coarse.empty()) {
        sum(method.coarse, coarse);
        const auto both = [](double& e5, double e3) {
            const double size = std::sqrt(e5 * e5 + 0.01 * e3 * e3);
            if (size > 0) e5 *= std::abs(e5) / size;  // else the squares are too small for doubles, and e5 is enough
        };
        each(both, error.x, coarse.x);
        each(both, error.v, coarse.v);
        for (const Account k : controlled) both(error.account[k], coarse.account[k]);
    }
    return largest(error, memory.end, memory.next, tolerance);
}

void restart(const Embedded& method, double tolerance, const Dynamics& dynamics, const State& state, Memory& memory) {
    memory.end = state;
    memory.ahead = {};
    memory.length = 0;
    memory.error = 1;
    evaluate_stages(method.stages, 0, 1, dynamics, state, 0, memory);
    memory.step = first_step(method.stages.order, tolerance, dynamics, memory);
}

/// The interpolation over the step from memory.end to memory.next, nested:
/// y = y₀ + θ (c₁ + (1−θ) (c₂ + θ (c₃ + (1−θ) (c₄ + ...)))), of order 4 and 7.
void prepare_dense(const Embedded& method, const Dynamics& dynamics, double h, Memory& memory) {
    const std::size_t stages = method.stages.stages(), higher = method.dense.size() / stages;
    evaluate_stages(method.stages, method.last + 1, stages, dynamics, memory.end, h, memory);
    memory.dense.resize(4 + higher);
    memory.dense[0] = memory.end;
    memory.dense[1] = memory.next;
    each_unknown([](double& c, double y) { c -= y; }, memory.dense[1], memory.end);
    constexpr double one = 1;
    sum_stages(h, {&one, 1}, memory, memory.dense[2]);
    each_unknown([](double& c, double change) { c -= change; }, memory.dense[2], memory.dense[1]);
    std::vector<double> at_end(method.last + 1);
    at_end.back() = 1;
    sum_stages(h, at_end, memory, memory.dense[3]);
    each_unknown([](double& c, double change, double c2) { c = change - c - c2; }, memory.dense[3], memory.dense[1],
                 memory.dense[2]);
    for (std::size_t k = 0; k < higher; ++k)
        sum_stages(h, method.dense.subspan(k * stages, stages), memory, memory.dense[4 + k]);
}

/// Moves memory.end by one step that is good enough. `wanted` [s] after the state there is a state to be interpolated.
void step(const Embedded& method, double tolerance, const Dynamics& dynamics, double wanted, Memory& memory) {
    // A force that acts for two frames falls on a stage, however long the steps before it were.
    double h = std::min(memory.step, 2 * wanted / method.widest_gap);
    const bool shortened = h < memory.step;
    for (bool rejected = false;; rejected = true) {
        require_step(Adaptive::name, h, rejected, memory.end.time, wanted, tolerance);
        evaluate_stages(method.stages, 1, method.last + 1, dynamics, memory.end, h, memory);
        memory.next.x = memory.trial.x;
        memory.next.v = memory.velocities[method.last];
        memory.next.account = sum_flows(h, method.stages.row(method.last), memory);
        memory.next.account.add(1, memory.end.account);
        const double error = estimate_error(method, dynamics, tolerance, h, memory);
        const double proposed = next_step(method.stages.order, h, error, memory.error);
        if (error <= 1) {
            remember_step(h, proposed, error, rejected, shortened, memory);
            memory.length = h;
            memory.ahead.add(h);
            break;
        }
        h = std::min(proposed, 0.9 * h);
    }
    if (memory.ahead.value() >= wanted) prepare_dense(method, dynamics, memory.length, memory);
    sum_stages(h, method.stages.row(method.last), memory, memory.trial.x, memory.trial.v);
    book_gains(dynamics, memory.end, memory.trial.x, memory.trial.v, memory.next.account);
    std::swap(memory.end, memory.next);
    std::swap(memory.stages[0], memory.stages[method.last]);
    std::swap(memory.velocities[0], memory.velocities[method.last]);
}

void interpolate(const Dynamics& dynamics, const Memory& memory, double before_end, State& state) {
    const double rest = before_end / memory.length, done = 1 - rest;
    const State& start = memory.dense[0];
    state = memory.dense.back();
    for (std::size_t k = memory.dense.size() - 1; k > 1; --k) {
        const double factor = k % 2 == 1 ? done : rest;
        each_unknown([factor](double& y, double c) { y = c + factor * y; }, state, memory.dense[k - 1]);
    }
    each_unknown([done](double& y) { y *= done; }, state);
    book_gains(dynamics, start, state.x, state.v, state.account);
    add_start(start, state);
    state.account.add(1, start.account);
}

}  // namespace

void propose(const Adaptive& options, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    const Embedded& method = table_of(options.pair);
    const double start = state.time;
    if (!memory.continues) restart(method, options.tolerance, dynamics, state, memory);
    while (memory.ahead.value() < h) {
        memory.end.time = start + memory.ahead.value();
        step(method, options.tolerance, dynamics, h, memory);
    }
    memory.ahead.add(-h);
    if (memory.ahead.value() > 0)
        interpolate(dynamics, memory, memory.ahead.value(), state);
    else
        state = memory.end;
    state.time = start + h;
    dynamics.place_driven(state);
}

}  // namespace carom
