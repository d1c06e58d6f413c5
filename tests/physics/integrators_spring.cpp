// An undamped spring, k = 100 N/m, m = 1 kg, let go 0.5 m from rest, for 60 s in steps of 1/60 s: 95 periods at
// ωh = 1/6. The amplitude is the largest |x| of the last period.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom::test {
namespace {

/// Place between two frames from places, velocities and accelerations at both (Hermite, degree 5). With a cosine it is
/// wrong by (ωh)⁶/46080 = 5e-10; looking at a thousand places a step costs another (ωh/2000)²/2 = 3.5e-9.
double between(double s, double dt, const double (&a)[3], const double (&b)[3]) {
    const double c0 = a[0], c1 = dt * a[1], c2 = dt * dt * a[2] / 2;
    const double x = b[0] - c0 - c1 - c2, v = dt * b[1] - c1 - 2 * c2, acc = dt * dt * b[2] - 2 * c2;
    const double c3 = 10 * x - 4 * v + acc / 2, c4 = -15 * x + 7 * v - acc, c5 = 6 * x - 3 * v + acc / 2;
    return c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))));
}

double amplitude_kept(const Integrator& method) {
    World world({.integrator = method});
    const BodyId origin = world.add(Body{.kind = Kind::fixed});
    const BodyId bob = world.add(Body{.position = {0.5, 0}});
    world.add(Spring{.a = origin, .b = bob, .stiffness = 100});
    constexpr double dt = 1.0 / 60, period = 0.62831853071795865;
    double largest = 0;
    for (int k = 0; k < 3600; ++k) {
        const double x = world.position(bob).x, before[3] = {x, world.velocity(bob).x, -100 * x};
        world.step(dt);
        if (world.time() < 60 - period) continue;
        const double y = world.position(bob).x, after[3] = {y, world.velocity(bob).x, -100 * y};
        for (int i = 0; i <= 1000; ++i) largest = std::max(largest, std::abs(between(i / 1000.0, dt, before, after)));
    }
    return largest / 0.5;
}

// Verlet's orbit is an ellipse x² + v²/ω²/(1 − (ωh/2)²) = 0.25: its amplitude is exact, and the interpolation, which
// takes v for the derivative of x, is wrong by up to (ωh)²/8/6 = 6e-4.
TEST(UndampedSpring, VerletKeepsTheAmplitude) { EXPECT_NEAR(amplitude_kept(Verlet{}), 1, 1e-3); }

// The step from frame to frame is 1e-8 off an ellipse of the right shape.
TEST(UndampedSpring, PefrlKeepsTheAmplitudeToAMillionth) { EXPECT_NEAR(amplitude_kept(Pefrl{}), 1, 1e-7); }

TEST(UndampedSpring, TheOthers) {
    // Rk4 shrinks by (ωh)⁶/144 a step: 3600 × 1.49e-7 = 5.4e-4.
    EXPECT_NEAR(amplitude_kept(Rk4{}), 1 - 5.35e-4, 1e-5);
    // Methods with a tolerance of 1e-9: 600 rad of motion, an error of a tolerance or ten each radian.
    EXPECT_NEAR(amplitude_kept(Adaptive{}), 1, 1e-7);
    EXPECT_NEAR(amplitude_kept(GaussRadau{}), 1, 5e-9);
    EXPECT_NEAR(amplitude_kept(Implicit{}), 1, 1e-3);
    // Explicit Euler grows by √(1 + (ωh)²) a step, which is why nobody uses it.
    EXPECT_NEAR(std::log(amplitude_kept(Euler{})) / 1800 / std::log(1 + 1.0 / 36), 1, 0.01);
}

}  // namespace
}  // namespace carom::test
