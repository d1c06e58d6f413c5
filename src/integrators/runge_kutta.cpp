#include "integrators/runge_kutta.hpp"

#include <algorithm>

#include "forces/gains.hpp"
#include "integrators/combination.hpp"
#include "integrators/propose.hpp"

namespace carom {

namespace {

/// Sums over stages, of places from the velocities there, of velocities from the accelerations.
class StageSums {
  public:
    StageSums(double h, std::span<const double> weights, const Memory& memory) : rows_(memory.velocities[0].size()) {
        for (std::size_t j = 0; j < weights.size(); ++j) {
            x_.add(h * weights[j], memory.velocities[j]);
            v_.add(h * weights[j], memory.stages[j].acceleration);
        }
    }
    /// From a start if there is one.
    void write(const State* start, Angles angles, Motion& x, Motion& v) const {
        x_.write(rows_, start ? &start->x : nullptr, angles, x);
        v_.write(rows_, start ? &start->v : nullptr, angles, v);
    }

  private:
    std::size_t rows_;
    Combination x_, v_;
};

}  // namespace

void sum_stages(double h, std::span<const double> weights, const Memory& memory, Motion& dx, Motion& dv) {
    StageSums(h, weights, memory).write(nullptr, Angles::summed, dx, dv);
}

Flows sum_flows(double h, std::span<const double> weights, const Memory& memory) {
    Flows sum;
    for (std::size_t j = 0; j < weights.size(); ++j)
        if (weights[j] != 0) sum.add(h * weights[j], memory.stages[j].flow);
    return sum;
}

void sum_stages(double h, std::span<const double> weights, const Memory& memory, State& out) {
    sum_stages(h, weights, memory, out.x, out.v);
    out.account = sum_flows(h, weights, memory);
}

void add_start(const State& start, State& change) {
    each([](double& sum, double x) { sum = x + sum; }, change.x, start.x);
    each([](double& sum, double v) { sum = v + sum; }, change.v, start.v);
}

void evaluate_stages(const Table& table, std::size_t first, std::size_t last, const Dynamics& dynamics,
                     const State& start, double h, Memory& memory) {
    memory.stages.resize(std::max(memory.stages.size(), last));
    memory.velocities.resize(std::max(memory.velocities.size(), last));
    State& trial = memory.trial;
    for (std::size_t i = first; i < last; ++i) {
        if (i == 0) {
            trial.x = start.x;
            trial.v = start.v;
        } else {
            const bool seen = dynamics.turns() || i + 1 == last;
            StageSums(h, table.row(i), memory).write(&start, seen ? Angles::summed : Angles::left, trial.x, trial.v);
            if (!dynamics.turns()) trial.v.angular = start.v.angular;
        }
        trial.time = start.time + table.c[i] * h;
        dynamics.evaluate(trial, memory.stages[i]);
        std::swap(trial.v, memory.velocities[i]);
    }
}

namespace {

void propose(const Table& table, const Dynamics& dynamics, State& state, double h, Memory& memory) {
    evaluate_stages(table, 0, table.stages(), dynamics, state, h, memory);
    State& end = memory.trial;
    sum_stages(h, table.b, memory, end);
    book_gains(dynamics, state, end.x, end.v, end.account);
    add_start(state, end);
    end.account.add(1, state.account);
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
