#include <gtest/gtest.h>

#include "scenes.hpp"

namespace carom::test {
namespace {

// A rope of a thousand springs of 1e9 N/m, ωh = 10⁷, swings down. All its energy stays: the residual is what Newton's
// iteration leaves, 1e-12 of velocities of 10 m/s in a rope of 1 kg each step, here 60 times.
TEST(Implicit, AThousandStiffSpringsKeepTheirEnergy) {
    World world({.gravity = {0, -9.81}, .integrator = Implicit{}});
    constexpr int links = 1000;
    BodyId last = world.add(Body{.kind = Kind::fixed});
    for (int i = 1; i <= links; ++i) {
        const BodyId next = world.add(Body{.position = {10.0 / links * i, 0}, .mass = 1.0 / links});
        world.add(Spring{.a = last, .b = next, .stiffness = 1e9, .rest_length = 10.0 / links});
        last = next;
    }
    for (int k = 0; k < 60; ++k) world.step(1.0 / 60);
    EXPECT_NEAR(energy(world).residual, 0, 1e-9);
    for (std::size_t i = 1; i < world.size(); ++i)
        EXPECT_NEAR(length(world.positions()[i] - world.positions()[i - 1]) * links / 10, 1, 1e-5);
    // A rope, let go at one end from the level, hangs lower there than free fall after 1 s: 4.905 m.
    EXPECT_NEAR(world.positions()[links].y, -4.905, 0.01);
}

/// Two discs that fly and turn, on springs at points of their rims.
World pair(double stiffness, double damping, DampingLaw law) {
    World world({.integrator = Implicit{}, .solver = Impulse{.disc_collisions = false}});
    const BodyId a = world.add(Body{.position = {0, 0}, .velocity = {1, 0.3}, .angular_velocity = 3, .radius = 0.5});
    const BodyId b =
        world.add(Body{.position = {2, 0.5}, .velocity = {-0.5, 1}, .angular_velocity = -1, .mass = 2, .radius = 0.4});
    for (const double side : {-0.3, 0.3})
        world.add(Spring{.a = a,
                         .b = b,
                         .anchor_a = {0.2, side},
                         .anchor_b = {-0.1, side},
                         .stiffness = stiffness,
                         .rest_length = 1.2,
                         .damping = damping,
                         .damping_law = law});
    world.add(TorsionSpring{.a = a, .b = b, .stiffness = stiffness / 10, .rest_angle = 0.1, .damping = damping / 10});
    return world;
}

// Turning bodies, either damping law: energy and heat add up to what Newton's iteration leaves at any step. 1e-10 is
// 1e-12 of the velocities times the number of steps.
TEST(Implicit, TurningBodiesKeepTheirEnergy) {
    for (const double stiffness : {10.0, 1e4, 1e7})
        for (const double damping : {0.0, 1.0})
            for (const DampingLaw law : {DampingLaw::along, DampingLaw::isotropic}) {
                World world = pair(stiffness, damping, law);
                const Vec2 p = momentum(world);
                const double start = energy(world).total();
                run(world, 2, 1.0 / 60);
                EXPECT_NEAR(energy(world).residual / start, 0, 1e-10) << stiffness << " " << damping;
                EXPECT_LT(length(momentum(world) - p), 1e-12 * std::sqrt(stiffness)) << stiffness << " " << damping;
                EXPECT_EQ(energy(world).heat.damping > 0, damping > 0);
            }
}

// The period of the midpoint rule: tan(ω'h/2) = ωh/2.
TEST(Implicit, AnOscillatorHasTheMidpointRulesPeriod) {
    World world({.integrator = Implicit{}});
    const BodyId origin = world.add(Body{.kind = Kind::fixed});
    const BodyId bob = world.add(Body{.position = {1.5, 0}});
    world.add(Spring{.a = origin, .b = bob, .stiffness = 100, .rest_length = 1});
    const double h = 0.1, slower = 2 * portable::atan(10 * h / 2) / h;
    for (int k = 1; k <= 100; ++k) {
        world.step(h);
        EXPECT_NEAR(world.positions()[1].x, 1 + 0.5 * portable::cos(slower * k * h), 1e-10);
    }
}

// No springs, a force that the iteration must find by itself, and one that no step of 1/60 s allows.
TEST(Implicit, OtherForces) {
    World gentle({.integrator = Implicit{}});
    gentle.add(Body{.velocity = {1, 0}});
    gentle.add(Drag{.linear = 3});
    run(gentle, 1, 1.0 / 60);
    // v' = v (1 − bh/2)/(1 + bh/2)
    EXPECT_NEAR(gentle.velocities()[0].x, portable::pow((1 - 0.025) / (1 + 0.025), 60), 1e-12);

    World stiff({.integrator = Implicit{}});
    stiff.add(Body{.velocity = {1, 0}});
    stiff.add(Drag{.linear = 1000});  // bh/2 = 8: the fixed-point iteration needs a tenth of the step
    run(stiff, 0.1, 1.0 / 60);
    EXPECT_LT(std::abs(stiff.velocities()[0].x), 1e-10);
    EXPECT_NEAR(energy(stiff).residual, 0, 1e-10);

    World hopeless({.integrator = Implicit{}});
    hopeless.add(Body{.velocity = {1, 0}});
    hopeless.add(Drag{.linear = 1e7});
    try {
        hopeless.step(1.0 / 60);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Error::Cause::run);
        EXPECT_NE(std::string(error.what()).find("t = 0 s"), std::string::npos) << error.what();
    }
}

/// A disc that spins beside a pendulum of a micrometre changed where that ended by 3e-5 of its length: what is small in
/// rad/s was large in m/s.
TEST(Implicit, IsTheSameInEveryUnit) {
    const auto swing = [](double metre, double spin) {
        World world({.gravity = {0, -9.81 * metre}, .integrator = Implicit{}, .solver = NoContact{}});
        const BodyId pivot = world.add(Body{.kind = Kind::fixed}), bob = world.add(Body{.position = {metre, 0}});
        world.add(Spring{.a = pivot, .b = bob, .stiffness = 100, .rest_length = 0.9 * metre});
        world.add(Drag{.body = bob, .linear = 0.5});
        world.add(Body{.position = {50 * metre, 0}, .angular_velocity = spin, .radius = metre});
        run(world, 2, 1.0 / 60);
        return (1 / metre) * world.position(bob);
    };
    // Lengths are multiplied by a power of two, which changes no bit of anything.
    EXPECT_EQ(swing(0x1p-20, 0), swing(1, 0));
    EXPECT_EQ(swing(0x1p-20, 1e4), swing(1, 1e4));
}

}  // namespace
}  // namespace carom::test
