#include <cmath>
#include <limits>

#include "integrators/propose.hpp"
#include "integrators/runge_kutta.hpp"

namespace carom {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

// Explicit Euler and the methods of order 2 have no stable step on an undamped spring: they grow, slowly, and that is
// theirs to show. Held to ω h ≤ 1 they do not explode.
double of(const Table& table) { return table.stability > 0 ? table.stability : 1; }

}  // namespace

double stability_limit(const Integrator& method) {
    struct Limit {
        double operator()(const Euler&) { return of(tables::euler); }
        double operator()(const SymplecticEuler&) { return 2; }
        double operator()(const Verlet&) { return 2; }
        double operator()(const Pefrl&) { return 2.98944954590; }  // where its map of x, v/ω has the trace −2
        double operator()(const Rk4&) { return of(tables::rk4); }
        double operator()(const RungeKutta& m) { return of(table_of(m.tableau)); }
        double operator()(const Adaptive&) { return unlimited; }
        double operator()(const Nystrom&) { return unlimited; }
        double operator()(const GaussRadau&) { return unlimited; }
        double operator()(const Implicit&) { return unlimited; }
    };
    return std::visit(Limit{}, method);
}

double drift_share(const Integrator& method) {
    if (std::holds_alternative<Euler>(method)) return 0;
    return std::holds_alternative<SymplecticEuler>(method) ? 1 : 0.5;
}

double ramp_share(const Integrator& method) {
    constexpr double exact = 1.0 / 6;
    if (std::holds_alternative<Implicit>(method)) return 0.25;  // all of it from the middle
    if (const auto* rk = std::get_if<RungeKutta>(&method)) return table_of(rk->tableau).order > 2 ? exact : 0;
    const bool asks_at_start = std::holds_alternative<Verlet>(method) || drift_share(method) != 0.5;
    return asks_at_start ? 0 : exact;
}

// With x'' = −ω² x − γ x' a kick-drift method is stable while (ω h / 2)² + γ h / 2 < 1; the others are near that. A
// tenth is kept back, since stiffness changes within a step.
double longest_stable_step(const Stiffness& springs, double limit) {
    const double w = springs.frequency / limit, g = springs.damping_rate / 2;
    if (w == 0 && g == 0) return unlimited;
    // h solves (w h)² + g h = 0.9².
    constexpr double margin = 0.81;
    return 2 * margin / (g + std::sqrt(g * g + 4 * margin * w * w));
}

}  // namespace carom
