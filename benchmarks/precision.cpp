// Work and precision: how long a method takes to reach a given error, beside Boost.odeint and GSL in the same run.
//
// Three problems with smooth forces, each ended at an odd time, where no error cancels. Every contender runs through a
// ladder of tolerances (or steps); the fastest rung whose error is small enough counts. The error is the largest of any
// coordinate of any body at the end against a reference run of ours, Gauss-Radau, which the closed forms confirm
// (tests/unit/integrators). The peers' right-hand sides are written as their users would: plain loops over an array.

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <carom/carom.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace carom;
namespace odeint = boost::numeric::odeint;

using Coordinates = std::vector<double>;  // x₀, y₀, x₁, ... of the bodies that move

/// A problem as a world, and as equations x'' = a(x) for the others: y = x..., v....
struct Problem {
    const char* name;
    double duration;
    std::function<World(const Integrator&)> world;
    Coordinates start;  ///< x, then v
    void (*accelerate)(std::size_t n, const double* x, double* a);
    double scale;  ///< of time: about how long a step of order 8 is [s]
};

// ---- The problems ---------------------------------------------------------------------------------------------------

void kepler(std::size_t, const double* x, double* a) {
    const double r2 = x[0] * x[0] + x[1] * x[1], r3 = r2 * std::sqrt(r2);
    a[0] = -x[0] / r3, a[1] = -x[1] / r3;
}
World kepler_world(const Integrator& method) {
    World world({.integrator = method, .solver = NoContact{}});
    world.add(Body{.kind = Kind::fixed});
    world.add(Body{.position = {0.4, 0}, .velocity = {0, 2}});
    world.add(Attraction{});
    return world;
}

void pendulum(std::size_t, const double* x, double* a) {
    const double d = std::sqrt(x[0] * x[0] + x[1] * x[1]), pull = 40 * (d - 1) / d;
    a[0] = -pull * x[0], a[1] = -pull * x[1] - 9.81;
}
World pendulum_world(const Integrator& method) {
    World world({.gravity = {0, -9.81}, .integrator = method, .solver = NoContact{}});
    const BodyId pivot = world.add(Body{.kind = Kind::fixed});
    const BodyId bob = world.add(Body{.position = {1, 0}});
    world.add(Spring{.a = pivot, .b = bob, .stiffness = 40, .rest_length = 1});
    return world;
}

constexpr std::size_t links = 1000;
/// A chain between two walls, stretched by half, plucked across.
void chain(std::size_t n, const double* x, double* a) {
    const auto pull = [&](double ax, double ay, double bx, double by, double* force) {
        const double dx = bx - ax, dy = by - ay, d = std::sqrt(dx * dx + dy * dy), f = (d - 1) / d;
        force[0] = f * dx, force[1] = f * dy;
    };
    double before[2], after[2];
    pull(0, 0, x[0], x[1], before);
    for (std::size_t i = 0; i < n / 2; ++i) {
        const bool last = i + 1 == n / 2;
        pull(x[2 * i], x[2 * i + 1], last ? 1.5 * links : x[2 * i + 2], last ? 0 : x[2 * i + 3], after);
        a[2 * i] = after[0] - before[0], a[2 * i + 1] = after[1] - before[1];
        before[0] = after[0], before[1] = after[1];
    }
}
Vec2 chain_place(std::size_t i) {
    const double s = static_cast<double>(i) / links;
    return {1.5 * static_cast<double>(i), 0.5 * std::sin(6 * M_PI * s) + 0.2 * std::sin(40 * M_PI * s)};
}
World chain_world(const Integrator& method) {
    World world({.integrator = method, .solver = NoContact{}});
    BodyId before{};
    for (std::size_t i = 0; i <= links; ++i) {
        const bool end = i == 0 || i == links;
        const BodyId now = world.add(Body{.kind = end ? Kind::fixed : Kind::dynamic,
                                          .position = end ? Vec2{1.5 * static_cast<double>(i), 0} : chain_place(i)});
        if (i > 0) world.add(Spring{.a = before, .b = now, .stiffness = 1, .rest_length = 1});
        before = now;
    }
    return world;
}

std::vector<Problem> problems() {
    Coordinates taut;
    for (std::size_t i = 1; i < links; ++i) taut.insert(taut.end(), {chain_place(i).x, chain_place(i).y});
    taut.resize(2 * taut.size());
    return {{"kepler, e = 0.6, 100.3 orbits", 100.3 * 2 * M_PI, kepler_world, {0.4, 0, 0, 2}, kepler, 0.25},
            {"elastic pendulum, 60.3 s", 60.3, pendulum_world, {1, 0, 0, 0}, pendulum, 0.15},
            {"chain of 1000 springs, 20.3 s", 20.3, chain_world, taut, chain, 1}};
}

// ---- The contenders -------------------------------------------------------------------------------------------------

/// What a contender does at one rung: the coordinates it ends with, and how long the motion took it. Making the world,
/// or the array, does not count.
struct Outcome {
    Coordinates end;
    double milliseconds;
};

template <class F>
double milliseconds(F f) {
    const auto start = std::chrono::steady_clock::now();
    f();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Outcome carom_run(const Problem& p, const Integrator& method, double step) {
    World world = p.world(method);
    world.stable_step();  // so that forces are ready
    const double time = milliseconds([&] { carom::run(world, p.duration, step); });
    Coordinates x;
    for (std::size_t i = 0; i < world.size(); ++i)
        if (world.kinds()[i] == Kind::dynamic) x.insert(x.end(), {world.positions()[i].x, world.positions()[i].y});
    return {x, time};
}

template <class State>
struct System {
    const Problem& p;
    void operator()(const State& y, State& dydt, double) const {
        const std::size_t n = y.size() / 2;
        std::copy(y.begin() + static_cast<std::ptrdiff_t>(n), y.end(), dydt.begin());
        p.accelerate(n, y.data(), dydt.data() + n);
    }
};

template <class Stepper, class State>
Outcome odeint_from(const Problem& p, double tolerance, State y) {
    std::copy(p.start.begin(), p.start.end(), y.begin());
    const double time = milliseconds([&] {
        odeint::integrate_adaptive(odeint::make_controlled<Stepper>(tolerance, tolerance), System<State>{p}, y, 0.0,
                                   p.duration, 0.01 * p.scale);
    });
    return {{y.begin(), y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2)}, time};
}
template <class State>
Outcome bulirsch_stoer_from(const Problem& p, double tolerance, State y) {
    std::copy(p.start.begin(), p.start.end(), y.begin());
    odeint::bulirsch_stoer<State> stepper(tolerance, tolerance);
    const double time = milliseconds(
        [&] { odeint::integrate_adaptive(stepper, System<State>{p}, y, 0.0, p.duration, 0.01 * p.scale); });
    return {{y.begin(), y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2)}, time};
}
/// With the size known when it was compiled if it is small: what a careful user writes.
template <class Small, class Large>
Outcome odeint_run(const Problem& p, double tolerance) {
    if (p.start.size() == 4) return odeint_from<Small>(p, tolerance, std::array<double, 4>{});
    return odeint_from<Large>(p, tolerance, std::vector<double>(p.start.size()));
}
Outcome bulirsch_stoer_run(const Problem& p, double tolerance) {
    if (p.start.size() == 4) return bulirsch_stoer_from(p, tolerance, std::array<double, 4>{});
    return bulirsch_stoer_from(p, tolerance, std::vector<double>(p.start.size()));
}

Outcome gsl_run(const Problem& p, const gsl_odeiv2_step_type* method, double tolerance) {
    Coordinates y = p.start;
    const std::size_t n = y.size();
    gsl_odeiv2_system system{[](double, const double from[], double to[], void* problem) {
                                 const Problem& q = *static_cast<const Problem*>(problem);
                                 const std::size_t half = q.start.size() / 2;
                                 std::copy(from + half, from + 2 * half, to);
                                 q.accelerate(half, from, to + half);
                                 return static_cast<int>(GSL_SUCCESS);
                             },
                             nullptr, n, const_cast<Problem*>(&p)};
    gsl_odeiv2_driver* driver = gsl_odeiv2_driver_alloc_y_new(&system, method, 0.01 * p.scale, tolerance, tolerance);
    double t = 0;
    const double time = milliseconds([&] { gsl_odeiv2_driver_apply(driver, &t, p.duration, y.data()); });
    gsl_odeiv2_driver_free(driver);
    y.resize(n / 2);
    return {y, time};
}

using Few = std::array<double, 4>;
using Many = std::vector<double>;
struct Contender {
    const char* name;
    std::function<Outcome(const Problem&, double tolerance)> run;
};

const std::vector<Contender>& contenders() {
    static const std::vector<Contender> all = {
        {"carom adaptive 8(5,3)",
         [](const Problem& p, double e) { return carom_run(p, Adaptive{.tolerance = e}, p.duration); }},
        {"carom adaptive 5(4)",
         [](const Problem& p, double e) {
             return carom_run(p, Adaptive{Pair::dormand_prince54, e}, p.duration);
         }},
        {"carom nystrom 6(4)",
         [](const Problem& p, double e) {
             return carom_run(p, Nystrom{NystromPair::dormand_prince64, e}, p.duration);
         }},
        {"carom nystrom 8(6)",
         [](const Problem& p, double e) {
             return carom_run(p, Nystrom{NystromPair::dormand_prince86, e}, p.duration);
         }},
        {"carom nystrom 12(10)",
         [](const Problem& p, double e) {
             return carom_run(p, Nystrom{NystromPair::dormand_prince1210, e}, p.duration);
         }},
        {"carom gauss-radau",
         [](const Problem& p, double e) {
             return carom_run(p, GaussRadau{.tolerance = std::cbrt(30 * e)}, p.duration);
         }},
        {"carom pefrl", [](const Problem& p, double e) { return carom_run(p, Pefrl{}, p.scale * std::pow(e, 0.25)); }},
        {"odeint dopri5", odeint_run<odeint::runge_kutta_dopri5<Few>, odeint::runge_kutta_dopri5<Many>>},
        {"odeint fehlberg78", odeint_run<odeint::runge_kutta_fehlberg78<Few>, odeint::runge_kutta_fehlberg78<Many>>},
        {"odeint bulirsch-stoer", bulirsch_stoer_run},
        {"gsl rk8pd", [](const Problem& p, double e) { return gsl_run(p, gsl_odeiv2_step_rk8pd, e); }},
        {"gsl msadams", [](const Problem& p, double e) { return gsl_run(p, gsl_odeiv2_step_msadams, e); }}};
    return all;
}

// ---- The table ------------------------------------------------------------------------------------------------------

double error_of(const Coordinates& x, const Coordinates& exact) {
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double error = std::abs(x[i] - exact[i]);
        if (!(error <= worst)) worst = error == error ? error : INFINITY;  // what is no number is no result
    }
    return worst;
}

constexpr double targets[] = {1e-6, 1e-9, 1e-12};

void measure(const Problem& p) {
    const Coordinates exact = carom_run(p, GaussRadau{}, p.duration / 64).end;
    std::printf("%-32s%12s%12s%12s   ms to an error of\n", p.name, "1e-6", "1e-9", "1e-12");
    for (const Contender& c : contenders()) {
        std::array<double, std::size(targets)> best;
        best.fill(INFINITY);
        for (int rung = 6; rung <= 30; ++rung) {  // tolerances from 1e-3 to 1e-15, two a decade
            const double tolerance = std::pow(10.0, -0.5 * rung);
            Coordinates end;
            Outcome out;
            try {
                out = c.run(p, tolerance);
            } catch (const Error&) {
                continue;  // so coarse that the planet fell into its sun
            }
            double time = out.milliseconds;
            if (time > 1000) break;
            const double error = error_of(out.end, exact);
            for (int again = 0; again < 4; ++again) time = std::min(time, c.run(p, tolerance).milliseconds);
            for (std::size_t k = 0; k < best.size(); ++k)
                if (error <= targets[k]) best[k] = std::min(best[k], time);
            if (error <= targets[2]) break;
        }
        std::printf("  %-30s", c.name);
        for (const double time : best) std::isfinite(time) ? std::printf("%12.3f", time) : std::printf("%12s", "-");
        std::printf("\n");
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    gsl_set_error_handler_off();
    for (const Problem& p : problems())
        if (argc < 2 || std::string(p.name).find(argv[1]) != std::string::npos) measure(p);
}
