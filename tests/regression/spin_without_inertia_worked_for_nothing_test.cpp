// A chain has no inertia that anything could turn, and keeps its spin. What that does through contacts was on no
// account.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "throughput.hpp"

namespace carom {
namespace {

TEST(SpinWithoutInertia, WorksForItsDriver) {
    for (const double restitution : {0.0, 1.0}) {
        World world({.solver = SoftStep{}});
        world.add(HalfPlane{.side = {.friction = 0.5}});
        world.add(Body{.position = {0, 1},
                       .angular_velocity = 5,
                       .mass = 2,
                       .shapes = {{.geometry = Chain{{{-1, 0}, {0, 0.2}, {1, 0}}}}},
                       .restitution = restitution,
                       .friction = 0.5});
        test::Throughput through(world);
        for (int i = 0; i < 120; ++i) {
            world.step(1.0 / 60);
            through.add(world);
            test::expect_closed(world, through);
        }
        EXPECT_NE(energy(world).work.driven, 0);  // it did touch
    }
}

/// The torque of 1 N at a lever of 1 m that turns with 2 rad/s is cos 2t, and whoever keeps the spin gives −sin 2 J in
/// a second. Nyström's methods, which look at no velocities, gave nothing.
TEST(SpinWithoutInertia, WorksUnderEveryMethodThatHasItsOrder) {
    for (const Integrator& method : {Integrator(RungeKutta{}), Integrator(Adaptive{}), Integrator(Nystrom{})}) {
        World world({.integrator = method, .solver = NoContact{}});
        const BodyId point = world.add(Body{.angular_velocity = 2});
        world.add(ConstantForce{.body = point, .force = {0, 1}, .point = {1, 0}});
        run(world, 1, 0.01);
        EXPECT_NEAR(energy(world).work.driven, -std::sin(2.0), 1e-10);
        EXPECT_NEAR(energy(world).residual, 0, 1e-10);
    }
}

TEST(SpinWithoutInertia, WorksOnAJointToo) {
    World world({.solver = SoftStep{}});
    const BodyId chain =
        world.add(Body{.angular_velocity = 5, .mass = 2, .shapes = {{.geometry = Chain{{{-1, 0}, {0, 0.2}, {1, 0}}}}}});
    world.add(Joint{.b = chain, .at = Vec2{0.5, 0}, .type = RevoluteJoint{}});
    test::Throughput through(world);
    for (int i = 0; i < 30; ++i) {
        world.step(1.0 / 60);
        through.add(world);
        test::expect_closed(world, through);
    }
}

/// A motor cannot turn it, however strong: it had pushed by 1e302 N m s, in whose rounding a fall was lost.
TEST(SpinWithoutInertia, GivesAMotorNothingToDo) {
    World world({.solver = SoftStep{}});
    const BodyId chain =
        world.add(Body{.angular_velocity = 5, .mass = 2, .shapes = {{.geometry = Chain{{{-1, 0}, {0, 0.2}, {1, 0}}}}}});
    world.add(Joint{.b = chain, .at = Vec2{0.5, 0}, .type = WheelJoint{.motor = JointMotor{.speed = -6}}});
    test::Throughput through(world);
    for (int i = 0; i < 30; ++i) {
        world.step(1.0 / 60);
        through.add(world);
        test::expect_closed(world, through);
    }
    EXPECT_LE(std::abs(energy(world).work.motor), 1e-200);
}

}  // namespace
}  // namespace carom
