#include "integrators/splitting.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

void evaluate_ahead(const Dynamics& dynamics, const State& state, double h, Memory& memory) {
    State& trial = memory.trial;
    if (trial.size() != state.size()) trial = state;
    trial.time = state.time;
    const Motion& a = memory.rates.acceleration;
    dynamics.each_range(state, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            trial.x.linear[i] = state.x.linear[i], trial.x.angular[i] = state.x.angular[i];
            trial.v.linear[i] = state.v.linear[i] + h * a.linear[i];
            trial.v.angular[i] = state.v.angular[i] + h * a.angular[i];
        }
    });
    dynamics.evaluate(trial, memory.rates);
}

void evaluate_midway(const Dynamics& dynamics, const State& state, double h, Memory& memory) {
    constexpr double rounding = 1e-15;
    evaluate_ahead(dynamics, state, h, memory);
    if (!dynamics.may_turn_velocities()) return;
    double off = HUGE_VAL;
    while (true) {
        double now = 0, most = 0;
        each(
            [&](double& foretold, double v, double a) {
                now = std::max(now, std::abs(v + h * a - foretold)), most = std::max(most, std::abs(foretold));
            },
            memory.trial.v, state.v, memory.rates.acceleration);
        if (!(now > rounding * most) || now >= off) return;  // or it does not come nearer: too strong for this step
        off = now;
        evaluate_ahead(dynamics, state, h, memory);
    }
}

bool kick(const Dynamics& dynamics, State& state, double h, int order, Memory& memory) {
    Rates& rates = memory.rates;
    if (order == 1 || !dynamics.needs_velocity())
        return evaluate_and_add(dynamics, state, h, rates, Dynamics::Keep::nothing);
    dynamics.evaluate(state, rates);
    // The classical Runge-Kutta method.
    State& end = memory.next;
    end = state;
    add(dynamics, end, h / 6, rates);
    evaluate_ahead(dynamics, state, h / 2, memory);
    add(dynamics, end, h / 3, rates);
    evaluate_ahead(dynamics, state, h / 2, memory);
    add(dynamics, end, h / 3, rates);
    evaluate_ahead(dynamics, state, h, memory);
    const bool finite = add(dynamics, end, h / 6, rates);
    std::swap(state, end);
    return finite;
}

}  // namespace carom
