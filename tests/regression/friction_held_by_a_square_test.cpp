// Friction in a plane had a bound along the slip and one across it: a puck that slid was not moved by a push from the
// side, what was at rest was held by up to 1.41 times the largest force, and a motor pushed as much harder. And the
// slip was that against a's anchor, wherever b was, with the opposite force there: a pair of them made spin.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

namespace carom {
namespace {

using std::numbers::pi;

struct Puck {
    World world{{.solver = SoftStep{}}};
    BodyId id;
    JointId joint;

    Puck(JointType type, Vec2 velocity, Vec2 push) {
        id = world.add(Body{.velocity = velocity, .mass = 1, .radius = 0.1});
        joint = world.add(Joint{.b = id, .type = type});
        world.add(ConstantForce{.body = id, .force = push});
    }
    double force() const { return length(world.reaction(joint).force); }
};

/// v' = F/m − 10 v/|v| for 0.3 s, by Runge and Kutta's method.
Vec2 slid(Vec2 v, Vec2 push) {
    const auto rate = [&](Vec2 u) { return push - (10 / length(u)) * u; };
    constexpr double h = 1e-4;
    for (int i = 0; i < 3000; ++i) {
        const Vec2 a = rate(v), b = rate(v + 0.5 * h * a), c = rate(v + 0.5 * h * b), d = rate(v + h * c);
        v += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return v;
}

TEST(Puck, GivesWayToAPushFromTheSide) {
    double error[2];
    for (const int i : {0, 1}) {
        Puck puck(FrictionJoint{10, 1}, {5, 0}, {0, 5});
        double most = 0;
        run(puck.world, 0.3, 1.0 / (i == 0 ? 60 : 240), [&](const World&) { most = std::max(most, puck.force()); });
        error[i] = length(puck.world.velocity(puck.id) - slid({5, 0}, {0, 5}));
        EXPECT_LE(most, 10 + 1e-9);
    }
    EXPECT_LE(error[0], 1e-3);
    EXPECT_LE(error[1], error[0] / 10);  // of second order
}

TEST(Puck, ComesLooseByTheSamePullWhicheverWay) {
    for (const double angle : {0.0, 0.3, 0.25 * pi, 1.3})
        for (const double pull : {9.9, 10.1, 12.0}) {
            Puck puck(FrictionJoint{10, 1}, {}, pull * Vec2{std::cos(angle), std::sin(angle)});
            run(puck.world, 1, 1.0 / 60);
            EXPECT_NEAR(length(puck.world.position(puck.id)), pull > 10 ? 0.5 * (pull - 10) : 0, 0.01) << angle;
            EXPECT_NEAR(puck.force(), std::min(pull, 10.0), 1e-6) << angle;
            if (pull < 10) {
                EXPECT_LE(length(puck.world.velocity(puck.id)), 1e-12);
            }
        }
}

TEST(Puck, StopsWhereItsFrictionSays) {
    Puck puck(FrictionJoint{10, 0}, {3, 4}, {});
    run(puck.world, 1, 1.0 / 60);
    EXPECT_NEAR(length(puck.world.position(puck.id)), 25.0 / 20, 1e-3);
    EXPECT_EQ(puck.world.velocity(puck.id), Vec2{});
    EXPECT_NEAR(energy(puck.world).heat.joint_friction, 12.5, 0.02);
}

// The friction of a bob's rim, and no part of what its rod bears, takes its speed: 2 N from 3 m/s for a second.
TEST(Bob, IsSlowedDownAlongItsWay) {
    double error[2];
    for (const int i : {0, 1}) {
        World world({.solver = SoftStep{}});
        const BodyId bob =
            world.add(Body{.position = {1, 0}, .velocity = {0, 3}, .mass = 1, .moment_of_inertia = 0.01});
        world.add(Joint{.b = bob, .type = DistanceJoint{}});
        world.add(Joint{.b = bob, .type = FrictionJoint{2, 0}});
        run(world, 1, 1.0 / (i == 0 ? 60 : 240));
        error[i] = std::abs(length(world.velocity(bob)) - 1);
    }
    EXPECT_LE(error[0], 1e-4);
    EXPECT_LE(error[1], error[0] / 12);  // of second order
}

TEST(Motor, PushesByItsLargestForceAtMost) {
    Puck drawn(MotorJoint{.velocity = {0, 1}, .maximum_force = 10}, {}, {9, 9});
    double most = 0;
    run(drawn.world, 1, 1.0 / 60, [&](const World&) { most = std::max(most, drawn.force()); });
    EXPECT_LE(most, 10 + 1e-9);
    Puck driven(MotorJoint{.velocity = {3, 4}, .maximum_force = 10}, {}, {});
    run(driven.world, 0.25, 1.0 / 60);
    EXPECT_NEAR(length(driven.world.velocity(driven.id)), 2.5, 1e-9);
    run(driven.world, 0.75, 1.0 / 60);
    EXPECT_NEAR(length(driven.world.velocity(driven.id) - Vec2{3, 4}), 0, 1e-9);
}

TEST(FrictionBetweenTwo, MakesNoSpin) {
    for (const JointType& type : {JointType(FrictionJoint{1, 0}),
                                  JointType(MotorJoint{.velocity = {2, 0}, .maximum_force = 1, .maximum_torque = 0})}) {
        World world({.solver = SoftStep{}});
        const BodyId a = world.add(Body{.mass = 2, .shapes = {{.geometry = Box{4, 1}}}});
        const BodyId b = world.add(Body{.velocity = {1, 2}, .mass = 1, .radius = 0.2});
        world.add(Joint{.a = a, .b = b, .anchor_a = {0.5, 0}, .type = type});
        const double before = angular_momentum(world);
        run(world, 1.5, 1.0 / 240);
        EXPECT_NEAR(angular_momentum(world), before, 1e-3);
        EXPECT_LE(std::abs(energy(world).residual), 1e-3);
    }
}

// On a turntable, 1 m from its axis: at rest on it, for that takes no more than friction can, but for ω² h/2 by which
// each substep goes along the tangent.
TEST(FrictionBetweenTwo, CarriesWhatLiesOnATurntable) {
    World world({.solver = SoftStep{}});
    const BodyId table = world.add(Body{.kind = Kind::driven, .angular_velocity = 1, .radius = 0.01});
    const BodyId b = world.add(Body{.position = {1, 0}, .velocity = {0, 1}, .mass = 1, .radius = 0.01});
    world.add(Joint{.a = table, .b = b, .anchor_b = {}, .type = FrictionJoint{2, 0.1}});
    run(world, 2 * pi, pi / 480);
    EXPECT_NEAR(length(world.position(b) - Vec2{1, 0}), 0, 0.01);
}

}  // namespace
}  // namespace carom
