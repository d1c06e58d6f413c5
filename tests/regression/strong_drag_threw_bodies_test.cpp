// The step was bounded for springs but not for drag. Where it takes more from a body in a step than its whole velocity,
// a light one at 20 m/s under a quadratic drag, an explicit method throws it back faster, and every step squares that:
// 1e17 m/s, and infinity a step later.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

class StrongDrag : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, StrongDrag,
                         testing::Values(Euler{}, SymplecticEuler{}, Verlet{}, Pefrl{}, Rk4{}, RungeKutta{}));

TEST_P(StrongDrag, OnlySlowsDown) {
    for (const Solver& solver : {Solver{NoContact{}}, Solver{Impulse{}}, Solver{SoftStep{}}}) {
        World world({.integrator = GetParam(), .solver = solver});
        const BodyId body = world.add(Body{.velocity = {20, 0}, .mass = 0.03, .radius = 0.1});
        world.add(Drag{.quadratic = 7});
        for (int i = 0; i < 120; ++i) {
            const double before = world.velocity(body).x;
            world.step(1.0 / 60);
            ASSERT_LT(world.velocity(body).x, before);
            ASSERT_GT(world.velocity(body).x, 0);
        }
        EXPECT_NEAR(world.velocity(body).x, 0.03 / (7 * 2.0), 1e-4);  // m/(q t) once the start is forgotten, in 2e-4 s
    }
}

TEST_P(StrongDrag, LetsAGrainFallAtTheSpeedThatItsWeightGivesIt) {
    World world({.gravity = {0, -10}, .integrator = GetParam(), .solver = SoftStep{}});
    const BodyId grain = world.add(Body{.mass = 1e-4, .radius = 0.01});
    world.add(Drag{.quadratic = 7});
    run(world, 2, 1.0 / 60);
    EXPECT_NEAR(world.velocity(grain).y, -std::sqrt(1e-3 / 7), 1e-9);  // where all of these methods stand still
}

/// Euler's method, whose bodies drift before they feel what struck them, is not among these.
class StruckUnderStrongDrag : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, StruckUnderStrongDrag,
                         testing::Values(SymplecticEuler{}, Verlet{}, Pefrl{}, Rk4{}, RungeKutta{}));

TEST_P(StruckUnderStrongDrag, ALightBodyIsNotThrown) {
    World world({.integrator = GetParam(), .solver = SoftStep{}});
    const BodyId light = world.add(Body{.position = {0.3, 0}, .mass = 0.03, .radius = 0.1, .restitution = 1});
    world.add(Body{.velocity = {20, 0}, .mass = 3, .radius = 0.1, .restitution = 1});
    world.add(Drag{.quadratic = 7});
    for (int i = 0; i < 60; ++i) {
        world.step(1.0 / 60);
        ASSERT_LE(length(world.velocity(light)), 40);  // twice as fast as who struck it
    }
}

TEST(StrongDragAlone, IsRefusedWhereItIsTooStrongForAStep) {
    World world({.long_step = LongStep::refuse});
    world.add(Body{.mass = 0.5, .radius = 0.1});
    world.add(Drag{.linear = 500});
    EXPECT_NEAR(world.stable_step(), 1.62e-3, 1e-12);  // γ h/2 = 0.81 with γ = 1000 /s
    EXPECT_THROW(world.step(0.002), Error);
    world.step(0.0016);
}

}  // namespace
}  // namespace carom
