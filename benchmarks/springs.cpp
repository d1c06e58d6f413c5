// Springs: a whole World::step of a cloth (structural, shear and bend springs), and in the same run what the memory of
// the machine gives a plain loop, which bounds what a step that does not fit into the cache can do.
//
// Arguments: nodes a side, threads, 1 for a stiffness and a rest length of each spring's own. Items are springs. A step
// at `limit` is so near to the stability limit that the bound is computed at every step.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <vector>

namespace {

using namespace carom;

constexpr double stiffness = 100;

World make_cloth(const Settings& settings, int n, bool own_parameters) {
    World lattice(settings);
    const Lattice kind{
        .nx = n, .ny = n, .stiffness = stiffness, .shear_stiffness = stiffness, .bend_stiffness = stiffness};
    build(lattice, kind);
    if (!own_parameters) return lattice;
    World world(settings);
    for (const BodyId id : lattice.ids()) world.add(lattice.body(id));
    NumpyRandom random(1);
    for (Spring spring : lattice.springs()) {
        spring.stiffness *= random.uniform(0.9, 1);
        spring.rest_length *= random.uniform(0.99, 1.01);
        world.add(spring);
    }
    return world;
}

void cloth(benchmark::State& state, const Integrator& integrator, double of_stable_step) {
    World world =
        make_cloth({.integrator = integrator, .solver = NoContact{}, .threads = static_cast<int>(state.range(1))},
                   static_cast<int>(state.range(0)), state.range(2) != 0);
    const double h = of_stable_step * world.stable_step();
    world.step(h);
    for (auto _ : state) world.step(h);
    state.counters["springs"] =
        benchmark::Counter(static_cast<double>(world.springs().size()), benchmark::Counter::kIsIterationInvariantRate);
}

void symplectic_euler(benchmark::State& state) { cloth(state, SymplecticEuler{}, 0.1); }
void verlet(benchmark::State& state) { cloth(state, Verlet{}, 0.1); }
void verlet_at_limit(benchmark::State& state) { cloth(state, Verlet{}, 0.999); }

/// Springs to anywhere near: no columns of neighbours, no parameters in common.
void random_net(benchmark::State& state) {
    World world({.solver = NoContact{}});
    NumpyRandom random(1);
    const auto n = static_cast<int>(state.range(0));
    std::vector<BodyId> made;
    for (int i = 0; i < n * n; ++i)
        made.push_back(
            world.add(Body{.position = {i % n + random.uniform(-0.3, 0.3), i / n + random.uniform(-0.3, 0.3)}}));
    for (int i = 0; i < n * n; ++i)
        for (int k = 0; k < 6; ++k) {
            const int j = i + static_cast<int>(random.uniform(-2, 3)) + n * static_cast<int>(random.uniform(0, 3));
            if (j == i || j < 0 || j >= n * n) continue;
            world.add(Spring{
                .a = made[i], .b = made[j], .stiffness = random.uniform(50, 100), .rest_length = random.uniform(1, 2)});
        }
    const double h = 0.1 * world.stable_step();
    for (auto _ : state) world.step(h);
    state.counters["springs"] =
        benchmark::Counter(static_cast<double>(world.springs().size()), benchmark::Counter::kIsIterationInvariantRate);
}

void two_bodies(benchmark::State& state) {
    World world({.solver = NoContact{}});
    const BodyId a = world.add(Body{.kind = Kind::fixed}), b = world.add(Body{.position = {1.1, 0}});
    world.add(Spring{.a = a, .b = b, .stiffness = 100, .rest_length = 1});
    for (auto _ : state) world.step(1e-3);
}

void rope(benchmark::State& state) {
    World world({.solver = NoContact{}});
    build(world, Rope{.anchor_b = {1, 0}, .segments = 100});
    const double h = 0.1 * world.stable_step();
    for (auto _ : state) world.step(h);
}

/// The memory of the machine: a = b + 2 c over 400 MB.
void memory_triad(benchmark::State& state) {
    constexpr std::size_t n = std::size_t{1} << 24;
    std::vector<double> a(n, 1), b(n, 2), c(n, 3);
    for (auto _ : state) {
        for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 2 * c[i];
        benchmark::ClobberMemory();
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(3 * n * sizeof(double)));
}

void cloths(benchmark::internal::Benchmark* each) {
    for (const int n : {200, 1000})
        for (const int own : {0, 1})
            for (const int threads : {1, 2}) each->Args({n, threads, own});
    each->UseRealTime()->Unit(benchmark::kMillisecond);
}

}  // namespace

BENCHMARK(two_bodies)->Name("springs/two_bodies");
BENCHMARK(rope)->Name("springs/rope");
BENCHMARK(memory_triad)->Name("springs/memory_triad")->Unit(benchmark::kMillisecond);
BENCHMARK(symplectic_euler)->Name("springs/symplectic_euler")->Apply(cloths);
BENCHMARK(verlet)->Name("springs/verlet")->Apply(cloths);
BENCHMARK(verlet_at_limit)
    ->Name("springs/verlet_at_limit")
    ->Args({1000, 1, 0})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(random_net)->Name("springs/random_net")->Arg(200)->Arg(700)->Unit(benchmark::kMillisecond);
