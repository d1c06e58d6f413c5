#include "integrators/runge_kutta.hpp"

#include <algorithm>

#include "integrators/ledger.hpp"
#include "integrators/propose.hpp"

namespace carom {

void sum_stages(double h, std::span<const double> weights, const Memory& memory, State& out) {
    out.resize(memory.velocities[0].size());
    out.x.fill_zero();
    out.v.fill_zero();
    out.account = {};
    for (std::size_t j = 0; j < weights.size(); ++j) {
        const double w = h * weights[j];
        if (w == 0) continue;
        each([w](double& x, double v) { x += w * v; }, out.x, memory.velocities[j]);
        each([w](double& v, double a) { v += w * a; }, out.v, memory.stages[j].acceleration);
        out.account.add(w, memory.stages[j].flow);
    }
}

// The small terms are summed before they meet the large one, which rounds once.
void add_start(const State& start, State& change) {
    each([](double& sum, double x) { sum = x + sum; }, change.x, start.x);
    each([](double& sum, double v) { sum = v + sum; }, change.v, start.v);
    change.account.add(1, start.account);
}

void evaluate_stages(const Table& table, std::size_t first, std::size_t last, const Dynamics& dynamics,
                     const State& start, double h, Memory& memory) {
    memory.stages.resize(std::max(memory.stages.size(), last));
    memory.velocities.resize(std::max(memory.velocities.size(), last));
    for (std::size_t i = first; i < last; ++i) {
        if (i == 0) {
            memory.trial = start;
        } else {
            sum_stages(h, table.row(i), memory, memory.trial);
            add_start(start, memory.trial);
            memory.trial.time = start.time + table.c[i] * h;
        }
        dynamics.evaluate(memory.trial, memory.stages[i]);
        memory.velocities[i] = memory.trial.v;
    }
}

namespace {

void propose(const Table& table, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    evaluate_stages(table, 0, table.stages(), dynamics, state, h, memory);
    State& end = memory.trial;
    sum_stages(h, table.b, memory, end);
    book_gains(dynamics, state, end.x, end.v, end.account);
    add_start(state, end);
    end.time = state.time + h;
    std::swap(state, end);
    dynamics.place_driven(state);
}

}  // namespace

void propose(const Euler&, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    propose(tables::euler, dynamics, state, h, memory);
}

void propose(const Rk4&, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    propose(tables::rk4, dynamics, state, h, memory);
}

void propose(const RungeKutta& method, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    propose(table_of(method.tableau), dynamics, state, h, memory);
}

}  // namespace carom
