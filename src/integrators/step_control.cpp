#include "integrators/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <carom/error.hpp>
#include <cmath>
#include <limits>

#include "integrators/runge_kutta.hpp"
#include "math/elementary.hpp"
#include "math/rough.hpp"

namespace carom {

namespace {

double largest(const Motion& x, const Motion& a, const Motion& b, double tolerance, Angles angles, std::size_t first,
               std::size_t last) {
    if (first == last) return 0;
    const auto of = [&](const auto& look) {
        const auto flat = [first](const Motion& motion) { return &motion.linear.data()[first].x; };
        const auto angular = [first](const Motion& motion) { return motion.angular.data() + first; };
        const double along = look(flat(x), flat(a), flat(b), tolerance, 2 * (last - first));
        if (angles == Angles::left) return along;
        return std::max(along, look(angular(x), angular(a), angular(b), tolerance, last - first));
    };
    if (are_few(last - first)) return of([](auto... in) { return largest_of_few(in...); });
    return of(rows_kernel().largest);
}

}  // namespace

double largest_motion(const State& x, const State& a, const State& b, double tolerance, Angles angles,
                      std::size_t first, std::size_t last) {
    return std::max(largest(x.x, a.x, b.x, tolerance, angles, first, last),
                    largest(x.v, a.v, b.v, tolerance, angles, first, last));
}

double largest(const State& x, const State& a, const State& b, double tolerance) {
    double worst = largest_motion(x, a, b, tolerance, Angles::summed, 0, x.size());
    for (const Account k : controlled) {
        const double size =
            std::abs(x.account[k]) / (tolerance * std::max({1.0, std::abs(a.account[k]), std::abs(b.account[k])}));
        if (!(size <= worst)) worst = size == size ? size : std::numeric_limits<double>::infinity();
    }
    return worst;
}

double first_step(int order, double tolerance, const Dynamics& dynamics, Memory& memory) {
    constexpr double start = 1;
    const State& at = memory.end;
    State rates;
    sum_stages(1, {&start, 1}, memory, rates);
    const double d0 = largest(at, at, at, tolerance), d1 = largest(rates, at, at, tolerance);
    const double h0 = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * (d0 / d1);

    memory.stages.resize(std::max<std::size_t>(memory.stages.size(), 2));
    memory.velocities.resize(std::max<std::size_t>(memory.velocities.size(), 2));
    sum_stages(h0, {&start, 1}, memory, memory.trial.x, memory.trial.v);
    add_start(at, memory.trial);
    memory.trial.time = at.time + h0;
    dynamics.evaluate(memory.trial, memory.stages[1]);
    memory.velocities[1] = memory.trial.v;
    constexpr double change[] = {-1, 1};
    sum_stages(1, change, memory, rates);
    const double d2 = largest(rates, at, at, tolerance) / h0, steepest = std::max(d1, d2);
    const double h1 = steepest <= 1e-15 ? std::max(1e-6, 1e-3 * h0) : portable::pow(0.01 / steepest, 1.0 / order);
    return std::min(100 * h0, h1);
}

double next_step(int order, double h, double error, double before) {
    const double beta = 0.2 / order, alpha = 1.0 / order - 0.75 * beta;
    const double exponent = beta * rough_log2(before) - alpha * rough_log2(std::clamp(error, 1e-10, 1e300));
    return h * std::clamp(0.9 * rough_exp2(exponent), 0.2, 6.0);
}

void require_step(const char* method, double h, bool rejected, double time, double wanted, double tolerance) {
    if (h > 0 && !(rejected && h < 1e-14 * std::max(std::abs(time), wanted))) return;
    throw Error(fmt::format("the integrator '{}' found no step short enough at t = {:.6g} s: a force grows without "
                            "bound, or a tolerance of {} is more than doubles can give",
                            method, time, tolerance),
                Error::Cause::run);
}

void remember_step(double h, double proposed, double error, bool rejected, bool shortened, Memory& memory) {
    memory.step = rejected ? std::min(h, proposed) : shortened ? std::max(memory.step, proposed) : proposed;
    memory.error = std::max(error, 1e-4);
}

}  // namespace carom
