#include "integrators/runge_kutta.hpp"

#include <algorithm>

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
        out.account.add(w, memory.stages[j].power);
    }
}

// The small terms are summed before they meet the large one, which rounds once.
void set_stage(const State& start, double h, std::span<const double> weights, double at, const Memory& memory,
               State& out) {
    sum_stages(h, weights, memory, out);
    each([](double& sum, double x) { sum = x + sum; }, out.x, start.x);
    each([](double& sum, double v) { sum = v + sum; }, out.v, start.v);
    out.account.add(1, start.account);
    out.time = start.time + at * h;
}

void evaluate_stages(const Table& table, std::size_t first, std::size_t last, const Dynamics& dynamics,
                     const State& start, double h, Memory& memory) {
    memory.stages.resize(std::max(memory.stages.size(), last));
    memory.velocities.resize(std::max(memory.velocities.size(), last));
    for (std::size_t i = first; i < last; ++i) {
        if (i == 0)
            memory.trial = start;
        else
            set_stage(start, h, table.row(i), table.c[i], memory, memory.trial);
        dynamics.evaluate(memory.trial, memory.stages[i]);
        memory.velocities[i] = memory.trial.v;
    }
}

namespace {

void propose(const Table& table, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    evaluate_stages(table, 0, table.stages(), dynamics, state, h, memory);
    set_stage(state, h, table.b, 1, memory, memory.trial);
    std::swap(state, memory.trial);
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
