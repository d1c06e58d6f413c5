// Soft discs against the closed forms of the damped oscillator that a blow of two of them is.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

#include "simd/isa.hpp"
#include "unit/forces/random_system.hpp"

using namespace carom;

namespace {

constexpr double k = 2000, m1 = 2, m2 = 3, reduced = m1 * m2 / (m1 + m2), r1 = 0.3, r2 = 0.2;

double duration_of_blow(double damping) { return std::numbers::pi / std::sqrt(k / reduced - 0.25 * damping * damping); }

/// Overlap and its rate at a time of a blow at 1 m/s: the damped oscillator.
struct Phase {
    double overlap, rate;
};
Phase phase(double damping, double t) {
    const double w = std::numbers::pi / duration_of_blow(damping), faded = std::exp(-0.5 * damping * t);
    return {faded * std::sin(w * t) / w, faded * (std::cos(w * t) - 0.5 * damping / w * std::sin(w * t))};
}

/// Two discs on a slanted line at that time of their blow.
World head_on(double damping, const Integrator& integrator, double t = 0) {
    World world({.integrator = integrator, .solver = NoContact{}});
    const Vec2 n{0.6, 0.8};
    const auto [overlap, rate] = phase(damping, t);
    world.add(Body{.velocity = (rate * m2 / (m1 + m2)) * n, .mass = m1, .radius = r1});
    world.add(
        Body{.position = (r1 + r2 - overlap) * n, .velocity = (-rate * m1 / (m1 + m2)) * n, .mass = m2, .radius = r2});
    world.add(SoftDiscs{.stiffness = k, .damping = damping});
    return world;
}

/// Rate at which the centres part.
double parting(const World& world) {
    const Vec2 d = world.positions()[1] - world.positions()[0], v = world.velocities()[1] - world.velocities()[0];
    return dot(d, v) / length(d);
}

double overlap(const World& world) { return r1 + r2 - length(world.positions()[1] - world.positions()[0]); }

/// Some hundred discs of mixed sizes, many of them in one another, in a room without walls or a periodic box.
World crowd(std::uint64_t seed, double damping, int threads, bool periodic, int count = 300) {
    World world({.integrator = Verlet{}, .solver = NoContact{}, .threads = threads});
    const double size = std::sqrt(count / 300.0);  // as dense for any number
    if (periodic) world.add(Periodic{.low = {-1, 2}, .high = {9 * size - 1, 8 * size + 2}});
    Random random(seed);
    for (int i = 0; i < count; ++i)
        world.add(Body{.kind = i % 50 == 7 ? Kind::fixed : Kind::dynamic,
                       .position = {size * random.uniform(0, 9), size * random.uniform(0, 8)},
                       .velocity = i % 50 == 7 ? Vec2{} : Vec2{random.normal(), random.normal()},
                       .mass = random.uniform(0.5, 2),
                       .radius = i % 11 == 0 ? 0 : random.uniform(0.1, 0.4)});
    world.add(SoftDiscs{.stiffness = 500, .damping = damping});
    return world;
}

class SoftDisc : public testing::Test {
  protected:
    ~SoftDisc() override { use_isa({}); }
};

}  // namespace

TEST_F(SoftDisc, BlowLastsAsLongAndLeavesAsMuchAsTheClosedFormSays) {
    for (const double damping : {0.0, 3.0, 20.0}) {
        const double t = duration_of_blow(damping);
        World world = head_on(damping, Rk4{});
        run(world, t, t / 20000);
        // The damping begins and ends with a jump, of which a step sees a part: an error of order γ h, here 5e-6.
        EXPECT_NEAR(overlap(world) / t, 0, 1e-5) << damping;
        EXPECT_NEAR(parting(world), std::exp(-0.5 * damping * t), 1e-5) << damping;
        EXPECT_NEAR(energy(world).heat.impact, 0.5 * reduced * (1 - std::exp(-damping * t)), 1e-5) << damping;
        EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-14) << damping;
    }
}

TEST_F(SoftDisc, BlowIsADampedOscillation) {
    for (const double damping : {0.0, 3.0, 20.0}) {
        const double t = duration_of_blow(damping);
        World world = head_on(damping, Rk4{}, 0.1 * t);
        run(world, 0.8 * t, t / 2000);
        const auto [depth, rate] = phase(damping, 0.9 * t);
        EXPECT_NEAR(overlap(world), depth, 1e-13) << damping;  // RK4: (ω h)⁴ = 6e-12, of 0.02 m
        EXPECT_NEAR(-parting(world), rate, 1e-11) << damping;
    }
}

TEST_F(SoftDisc, DeepestOverlapIsThatOfTheOscillator) {
    World world = head_on(0, Rk4{});
    run(world, 0.5 * duration_of_blow(0), duration_of_blow(0) / 2000);
    EXPECT_NEAR(overlap(world), std::sqrt(reduced / k), 1e-11);
}

TEST_F(SoftDisc, VerletHasOrderTwoWithinABlow) {
    for (const double damping : {0.0, 5.0}) {
        const double t = duration_of_blow(damping);
        const auto error = [&](int steps) {
            World world = head_on(damping, Verlet{}, 0.1 * t);
            run(world, 0.6 * t, 0.6 * t / steps);
            return std::abs(overlap(world) - phase(damping, 0.7 * t).overlap);
        };
        EXPECT_NEAR(std::log2(error(50) / error(100)), 2, 0.1) << damping;
    }
}

TEST_F(SoftDisc, ForceIsTheGradientOfItsPotentialAmongMany) {
    for (int seed = 0; seed < 10; ++seed) {
        test::System s = test::random_system(seed, Kind::fixed, 12);
        s.forces.soft_discs = {{.stiffness = 3, .damping = 0}};
        const Rates rates = s.rates();
        for (std::size_t i = 0; i + 1 < s.bodies.size(); ++i) {
            const auto slope = [&](auto member) {
                constexpr double h = 1e-6;  // U is quadratic but for 1/r: truncation 1e-12, rounding 1e-9
                State plus = s.state, minus = s.state;
                member(plus) += h, member(minus) -= h;
                return (s.potential(plus) - s.potential(minus)) / (2 * h);
            };
            const Vec2 force = s.bodies.mass[i] * rates.acceleration.linear[i];
            EXPECT_NEAR(force.x, -slope([i](State& q) -> double& { return q.x.linear[i].x; }), 2e-8);
            EXPECT_NEAR(force.y, -slope([i](State& q) -> double& { return q.x.linear[i].y; }), 2e-8);
        }
    }
}

TEST_F(SoftDisc, ForcesAreThoseOfAllPairsWhereverTheDiscsHaveGone) {
    // Neighbours are found again when discs have moved, across the edges of a periodic box too.
    for (const bool periodic : {false, true}) {
        World world = crowd(3, 0, 1, periodic);
        for (int step = 0; step < 200; ++step) world.step(0.005);
        double plain = 0;
        const auto x = world.positions();
        for (std::size_t i = 0; i < world.size(); ++i)
            for (std::size_t j = i + 1; j < world.size(); ++j) {
                if (world.kinds()[i] == Kind::fixed && world.kinds()[j] == Kind::fixed) continue;
                const double reach = world.radii()[i] + world.radii()[j];
                if (world.radii()[i] == 0 || world.radii()[j] == 0) continue;
                Vec2 d = x[j] - x[i];
                if (periodic) d = {d.x - 9 * std::round(d.x / 9), d.y - 8 * std::round(d.y / 8)};
                const double depth = std::max(0.0, reach - length(d));
                plain += 0.5 * 500 * depth * depth;
            }
        EXPECT_GT(plain, 10);
        EXPECT_NEAR(energy(world).field, plain, 1e-11 * plain) << periodic;
    }
}

TEST_F(SoftDisc, EnergyIsKeptWithoutDampingAndBookedWithIt) {
    for (const double damping : {0.0, 2.0}) {
        World world = crowd(1, damping, 1, false);
        const double before = energy(world).total();
        run(world, 0.5, 2e-4);
        const Energy after = energy(world);
        // Verlet's error of order h² swings; it does not add up.
        EXPECT_NEAR(after.total() + after.heat.impact, before, 4e-5 * before) << damping;
        EXPECT_EQ(after.heat.impact > 0, damping > 0);
    }
}

TEST_F(SoftDisc, BitsDoNotDependOnThreadsLanesAndWhenNeighboursWereLookedFor) {
    const auto hash = [](int threads) {
        World world = crowd(5, 1, threads, true, 3000);
        run(world, 0.2, 0.002);
        return state_hash(world);
    };
    const std::uint64_t one = hash(1);
    EXPECT_EQ(hash(2), one);
    for (const Isa which : available_isas()) {
        use_isa(which);
        EXPECT_EQ(hash(1), one);
    }
    // A copy that was edited looks for neighbours anew.
    World world = crowd(5, 0, 1, true);
    run(world, 0.05, 0.002);
    World copy = world;
    copy.set_velocity(copy.ids()[0], copy.velocities()[0], copy.angular_velocities()[0]);
    run(world, 0.2, 0.002), run(copy, 0.2, 0.002);
    EXPECT_EQ(state_hash(world), state_hash(copy));
}

// Where nobody has a neighbour there is no list of any. Narrow lanes looked for their part of it (undefined behaviour).
TEST_F(SoftDisc, WhoIsAloneFliesOnUnderAllInstructions) {
    for (const Isa which : available_isas()) {
        use_isa(which);
        World world({.solver = NoContact{}});
        for (int i = 0; i < 8; ++i) world.add(Body{.position = {10.0 * i, 0}, .velocity = {0, 1}, .radius = 1});
        world.add(SoftDiscs{});
        world.step(1e-3);
        for (const Vec2 v : world.velocities()) EXPECT_EQ(v, (Vec2{0, 1}));
    }
}

TEST_F(SoftDisc, WhoseCentresAreOneFeelNoForce) {
    World world({.solver = NoContact{}});
    for (int i = 0; i < 2; ++i) world.add(Body{.radius = 1});
    world.add(SoftDiscs{});
    world.step(1e-3);
    EXPECT_EQ(world.positions()[0], world.positions()[1]);
}

TEST_F(SoftDisc, AreRefusedWhereTheSolverCollidesDiscsToo) {
    for (const Solver& solver : {Solver{Impulse{}}, Solver{SoftStep{}}}) {
        World world({.solver = solver});
        world.add(SoftDiscs{});
        EXPECT_THROW(world.step(1e-3), Error);
    }
    World walls({.solver = Impulse{.disc_collisions = false}});
    walls.add(SoftDiscs{});
    EXPECT_NO_THROW(walls.step(1e-3));
}

TEST_F(SoftDisc, TooLongAStepIsCutOrRefused) {
    World world = head_on(0, Verlet{});
    EXPECT_LT(world.stable_step(), 0.5 * duration_of_blow(0));
    EXPECT_GT(world.stable_step(), 0.1 * duration_of_blow(0));
}
