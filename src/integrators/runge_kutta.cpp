#include "integrators/runge_kutta.hpp"

#include <algorithm>
#include <array>

#include "forces/gains.hpp"
#include "integrators/propose.hpp"

namespace carom {

namespace {

/// The sums of some stages: weights that are not zero, and where the stages' numbers begin. The small terms are summed
/// before they meet the large one, start, which rounds once.
struct Sum {
    std::array<Term, most_stages> terms;
    std::size_t count = 0;

    void add(double weight, const double* in) { terms[count++] = {weight, in}; }
    void write(const RowsKernel& kernel, const double* start, double* out, std::size_t numbers) const {
        kernel.combine(terms.data(), count, start, out, numbers);
    }
};

enum class Angles { summed, left };

/// Motions summed, that of stage j by of(j), from a start if there is one.
template <class F>
void write_sum(double h, std::span<const double> weights, F of, const Motion* start, Angles angles, Motion& out) {
    Sum linear, angular;
    out.resize(of(0).size());
    if (out.size() == 0) return;
    for (std::size_t j = 0; j < weights.size(); ++j) {
        if (weights[j] == 0) continue;
        const Motion& m = of(j);
        linear.add(h * weights[j], &m.linear.data()->x);
        angular.add(h * weights[j], m.angular.data());
    }
    const RowsKernel& kernel = rows_kernel();
    linear.write(kernel, start ? &start->linear.data()->x : nullptr, &out.linear.data()->x, 2 * out.size());
    if (angles == Angles::left) return;
    angular.write(kernel, start ? start->angular.data() : nullptr, out.angular.data(), out.size());
}

void sum_stages(double h, std::span<const double> weights, const Memory& memory, const State* start, Angles angles,
                Motion& x, Motion& v) {
    const auto velocity = [&](std::size_t j) -> const Motion& { return memory.velocities[j]; };
    const auto acceleration = [&](std::size_t j) -> const Motion& { return memory.stages[j].acceleration; };
    write_sum(h, weights, velocity, start ? &start->x : nullptr, angles, x);
    write_sum(h, weights, acceleration, start ? &start->v : nullptr, angles, v);
}

}  // namespace

void sum_stages(double h, std::span<const double> weights, const Memory& memory, Motion& dx, Motion& dv) {
    sum_stages(h, weights, memory, nullptr, Angles::summed, dx, dv);
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
        std::swap(trial.v, memory.velocities[i]);
        if (i == 0) {
            trial.x = start.x;
            trial.v = start.v;
        } else {
            const bool seen = dynamics.turns() || i + 1 == last;
            sum_stages(h, table.row(i), memory, &start, seen ? Angles::summed : Angles::left, trial.x, trial.v);
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
