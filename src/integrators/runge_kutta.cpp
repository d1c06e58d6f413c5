#include "integrators/runge_kutta.hpp"

#include "integrators/propose.hpp"

namespace carom {

void set_stage(const State& start, double h, std::span<const double> weights, const std::vector<Rates>& stages,
               const std::vector<Motion>& velocities, double at, State& out) {
    out.time = start.time + at * h;
    out.x = start.x;
    out.v = start.v;
    for (std::size_t j = 0; j < weights.size(); ++j) {
        const double w = h * weights[j];
        if (w == 0) continue;
        each([w](double& x, double v) { x += w * v; }, out.x, velocities[j]);
        each([w](double& v, double a) { v += w * a; }, out.v, stages[j].acceleration);
    }
}

void evaluate_stages(const Table& table, const Dynamics& dynamics, const State& start, double h, Memory& memory) {
    const std::size_t s = table.stages();
    memory.stages.resize(std::max(memory.stages.size(), s));
    memory.coefficients.resize(std::max(memory.coefficients.size(), s));
    memory.trial.resize(start.size());
    for (std::size_t i = 0; i < s; ++i) {
        set_stage(start, h, table.row(i), memory.stages, memory.coefficients, table.c[i], memory.trial);
        dynamics.evaluate(memory.trial, memory.stages[i]);
        memory.coefficients[i] = memory.trial.v;
    }
}

void propose(const Table& table, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    evaluate_stages(table, dynamics, state, h, memory);
    for (std::size_t i = 0; i < table.stages(); ++i) state.account.add(h * table.b[i], memory.stages[i].power);
    State& start = memory.trial;
    std::swap(start, state);
    state.account = start.account;
    set_stage(start, h, table.b, memory.stages, memory.coefficients, 1, state);
    dynamics.place_driven(state);
}

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
