#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "scenes.hpp"

namespace carom::test {
namespace {

using std::numbers::pi;

// The start itself is known to half a bit only: 0.4 is not a double, and the last bit of a place changes the period by
// 4e-16 of it, the place after a hundred orbits by 5e-13. The sixteen rounded forces of a step add a random walk of
// some 6e-13 (measured over 32 starts: root mean square 4e-13 to 7e-13, one in forty beyond 1.6e-12).
TEST(GaussRadau, AHundredKeplerOrbitsEndWhereTheyBegan) {
    for (const int steps : {600, 300, 100, 60, 40, 20, 7}) {
        World world = kepler_orbit(GaussRadau{});
        const double energy_at_start = energy(world).total();
        for (int k = 0; k < 100 * steps; ++k) world.step(2 * pi / steps);
        EXPECT_LT(length(world.positions()[1] - Vec2{0.4, 0}), steps == 600 ? 1e-12 : 3e-12) << steps;
        // The energy, −0.5 from 2 − 2.5, is itself rounded to 4e-16.
        EXPECT_NEAR(energy(world).total() / energy_at_start, 1, 5e-15) << steps;
    }
}

// A force that is there up to a place alone: nodes beyond it see no number, and the step is shortened, whichever way it
// goes. Seen along x only, a step along y ended in what is no number.
TEST(GaussRadau, SeesWhatIsNoNumberAlongEitherAxis) {
    const auto end = [](bool upwards) {
        World world({.integrator = GaussRadau{}});
        const BodyId id = world.add(Body{.velocity = upwards ? Vec2{0, 3} : Vec2{3, 0}});
        world.add(ForceField{.force = [upwards](Vec2 x, Vec2, double, double) {
            const double f = -5 / std::sqrt(1.02 - (upwards ? x.y : x.x));
            return upwards ? Vec2{0, f} : Vec2{f, 0};
        }});
        world.step(0.5);
        return world.position(id);
    };
    const Vec2 across = end(false), up = end(true);
    EXPECT_TRUE(std::isfinite(across.x));
    EXPECT_EQ(across.x, up.y);
}

World oscillator(double damping) {
    World world({.integrator = GaussRadau{}});
    const BodyId origin = world.add(Body{.kind = Kind::fixed});
    const BodyId bob = world.add(Body{.position = {1.5, 0}});
    world.add(Spring{.a = origin, .b = bob, .stiffness = 100, .rest_length = 1, .damping = damping});
    return world;
}

// x = 1 + cos(10 t)/2. 16 periods; the argument's rounding alone is 1e-14.
TEST(GaussRadau, AnOscillatorIsACosine) {
    const World world = after(oscillator(0), 10, 100);
    EXPECT_NEAR(world.positions()[1].x, 1 + 0.5 * portable::cos(100), 1e-13);
    EXPECT_NEAR(world.velocities()[1].x, -5 * portable::sin(100), 1e-12);
}

// x − 1 = e^(−t/2) (cos wt + sin wt/(2w))/2 with w² = 100 − 1/4: forces by velocity, and the heat.
TEST(GaussRadau, ADampedOscillatorIsADampedCosine) {
    const World world = after(oscillator(1), 3, 7);
    const double w = std::sqrt(99.75), decay = portable::exp(-1.5);
    EXPECT_NEAR(world.positions()[1].x, 1 + 0.5 * decay * (portable::cos(3 * w) + portable::sin(3 * w) / (2 * w)),
                1e-14);
    EXPECT_NEAR(energy(world).residual, 0, 1e-13);
    EXPECT_GT(energy(world).heat.damping, 10);
}

// A plate that swings and turns on a spring at its corner. Of micrometres turns are so many more to the second squared
// that their accelerations were taken for the larger ones, beside which nothing was asked of the others.
TEST(GaussRadau, IsAsExactInMicrometres) {
    const auto end = [](double m) {
        World world({.gravity = {0, -9.81 * m}, .integrator = GaussRadau{}});
        const BodyId nail = world.add(Body{.kind = Kind::fixed});
        const BodyId plate = world.add(Body{.position = {0, -m}, .radius = 0.2 * m});
        world.add(Spring{.a = nail, .b = plate, .anchor_b = {0.1 * m, 0.1 * m}, .stiffness = 100, .rest_length = m});
        run(world, 2, 0.01);
        return world;
    };
    constexpr double micro = 0x1p-20;
    const World world = end(1), small = end(micro);
    EXPECT_EQ(micro * world.positions()[1], small.positions()[1]);
    EXPECT_EQ(world.angles()[1], small.angles()[1]);
}

// A frame that cuts a step short does not shorten the steps after it: frames just longer than a step cost two steps
// each, not a climb from the stump.
TEST(GaussRadau, RemembersItsStepAcrossFrames) {
    const auto evaluations = [](int frames) {
        int count = 0;
        World world = kepler_orbit(GaussRadau{});
        world.add(ForceField{.force = [&count](Vec2, Vec2, double, double) { return ++count, Vec2{}; }});
        for (int k = 0; k < frames; ++k) world.step(20 * pi / frames);
        return count;
    };
    const int free = evaluations(1);
    // A step of its own is some 0.2 s here; 300 frames of 0.21 s.
    EXPECT_LT(evaluations(300), 2.5 * free);
}

// Ten orbits with e = 0.6: a rough tolerance gives rough places, for a fraction of the work. Errors go as the square of
// the tolerance: 7e-6 to 5e-5 of it were measured, and 200 to 40000 times as much where steps with a coefficient far
// too large were taken; to rounding, these tolerances took 0.24 to 0.28 of the finest one's evaluations.
TEST(GaussRadau, AToleranceIsPaidForNoMoreThanItAsks) {
    const auto evaluations = [](double tolerance) {
        int count = 0;
        World world = kepler_orbit(GaussRadau{.tolerance = tolerance});
        world.add(ForceField{.force = [&count](Vec2, Vec2, double, double) { return ++count, Vec2{}; }});
        world.step(20 * pi);
        EXPECT_LT(length(world.positions()[1] - Vec2{0.4, 0}), 1e-3 * tolerance * tolerance + 1e-12) << tolerance;
        return count;
    };
    const int to_rounding = evaluations(1e-9);
    EXPECT_LT(evaluations(1e-1), 0.2 * to_rounding);
    EXPECT_LT(evaluations(1e-2), 0.2 * to_rounding);
    EXPECT_LT(evaluations(1e-3), 0.22 * to_rounding);
}

TEST(GaussRadau, AStepThatCollapsesIsAnErrorWithItsTime) {
    // Free fall from 1 into a point mass of GM = 1: after π/√8 = 1.1107 s.
    World world({.integrator = GaussRadau{}});
    world.add(Body{.kind = Kind::fixed, .mass = 1});
    world.add(Body{.position = {1, 0}, .mass = 1});
    world.add(Attraction{.strength = 1});
    EXPECT_NE(complaint(world, 2).find("t = 1.1107"), std::string::npos) << complaint(world, 2);

    World nan({.integrator = GaussRadau{}});
    nan.add(Body{});
    nan.add(ForceField{.force = [](Vec2, Vec2, double, double t) {
        return Vec2{t > 1 ? std::numeric_limits<double>::quiet_NaN() : 0, 0};
    }});
    EXPECT_NE(complaint(nan, 2).find("t = 1 s"), std::string::npos) << complaint(nan, 2);
}

// The first guesses of a step as long as the frame fall where the force is no number: a shorter one stays where it is.
TEST(GaussRadau, AStepThatMeetsNoNumberIsMadeAgain) {
    World world({.integrator = GaussRadau{}});
    world.add(Body{.position = {1, 0}});
    world.add(ForceField{.force = [](Vec2 x, Vec2, double, double) {
        return std::abs(x.x) < 2 ? -x : Vec2{std::numeric_limits<double>::quiet_NaN(), 0};
    }});
    world.step(10);
    EXPECT_NEAR(world.positions()[0].x, portable::cos(10), 1e-14);
}

// A body at rest where all forces cancel but for rounding asks for no short steps.
TEST(GaussRadau, RestStaysCheap) {
    int count = 0;
    World world({.gravity = {0, -9.81}, .integrator = GaussRadau{}});
    const BodyId a = world.add(Body{.kind = Kind::fixed, .position = {0.3, 0.1}});
    const BodyId b = world.add(Body{.position = {0.3, 0.1 - 1 - 9.81 / 37}});
    world.add(Spring{.a = a, .b = b, .stiffness = 37, .rest_length = 1});
    world.add(ForceField{.force = [&count](Vec2, Vec2, double, double) { return ++count, Vec2{}; }});
    run(world, 10, 0.1);
    EXPECT_LT(count, 100 * 60);
    EXPECT_NEAR(world.positions()[1].y, 0.1 - 1 - 9.81 / 37, 1e-13);
}

}  // namespace
}  // namespace carom::test
