// Work and precision on Kepler's orbit with e = 0.6: time for ten periods, and the error of the final position.

#include <benchmark/benchmark.h>

#include <carom/carom.hpp>

namespace {

using namespace carom;

void kepler(benchmark::State& state, const Integrator& method, int steps_per_period) {
    constexpr double period = 6.283185307179586;
    double error = 0;
    for (auto _ : state) {
        World world({.integrator = method, .solver = NoContact{}});
        world.add(Body{.kind = Kind::fixed});
        const BodyId planet = world.add(Body{.position = {0.4, 0}, .velocity = {0, 2}});
        world.add(Attraction{});
        for (int n = 0; n < 10 * steps_per_period; ++n) world.step(period / steps_per_period);
        error = length(world.position(planet) - Vec2{0.4, 0});
    }
    state.counters["error"] = error;
}

}  // namespace

BENCHMARK_CAPTURE(kepler, verlet_600, Verlet{}, 600)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kepler, verlet_6000, Verlet{}, 6000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kepler, pefrl_600, Pefrl{}, 600)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kepler, rk4_600, Rk4{}, 600)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kepler, dormand_prince8_200, RungeKutta{Tableau::dormand_prince8}, 200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kepler, adaptive_1em6, Adaptive{.tolerance = 1e-6}, 10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kepler, adaptive_1em9, Adaptive{.tolerance = 1e-9}, 10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kepler, adaptive_1em12, Adaptive{.tolerance = 1e-12}, 10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kepler, gauss_radau, GaussRadau{}, 10)->Unit(benchmark::kMillisecond);
