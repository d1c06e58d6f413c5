#pragma once
// Explicit Runge-Kutta methods as data. Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I (1993).

#include <carom/integrator.hpp>
#include <span>

#include "forces/dynamics.hpp"
#include "state/memory.hpp"

namespace carom {

struct Table {
    std::span<const double> c;  ///< times of the stages, in steps
    std::span<const double> a;  ///< below the diagonal, row by row
    std::span<const double> b;  ///< weights of the stages
    int order;
    double stability;  ///< largest ω h on the imaginary axis (0: none)

    std::size_t stages() const { return c.size(); }
    std::span<const double> row(std::size_t i) const { return a.subspan(i * (i - 1) / 2, i); }
};

namespace tables {
extern const Table euler, midpoint, heun, ralston, kutta3, rk4, kutta38, dormand_prince5, dormand_prince8;
}
const Table& table_of(Tableau);

/// memory.stages[i] become the rates at the stages, memory.coefficients[i] the velocities there.
void evaluate_stages(const Table& table, const Dynamics& dynamics, const State& start, double h, Memory& memory);

/// out = start moved by h Σ weights (velocity, acceleration) of the stages; at: its time, in steps. Accounts are left.
void set_stage(const State& start, double h, std::span<const double> weights, const std::vector<Rates>& stages,
               const std::vector<Motion>& velocities, double at, State& out);

}  // namespace carom
