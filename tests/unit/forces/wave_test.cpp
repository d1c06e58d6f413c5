// Steps that go through a large network in one wave: to the same bits as pass after pass.
#include "forces/wave.hpp"

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <mutex>

#include "forces/dynamics.hpp"
#include "unit/forces/random_system.hpp"

using namespace carom;

namespace {

/// A lattice 90 wide, of sides and diagonals, each spring with parameters of its own, two nodes held.
struct Woven {
    static constexpr std::size_t wide = 90, size = wide * 150;
    Bodies bodies;
    Forces forces;
    State start;

    Woven() {
        forces.gravity = {1, -9.81};
        Random random(4);
        std::vector<BodyId> ids;
        for (std::size_t i = 0; i < size; ++i) {
            Body body{.position = {double(i % wide), double(i / wide)}, .velocity = test::vector(random, 1)};
            if (i == 3 || i == size - 1) body = {.kind = Kind::fixed, .position = body.position};
            ids.push_back(bodies.add(body, start));
        }
        const auto tie = [&](std::size_t a, std::size_t b) {
            forces.springs.push_back(
                {.a = ids[a], .b = ids[b], .stiffness = random.uniform(50, 100), .rest_length = 1});
        };
        for (std::size_t i = 0; i + wide + 1 < size; ++i) tie(i, i + 1), tie(i + wide, i), tie(i, i + wide + 1);
    }
    Dynamics dynamics(int threads) const { return {forces, bodies, threads}; }
};

void expect_same(const State& a, const State& b) {
    EXPECT_EQ(a.x.linear, b.x.linear);
    EXPECT_EQ(a.v.linear, b.v.linear);
    EXPECT_EQ(a.account.power, b.account.power);
    for (std::size_t k = 0; k < a.account.wrench.size(); ++k) {
        EXPECT_EQ(a.account.wrench[k].force, b.account.wrench[k].force);
        EXPECT_EQ(a.account.wrench[k].torque, b.account.wrench[k].torque);
    }
}

constexpr double h = 0.01;

TEST(Wave, AKickAndThenADriftAreThoseOfTwoPasses) {
    const Woven net;
    State passes = net.start;
    Rates rates;
    const Dynamics one = net.dynamics(1);
    passes.account += one.evaluate_and_kick(h, passes, rates, Dynamics::Keep::nothing).gained;
    one.drift(h, passes);
    for (const int threads : {1, 2, 5}) {
        const Dynamics dynamics = net.dynamics(threads);
        State state = net.start;
        Rates in_wave;
        ASSERT_TRUE(dynamics.moves_in_waves(state));
        const auto wave = dynamics.kick_then_drift(h, state, in_wave);
        EXPECT_TRUE(wave.finite);
        EXPECT_EQ(in_wave.flow.power, rates.flow.power);
        state.account += wave.gain;
        expect_same(state, passes);
    }
}

TEST(Wave, ADriftAndThenAKickAreThoseOfTwoPasses) {
    const Woven net;
    State start = net.start, passes = net.start;
    Rates at_start;
    const Dynamics one = net.dynamics(1);
    one.evaluate(start, at_start);
    Rates rates = at_start;
    passes.account += one.kick_and_drift(rates.acceleration, h / 2, h, passes).gained;
    passes.account += one.evaluate_and_kick(h / 2, passes, rates, Dynamics::Keep::accelerations).gained;
    for (const int threads : {1, 2, 5}) {
        State state = net.start;
        Rates in_wave = at_start;
        const auto wave = net.dynamics(threads).drift_then_kick(h / 2, h, state, in_wave);
        EXPECT_TRUE(wave.finite);
        EXPECT_EQ(in_wave.flow.power, rates.flow.power);
        EXPECT_EQ(in_wave.acceleration.linear, rates.acceleration.linear);
        state.account += wave.first_gain;
        state.account += wave.gain;
        expect_same(state, passes);
    }
}

TEST(Wave, SaysWhereTheNumbersEnd) {
    const Woven net;
    for (const std::size_t row : {std::size_t{0}, Woven::size / 2, Woven::size - 2}) {
        State state = net.start;
        state.v.linear[row] = {1e308, 1e308};
        Rates rates;
        EXPECT_FALSE(net.dynamics(2).kick_then_drift(10, state, rates).finite) << row;
    }
    // Of Verlet a place, an angle, and what only the last kick brings about.
    for (const double drift_time : {1e-308, 1e10})
        for (const bool turns : {false, true}) {
            State state = net.start;
            (turns ? state.v.angular[7] : state.v.linear[7].x) = 1e300;
            Rates rates;
            net.dynamics(1).evaluate(state, rates);
            const auto wave = net.dynamics(2).drift_then_kick(1e-3, drift_time, state, rates);
            EXPECT_EQ(wave.finite, drift_time < 1) << turns;
        }
    State state = net.start;
    Rates rates;
    net.dynamics(1).evaluate(state, rates);
    EXPECT_FALSE(net.dynamics(2).drift_then_kick(1e307, 1e-308, state, rates).finite);
    World world({.integrator = SymplecticEuler{}, .solver = NoContact{}});
    build(world, Lattice{.nx = 100, .ny = 100, .stiffness = 1});
    world.set_velocity(world.ids()[5000], {1e308, 1e308}, 0);
    try {
        world.step(10);
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("the run went wrong"), std::string::npos) << e.what();
    }
}

TEST(Wave, NoWorkIsBeforeWhatIsAheadOrAfterWhatIsBehind) {
    constexpr std::size_t rows = 40000, reach = 700;
    for (const int threads : {1, 2, 3}) {
        const Wave wave(rows, reach, threads);
        std::vector<int> stage(wave.blocks());  // 1: ahead, 2: worked on, 3: behind
        std::mutex mutex;
        const auto near = [&](std::size_t b, int least, int most) {
            for (std::size_t k = 0; k < wave.blocks(); ++k)
                if (wave.first(k) < wave.last(b) + reach && wave.last(k) + reach > wave.first(b)) {
                    EXPECT_GE(stage[k], least);
                    EXPECT_LE(stage[k], most);
                }
        };
        const auto step = [&](std::size_t b, int to, int least, int most) {
            const std::scoped_lock lock(mutex);
            near(b, least, most);
            EXPECT_EQ(stage[b]++, to - 1);
        };
        wave.go([&](std::size_t b) { step(b, 1, 0, 1); }, [&](std::size_t b, std::size_t) { step(b, 2, 1, 2); },
                [&](std::size_t b) { step(b, 3, 2, 3); });
        EXPECT_EQ(stage, std::vector<int>(wave.blocks(), 3));
    }
}

}  // namespace
