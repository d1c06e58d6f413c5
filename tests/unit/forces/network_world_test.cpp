// Worlds with networks: the same bits however many threads and lanes, and after every edit.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

#include "simd/isa.hpp"

using namespace carom;

namespace {

class NetworkWorld : public testing::Test {
  protected:
    ~NetworkWorld() override { use_isa({}); }
};

/// More rows than one part, with a damped patch and a row that is held.
World cloth(const Settings& settings) {
    World world(settings);
    const Built made =
        build(world, Lattice{.nx = 70, .ny = 60, .shear_stiffness = 700, .bend_stiffness = 30, .held = Held::top});
    for (std::size_t k = 100; k < 140; ++k)
        world.add(
            Spring{.a = made.bodies[k], .b = made.bodies[3 * k], .stiffness = 5, .rest_length = 1, .damping = 0.2});
    world.set_velocity(made.bodies[5], {3, 1}, 0.5);
    return world;
}

std::uint64_t hash_after(World world, int steps) {
    const double h = 0.5 * world.stable_step();
    for (int i = 0; i < steps; ++i) world.step(h);
    const Energy e = energy(world);
    return state_hash(world) ^
           (__builtin_bit_cast(std::uint64_t, e.spring) + __builtin_bit_cast(std::uint64_t, e.heat.damping));
}

}  // namespace

TEST_F(NetworkWorld, HasTheSameBitsForEveryNumberOfThreadsAndInstructionSet) {
    for (const Integrator& method : {Integrator{SymplecticEuler{}}, Integrator{Verlet{}}, Integrator{Rk4{}}}) {
        const Settings settings{.gravity = {0, -9.81}, .integrator = method};
        const std::uint64_t expected = hash_after(cloth(settings), 20);
        for (const Isa which : available_isas()) {
            use_isa(which);
            for (const int threads : {1, 2, 5}) {
                Settings shared = settings;
                shared.threads = threads;
                EXPECT_EQ(hash_after(cloth(shared), 20), expected) << threads << " threads, method " << method.index();
            }
        }
        use_isa({});
    }
}

// Blocks of rows done with while they are in the cache, or pass after pass: a force of no effect makes the difference.
TEST_F(NetworkWorld, MovesInBlocksAsInPasses) {
    for (const Integrator& method : {Integrator{SymplecticEuler{}}, Integrator{Verlet{}}}) {
        World blocks({.gravity = {0, -9.81}, .integrator = method});
        build(blocks, Lattice{.nx = 70, .ny = 60, .held = Held::left});
        World passes = blocks;
        passes.add(ConstantForce{.body = passes.ids()[0], .force = {0, 0}});
        for (World* w : {&blocks, &passes})
            for (int i = 0; i < 50; ++i) w->step(0.003);
        EXPECT_EQ(state_hash(blocks), state_hash(passes));
    }
}

TEST_F(NetworkWorld, IsTheSameWhetherBuiltAtOnceOrEdited) {
    const auto tie = [](World& world, std::size_t i, std::size_t j) {
        world.add(Spring{.a = world.ids()[i], .b = world.ids()[j], .stiffness = 3 + double(i), .rest_length = 0.3});
    };
    World edited, fresh;
    for (int i = 0; i < 30; ++i)
        for (World* w : {&edited, &fresh}) w->add(Body{.position = {0.1 * i, 0.01 * i * i}, .mass = 1.0 + 0.1 * i});
    const BodyId doomed = edited.add(Body{.position = {9, 9}});  // the last one: rows stay
    edited.add(Spring{.a = doomed, .b = edited.ids()[3], .stiffness = 0});
    for (World* w : {&edited, &fresh})
        for (std::size_t i = 0; i + 1 < 20; ++i) tie(*w, i, i + 1);
    edited.step(0.01);
    fresh.step(0.01);
    edited.remove(doomed);
    for (World* w : {&edited, &fresh}) {
        tie(*w, 22, 29);
        for (int i = 0; i < 100; ++i) w->step(0.01);
    }
    EXPECT_EQ(edited.springs().size(), 20u);
    for (std::size_t i = 0; i < fresh.size(); ++i) EXPECT_EQ(edited.positions()[i], fresh.positions()[i]);
}

TEST_F(NetworkWorld, MovesOnWhenABodyIsPushedByHand) {
    World world({.integrator = SymplecticEuler{}});
    const BodyId a = world.add(Body{.kind = Kind::fixed}), b = world.add(Body{.position = {2, 0}});
    world.add(Spring{.a = a, .b = b, .stiffness = 10, .rest_length = 1});
    world.step(0.01);
    world.set_position(b, {0, 3}, 0);
    world.set_velocity(b, {0, 0}, 0);
    world.step(0.01);
    EXPECT_NEAR(world.velocity(b).x, 0, 1e-15);
    EXPECT_NEAR(world.velocity(b).y, -0.01 * 10 * 2, 1e-15);
}

TEST_F(NetworkWorld, WorksOnWhoHoldsAndDrivesItsEnds) {
    World world;
    const BodyId wall = world.add(Body{.kind = Kind::fixed});
    const BodyId ball = world.add(Body{.position = {1.2, 0}});
    const BodyId hand = world.add(Body{.kind = Kind::driven, .position = {2, 0}, .velocity = {0.5, 0}});
    world.add(Spring{.a = wall, .b = ball, .stiffness = 30, .rest_length = 1, .damping = 0.5});
    world.add(Spring{.a = ball, .b = hand, .stiffness = 20, .rest_length = 1});
    run(world, 1, 1e-3);
    const Energy e = energy(world);
    EXPECT_GT(e.work.driven, 1);
    EXPECT_GT(e.heat.damping, 0.01);
    EXPECT_NEAR(e.residual, 0, 1e-5);
}

// Longitudinal modes of a chain between walls: ω_j = 2 √(k/m) sin(j π / 2 (N + 1)), exactly, as its springs stay
// straight.
TEST_F(NetworkWorld, SwingsInTheModesOfAChain) {
    constexpr int n = 31;
    constexpr double k = 40, m = 0.5, spacing = 1, amplitude = 0.01;
    for (const int mode : {1, 2, 7, 31}) {
        World world({.integrator = Pefrl{}, .solver = NoContact{}});
        std::vector<BodyId> chain;
        for (int i = 0; i <= n + 1; ++i)
            chain.push_back(world.add(
                Body{.kind = i == 0 || i == n + 1 ? Kind::fixed : Kind::dynamic,
                     .position = {spacing * i + amplitude * std::sin(std::numbers::pi * mode * i / (n + 1)), 0},
                     .mass = m}));
        for (int i = 0; i <= n; ++i)
            world.add(Spring{.a = chain[i], .b = chain[i + 1], .stiffness = k, .rest_length = spacing});
        const double omega = 2 * std::sqrt(k / m) * std::sin(std::numbers::pi * mode / (2 * (n + 1)));
        const double duration = 2;
        run(world, duration, 1e-3);
        for (int i = 1; i <= n; ++i) {
            const double expected =
                amplitude * std::sin(std::numbers::pi * mode * i / (n + 1)) * std::cos(omega * duration);
            EXPECT_NEAR(world.position(chain[i]).x - spacing * i, expected, 1e-9 * amplitude + 4e-15) << mode;
        }
    }
}

// A few bodies are gone through one by one, more of them in lanes.
TEST_F(NetworkWorld, APairMovesAsItDoesAmongOthers) {
    const auto after_three_seconds = [](const Integrator& method, std::size_t others) {
        World world({.gravity = {0.3, -9.81}, .integrator = method, .solver = NoContact{}});
        const BodyId a = world.add(Body{.position = {0.1, 0.2}, .velocity = {1, 0.5}, .mass = 3});
        const BodyId b = world.add(Body{.kind = Kind::fixed, .position = {1.7, -0.4}});
        world.add(Spring{.a = a, .b = b, .stiffness = 50, .rest_length = 1.2, .damping = 0.3});
        world.add(Spring{.a = b, .b = a, .stiffness = 7, .rest_length = 2});
        for (std::size_t k = 0; k < others; ++k)
            world.add(Body{.kind = Kind::fixed, .position = {static_cast<double>(k), 5}});
        run(world, 3, 0.01);
        const Energy e = energy(world);
        const Momentum held = momentum_balance(world).held;
        return std::vector<double>{world.positions()[0].x,
                                   world.positions()[0].y,
                                   world.velocities()[0].x,
                                   e.heat.damping,
                                   e.residual,
                                   held.linear.x,
                                   held.angular};
    };
    for (const Integrator& method : {Integrator(Verlet{}), Integrator(Adaptive{}), Integrator(GaussRadau{})}) {
        const std::vector<double> alone = after_three_seconds(method, 0);
        for (const Isa which : available_isas()) {
            use_isa(which);
            for (const std::size_t others : {1, 2, 3, 6, 7, 30})
                EXPECT_EQ(after_three_seconds(method, others), alone) << others;
        }
    }
}
