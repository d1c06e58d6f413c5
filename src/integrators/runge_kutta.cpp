#include "integrators/runge_kutta.hpp"

#include <algorithm>
#include <array>

#include "forces/gains.hpp"
#include "integrators/propose.hpp"
#include "state/rows_text.hpp"

namespace carom {

namespace {

enum class Angles { summed, left };

/// Sums over stages, of places from the velocities there, of velocities from the accelerations. Small terms are summed
/// before they meet the large one, the start, which rounds once.
class StageSums {
  public:
    StageSums(double h, std::span<const double> weights, const Memory& memory) {
        const Motion* const velocity = memory.velocities.data();
        const Rates* const rates = memory.stages.data();
        if (velocity->size() == 0) return;  // there is no first number then to point at
        for (std::size_t j = 0; j < weights.size(); ++j) {
            if (weights[j] == 0) continue;
            const double weight = h * weights[j];
            x_[count_] = {weight, &velocity[j].linear.data()->x};
            v_[count_] = {weight, &rates[j].acceleration.linear.data()->x};
            stage_[count_++] = j;
        }
    }
    /// From a start if there is one.
    void write(const Memory& memory, const State* start, Angles angles, Motion& x, Motion& v) {
        const std::size_t rows = memory.velocities[0].size();
        x.resize(rows), v.resize(rows);
        if (rows == 0) return;
        sum(x_, 2 * rows, start ? &start->x.linear.data()->x : nullptr, &x.linear.data()->x);
        sum(v_, 2 * rows, start ? &start->v.linear.data()->x : nullptr, &v.linear.data()->x);
        if (angles == Angles::left) return;
        for (std::size_t k = 0; k < count_; ++k) {
            x_[k].in = memory.velocities[stage_[k]].angular.data();
            v_[k].in = memory.stages[stage_[k]].acceleration.angular.data();
        }
        sum(x_, rows, start ? start->x.angular.data() : nullptr, x.angular.data());
        sum(v_, rows, start ? start->v.angular.data() : nullptr, v.angular.data());
    }

  private:
    using Terms = std::array<Term, most_stages>;
    void sum(const Terms& terms, std::size_t numbers, const double* start, double* out) const {
        if (are_few(numbers / 2))
            combine_few(terms.data(), count_, start, out, numbers);
        else
            rows_kernel().combine(terms.data(), count_, start, out, numbers);
    }

    Terms x_, v_;
    std::array<std::size_t, most_stages> stage_;
    std::size_t count_ = 0;
};

}  // namespace

void sum_stages(double h, std::span<const double> weights, const Memory& memory, Motion& dx, Motion& dv) {
    StageSums(h, weights, memory).write(memory, nullptr, Angles::summed, dx, dv);
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
            StageSums(h, table.row(i), memory)
                .write(memory, &start, seen ? Angles::summed : Angles::left, trial.x, trial.v);
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
