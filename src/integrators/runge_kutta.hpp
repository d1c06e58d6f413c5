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

/// A method with an estimate of its error and an interpolation over its step.
struct Embedded {
    Table stages;                    ///< those of the method, one at the new state, those of the interpolation
    double widest_gap;               ///< between the times of two stages, in steps
    std::size_t last;                ///< the stage at the new state, which is the first one of the next step
    std::span<const double> error;   ///< weights of stages 0 to last
    std::span<const double> coarse;  ///< those of a second estimate of lower order, or none
    std::span<const double> dense;   ///< row by row, weights of all stages: the interpolation's higher coefficients
};

namespace tables {
extern const Table euler, midpoint, heun, ralston, kutta3, rk4, kutta38, dormand_prince5, dormand_prince8;
extern const Embedded dormand_prince54, dormand_prince853;
}  // namespace tables
const Table& table_of(Tableau);
const Embedded& table_of(Pair);

/// memory.stages[i] become the rates at the stages from first to last - 1, memory.velocities[i] the velocities there.
/// The earlier ones must be known; the places of the last stage are left in memory.trial.
void evaluate_stages(const Table& table, std::size_t first, std::size_t last, const Dynamics& dynamics,
                     const State& start, double h, Memory& memory);

/// h Σ weights (velocity, acceleration) of the stages.
void sum_stages(double h, std::span<const double> weights, const Memory& memory, Motion& dx, Motion& dv);
/// h Σ weights of their flows.
Flows sum_flows(double h, std::span<const double> weights, const Memory& memory);
/// Both.
void sum_stages(double h, std::span<const double> weights, const Memory& memory, State& out);
/// Makes of a change of places and velocities those that it leads to from a start.
void add_start(const State& start, State& change);

}  // namespace carom
