// Springs and attractions: time of one Verlet step. Items are springs, and pairs.

#include <benchmark/benchmark.h>

#include <carom/carom.hpp>

namespace {

using namespace carom;

void cloth(benchmark::State& state) {
    World world({.solver = NoContact{}});
    const int n = static_cast<int>(state.range(0));
    build(world, Lattice{.nx = n, .ny = n, .stiffness = 100, .shear_stiffness = 100, .bend_stiffness = 100});
    const double h = 0.1 * world.stable_step();
    for (auto _ : state) world.step(h);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(world.springs().size()));
}

void attraction(benchmark::State& state) {
    World world({.solver = NoContact{}, .threads = static_cast<int>(state.range(1))});
    const auto n = state.range(0);
    const double side = std::sqrt(static_cast<double>(n));
    build(world, Gas{.fill = {.low = {0, 0}, .high = {side, side}, .count = static_cast<int>(n)}});
    world.add(Attraction{.softening = 0.1});
    for (auto _ : state) world.step(1e-3);
    state.SetItemsProcessed(state.iterations() * n * (n - 1) / 2);
}

}  // namespace

BENCHMARK(cloth)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(attraction)->Args({4000, 1})->Args({4000, 2})->UseRealTime()->Unit(benchmark::kMillisecond);
