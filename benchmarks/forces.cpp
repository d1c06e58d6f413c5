// Attractions: time of one Verlet step. Items are pairs.

#include <benchmark/benchmark.h>

#include <carom/carom.hpp>

namespace {

using namespace carom;

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

BENCHMARK(attraction)->Args({4000, 1})->Args({4000, 2})->UseRealTime()->Unit(benchmark::kMillisecond);
