// A gas of elastic discs of mixed radii (1 : 4, packing fraction 0.3) between walls, one step of 1/240 s: Carom's two
// ways, beside Chipmunk 7 and Box2D 2.4 from Debian, at their default settings. Items are discs moved by a step.

#include <benchmark/benchmark.h>
#include <box2d/box2d.h>
#include <chipmunk/chipmunk.h>

#include <carom/carom.hpp>
#include <cmath>

namespace {

using namespace carom;

constexpr double step = 1.0 / 240, smallest = 0.02, largest = 0.08;

double side_for(int discs) {
    const double mean_square = (smallest * smallest + smallest * largest + largest * largest) / 3;
    return std::sqrt(discs * 3.14159265358979 * mean_square / 0.3);
}

World make_gas(int discs, bool time_of_impact) {
    World world({.solver = Impulse{.time_of_impact = time_of_impact}});
    const double side = side_for(discs);
    world.add(Rectangle{{0, 0}, {side, side}});
    build(world, Gas{.fill = {.low = {0, 0},
                              .high = {side, side},
                              .count = discs,
                              .smallest_radius = smallest,
                              .largest_radius = largest}});
    return world;
}

void run_carom(benchmark::State& state, bool time_of_impact) {
    World world = make_gas(static_cast<int>(state.range(0)), time_of_impact);
    const double before = energy(world).total();
    for (auto _ : state) world.step(step);
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.counters["energy_kept"] = energy(world).total() / before;
}

void carom_textbook(benchmark::State& state) { run_carom(state, false); }
void carom_time_of_impact(benchmark::State& state) { run_carom(state, true); }

void chipmunk(benchmark::State& state) {
    const World gas = make_gas(static_cast<int>(state.range(0)), false);
    const double side = side_for(static_cast<int>(state.range(0)));
    cpSpace* space = cpSpaceNew();
    cpSpaceUseSpatialHash(space, 2 * largest, static_cast<int>(2 * state.range(0)));
    const cpVect corner[] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
    for (int k = 0; k < 4; ++k) {
        cpShape* wall =
            cpSpaceAddShape(space, cpSegmentShapeNew(cpSpaceGetStaticBody(space), corner[k], corner[(k + 1) % 4], 0));
        cpShapeSetElasticity(wall, 1);
    }
    for (std::size_t i = 0; i < gas.size(); ++i) {
        const double r = gas.radii()[i], m = gas.masses()[i];
        cpBody* body = cpSpaceAddBody(space, cpBodyNew(m, cpMomentForCircle(m, 0, r, cpvzero)));
        cpBodySetPosition(body, {gas.positions()[i].x, gas.positions()[i].y});
        cpBodySetVelocity(body, {gas.velocities()[i].x, gas.velocities()[i].y});
        cpShapeSetElasticity(cpSpaceAddShape(space, cpCircleShapeNew(body, r, cpvzero)), 1);
    }
    const auto kinetic = [&] {
        double sum = 0;
        cpSpaceEachBody(
            space, [](cpBody* body, void* total) { *static_cast<double*>(total) += cpBodyKineticEnergy(body); }, &sum);
        return sum;
    };
    const double before = kinetic();
    for (auto _ : state) cpSpaceStep(space, step);
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.counters["energy_kept"] = kinetic() / before;
    cpSpaceFree(space);
}

void box2d(benchmark::State& state) {
    const World gas = make_gas(static_cast<int>(state.range(0)), false);
    const auto side = static_cast<float>(side_for(static_cast<int>(state.range(0))));
    b2World world({0, 0});
    b2BodyDef none;
    b2Body* ground = world.CreateBody(&none);
    const b2Vec2 corner[] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
    for (int k = 0; k < 4; ++k) {
        b2EdgeShape edge;
        edge.SetTwoSided(corner[k], corner[(k + 1) % 4]);
        b2FixtureDef fixture;
        fixture.shape = &edge;
        fixture.restitution = 1;
        fixture.friction = 0;
        ground->CreateFixture(&fixture);
    }
    for (std::size_t i = 0; i < gas.size(); ++i) {
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.position = {static_cast<float>(gas.positions()[i].x), static_cast<float>(gas.positions()[i].y)};
        def.linearVelocity = {static_cast<float>(gas.velocities()[i].x), static_cast<float>(gas.velocities()[i].y)};
        b2CircleShape circle;
        circle.m_radius = static_cast<float>(gas.radii()[i]);
        b2FixtureDef fixture;
        fixture.shape = &circle;
        fixture.density = static_cast<float>(gas.masses()[i] / (3.14159265358979 * gas.radii()[i] * gas.radii()[i]));
        fixture.restitution = 1;
        fixture.friction = 0;
        world.CreateBody(&def)->CreateFixture(&fixture);
    }
    const auto kinetic = [&] {
        double sum = 0;
        for (b2Body* body = world.GetBodyList(); body; body = body->GetNext())
            sum += 0.5 * body->GetMass() * body->GetLinearVelocity().LengthSquared();
        return sum;
    };
    const double before = kinetic();
    for (auto _ : state) world.Step(static_cast<float>(step), 8, 3);
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.counters["energy_kept"] = kinetic() / before;
}

}  // namespace

BENCHMARK(carom_textbook)
    ->Name("gas/carom_textbook")
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(carom_time_of_impact)
    ->Name("gas/carom_time_of_impact")
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(chipmunk)->Name("gas/chipmunk")->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(box2d)->Name("gas/box2d")->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
