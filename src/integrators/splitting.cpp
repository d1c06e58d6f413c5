#include "integrators/splitting.hpp"

namespace carom {

namespace {

void add(State& state, double h, const Rates& rates) {
    each([h](double& v, double a) { v += h * a; }, state.v, rates.acceleration);
    state.account.add(h, rates.power);
}

}  // namespace

void kick_on(const Dynamics& dynamics, State& state, double h, int order, Memory& memory) {
    if (!dynamics.needs_velocity() || order == 1) return add(state, h, memory.rates);
    memory.trial = state;
    memory.stages.resize(3);
    const auto stage = [&](double s, const Rates& from, Rates& to) {
        memory.trial.v = state.v;
        each([s](double& v, double a) { v += s * a; }, memory.trial.v, from.acceleration);
        dynamics.evaluate(memory.trial, to);
    };
    if (order == 2) {
        stage(h / 2, memory.rates, memory.stages[0]);
        return add(state, h, memory.stages[0]);
    }
    stage(h / 2, memory.rates, memory.stages[0]);
    stage(h / 2, memory.stages[0], memory.stages[1]);
    stage(h, memory.stages[1], memory.stages[2]);
    add(state, h / 6, memory.rates);
    add(state, h / 3, memory.stages[0]);
    add(state, h / 3, memory.stages[1]);
    add(state, h / 6, memory.stages[2]);
}

void kick(const Dynamics& dynamics, State& state, double h, int order, Memory& memory) {
    dynamics.evaluate(state, memory.rates);
    kick_on(dynamics, state, h, order, memory);
}

}  // namespace carom
