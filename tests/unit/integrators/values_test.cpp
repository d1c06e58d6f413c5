// What holds for every method, and what the symplectic ones have in common.

#include <gtest/gtest.h>

#include "scenes.hpp"

namespace carom::test {
namespace {

class Methods : public testing::TestWithParam<Named> {};
INSTANTIATE_TEST_SUITE_P(Every, Methods, testing::ValuesIn(every_method),
                         [](const auto& test) { return test.param.name; });

TEST_P(Methods, AFreeBodyKeepsItsVelocityToTheLastBit) {
    World world({.integrator = GetParam().method});
    const Vec2 v = {1e6, -123456.789e-3};
    world.add(Body{.velocity = v, .angular_velocity = 0.1, .radius = 0.3});
    world.add(Body{.kind = Kind::driven, .position = {0, 5}, .velocity = {3, 0}});
    run(world, 10, 1.0 / 60);
    EXPECT_EQ(world.velocities()[0], v);
    EXPECT_EQ(world.angular_velocities()[0], 0.1);
    // The place is as good as 600 roundings of 1e7: 600 × 1e-9, and Gauss-Radau's much better.
    EXPECT_NEAR(world.positions()[0].x, 1e7, 6e-7);
    EXPECT_NEAR(world.positions()[1].x, 30, 1e-12);
}

TEST_P(Methods, ACopyGoesOnWithTheSameBits) {
    for (const Scene& scene : scenes) {
        World world = after(scene.make(GetParam().method), 0.7, 43);
        World copy = world;
        World other({.gravity = {1, 1}});
        other.add(Body{});
        other = world;
        for (int k = 0; k < 43; ++k) {
            world.step(0.016);
            copy.step(0.016);
            other.step(0.016);
        }
        EXPECT_EQ(state_hash(world), state_hash(copy)) << scene.name;
        EXPECT_EQ(state_hash(world), state_hash(other)) << scene.name;
        EXPECT_EQ(everything(world), everything(copy)) << scene.name;
    }
}

TEST_P(Methods, ADrivenBodyIsOnItsCurve) {
    const World world = after(driven(GetParam().method), 1.3, 31);
    // The curve (t²/2, 0.6 t − 0.2 t³, t) at t = 1.3; its velocity is a difference quotient, good to 1e-12.
    EXPECT_NEAR(world.positions()[0].x, 0.845, 1e-14);
    EXPECT_NEAR(world.angles()[0], 1.3, 1e-14);
    EXPECT_NEAR(world.velocities()[0].y, 0.6 - 0.6 * 1.69, 1e-11);
}

/// How far from its start a world ends that goes on, has its velocities turned about, and goes back.
double way_back(const Integrator& method) {
    const World start = elastic_pendulum(method);
    World world = after(start, 3, 200);
    const BodyId bob = world.ids()[1];
    world.set_velocity(bob, -world.velocity(bob), 0);
    for (int k = 0; k < 200; ++k) world.step(3.0 / 200);
    return length(world.position(bob) - start.positions()[1]) + length(world.velocity(bob) + start.velocities()[1]);
}

TEST(Symmetry, OnTheWayBackOnlyRoundingIsLeft) {
    // 400 steps of rounding, 1e-16 of places and velocities of 1 to 10, grown a hundredfold by the motion.
    EXPECT_LT(way_back(Verlet{}), 1e-11);
    EXPECT_LT(way_back(Pefrl{}), 1e-11);
    // Newton's iteration leaves 1e-12 of the velocity, a step.
    EXPECT_LT(way_back(Implicit{}), 1e-9);
    // The others do not return: the test can tell.
    EXPECT_GT(way_back(SymplecticEuler{}), 1e-3);
    EXPECT_GT(way_back(Rk4{}), 1e-7);
}

}  // namespace
}  // namespace carom::test
