// Soft discs in a periodic box, a whole World::step with ledger: 316² of diameter 1 and mass 1, packing fraction 0.8,
// k = 1e4, speeds of 1 a component, 20 steps a blow. Items are discs moved by a step. The same in LAMMPS:
// `lmp -in benchmarks/soft_discs.lmp` (Debian's package lammps).
//
// Arguments: threads, damping γ. Without damping Verlet, with it symplectic Euler: one look at the forces a step, as in
// LAMMPS.

#include <benchmark/benchmark.h>

#include <carom/carom.hpp>

namespace {

using namespace carom;

constexpr int side = 316;
constexpr double spacing = 0.990831, step = 0.0011;  // √(π/4/0.8), and π √(½ / 1e4) / 20

void soft_discs(benchmark::State& state) {
    const auto damping = static_cast<double>(state.range(1));
    const Integrator method = damping > 0 ? Integrator{SymplecticEuler{}} : Integrator{Verlet{}};
    World world({.integrator = method, .solver = NoContact{}, .threads = static_cast<int>(state.range(0))});
    world.add(Periodic{.low = {0, 0}, .high = {side * spacing, side * spacing}});
    NumpyRandom random(1);
    for (int i = 0; i < side * side; ++i)
        world.add(Body{.position = {spacing * (i % side), spacing * (i / side)},
                       .velocity = {random.normal(), random.normal()},
                       .radius = 0.5});
    world.add(SoftDiscs{.stiffness = 1e4, .damping = damping});
    run(world, 100 * step, step);
    for (auto _ : state) world.step(step);
    state.SetItemsProcessed(state.iterations() * side * side);
}

}  // namespace

BENCHMARK(soft_discs)->ArgsProduct({{1, 2}, {0, 10}})->UseRealTime()->Unit(benchmark::kMillisecond);
