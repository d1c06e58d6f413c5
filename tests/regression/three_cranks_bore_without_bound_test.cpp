// Three cranks of one length on a coupler have as many rigid rows as ways to move, and one says what the others say.
// That was looked for by counting: pins reported 4.6e12 N, and the motor worked 69 kJ. And of a beam on three rods the
// one in the middle bore four times as much as the others, for it yields a quarter as much.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

#include "restored.hpp"

namespace carom {
namespace {

using std::numbers::pi;

/// As many cranks, upright, that turn with 3 rad/s; the first one is driven.
World cranks(int count) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    const auto bar = [&](Vec2 at, double angle, double length, double mass) {
        return Body{.position = at,
                    .angle = angle,
                    .mass = mass,
                    .shapes = {{.geometry = Box{length, 0.04}, .filter = {.mask = 0}}}};
    };
    const BodyId coupler = world.add(bar({0.5, 0.3}, 0, 1, 2));
    world.set_velocity(coupler, {-0.9, 0}, 0);
    for (int i = 0; i < count; ++i) {
        const double x = i / (count - 1.0);
        const BodyId crank = world.add(bar({x, 0.15}, pi / 2, 0.3, 1));
        world.set_velocity(crank, {-0.45, 0}, 3);
        const auto motor = i == 0 ? std::optional(JointMotor{.speed = 3}) : std::nullopt;
        world.add(Joint{.b = crank, .at = Vec2{x, 0}, .type = RevoluteJoint{.motor = motor}});
        world.add(Joint{.a = crank, .b = coupler, .at = Vec2{x, 0.3}, .type = RevoluteJoint{}});
    }
    return world;
}
double largest_force(const World& world) {
    double most = 0;
    for (const JointId id : world.joint_ids()) most = std::max(most, length(world.reaction(id).force));
    return most;
}

TEST(ThreeCranks, BearWhatFourDo) {
    for (const int count : {3, 4}) {
        World world = cranks(count);
        double most = 0;
        run(world, 0.45, 1.0 / 60, [&](const World& w) { most = std::max(most, largest_force(w)); });
        EXPECT_LE(most, 200) << count;  // 80° of the 90° to where all are in line
        run(world, 9.55, 1.0 / 60);
        EXPECT_LE(std::abs(energy(world).residual), 0.01) << count;
    }
}

TEST(ThreeCranks, GoOnFromACheckpointWithTheSameBits) {
    World world = cranks(3), other = cranks(3);
    run(world, 0.2, 1.0 / 60);
    test::restore_from(world, other);
    run(world, 0.5, 1.0 / 60), run(other, 0.5, 1.0 / 60);
    EXPECT_EQ(test::saved(world), test::saved(other));
}

TEST(ThreeRods, BearABeamAlike) {
    for (const int how : {0, 1, 2}) {  // by statics, by the solve of every substep, and swinging
        World world({.gravity = {0, -9.81}, .solver = SoftStep{.statics = how == 0}});
        const BodyId beam = world.add(Body{.mass = 30, .shapes = {{.geometry = Box{4, 0.1}}}});
        if (how == 2) world.set_velocity(beam, {0.03, 0}, 0);
        for (const double x : {-2.0, 0.0, 2.0})
            world.add(Joint{.b = beam, .anchor_a = {x, 2}, .anchor_b = {x, 0}, .type = DistanceJoint{}});
        run(world, 1, 1.0 / 60);
        for (const JointId id : world.joint_ids()) EXPECT_NEAR(world.reaction(id).force.y, 98.1, 0.1) << how;
    }
}

}  // namespace
}  // namespace carom
