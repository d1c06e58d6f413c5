// A ball that struck what lies at the limit of its joint lost most of its speed: the limit gave way in the blow and
// took the energy for itself. An elastic ball kept 0.42 of its speed on a lever of 2.5 times its mass, one with e = ½
// 0.07. So it was in an exact gas, too.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

/// A ball that flies down at something which its joint keeps from going down, or up at it from below.
struct Hit {
    World world;
    BodyId struck, ball;

    Hit(const JointType& joint, double restitution, double down, const Solver& solver = SoftStep{})
        : world({.gravity = {0, 0}, .solver = solver}) {
        struck = world.add(Body{.position = {0.4, 0},
                                .mass = 0.2,
                                .shapes = {{.geometry = Capsule{{-0.4, 0}, {0.4, 0}, 0.08}}},
                                .restitution = restitution,
                                .friction = 0});
        const bool is_rope = std::holds_alternative<DistanceJoint>(joint);
        Joint made{.b = struck, .type = joint};
        if (is_rope)
            made.anchor_a = {0.4, 2}, made.anchor_b = {0, 0};
        else
            made.at = Vec2{0, 0};
        world.add(made);
        // Over the middle of what can turn freely, beside it where it can not.
        const double x = is_rope ? 0.4 : 0.5;
        ball = world.add(Body{.position = {x, down > 0 ? 0.6 : -0.6},
                              .velocity = {0, -down},
                              .mass = 0.08,
                              .radius = 0.135,
                              .restitution = restitution,
                              .friction = 0});
    }
    /// How fast the ball flies on after it struck [m/s].
    double bounce() {
        for (int i = 0; i < 60 && world.collisions() == 0; ++i) world.step(1.0 / 60);
        return world.velocity(ball).y;
    }
};

const std::pair<const char*, JointType> joints[] = {{"hinge", RevoluteJoint{.limits = {0, 1}}},
                                                    {"slide", PrismaticJoint{.axis = {0, 1}, .limits = {0, 1}}},
                                                    {"rope", DistanceJoint{.limits = {0, 2}}}};

void expect_that_it_bounces_as_from_a_wall(const Solver& solver) {
    for (const auto& [name, joint] : joints)
        for (const double restitution : {0.0, 0.5, 1.0}) {
            const double speed = 5, energy_of_ball = 0.5 * 0.08 * speed * speed;
            Hit hit(joint, restitution, speed, solver);
            // Rows of joints give way by their slack, 1e-11 or so of what they are made to bear.
            EXPECT_NEAR(hit.bounce(), restitution * speed, 1e-9 * speed) << name << ' ' << restitution;
            EXPECT_NEAR(hit.world.velocity(hit.struck).y, 0, 1e-9 * speed) << name << ' ' << restitution;
            const Energy end = energy(hit.world);
            EXPECT_NEAR(end.total(), restitution * restitution * energy_of_ball, 1e-9) << name << ' ' << restitution;
            EXPECT_NEAR(end.unaccounted(), 0, 1e-14) << name << ' ' << restitution;
        }
}

TEST(BallOnALeverAtItsStop, BouncesAsFromAWall) { expect_that_it_bounces_as_from_a_wall(SoftStep{}); }

TEST(BallOnALeverAtItsStop, BouncesAsFromAWallInAnExactGas) { expect_that_it_bounces_as_from_a_wall(Events{}); }

TEST(BallOnALeverAtItsStop, LiftsItAsIfThereWereNoStop) {
    const JointType with = RevoluteJoint{.limits = {0, 1}}, without = RevoluteJoint{};
    for (const double restitution : {0.0, 0.5, 1.0}) {
        Hit at_stop(with, restitution, -5), free(without, restitution, -5);
        EXPECT_NEAR(at_stop.bounce(), free.bounce(), 1e-12) << restitution;
        EXPECT_GT(at_stop.world.angular_velocity(at_stop.struck), 1);
        EXPECT_NEAR(at_stop.world.angular_velocity(at_stop.struck), free.world.angular_velocity(free.struck), 1e-12);
    }
}

TEST(BallOnALeverAtItsStop, BouncesThereForAMinute) {
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    const BodyId lever = world.add(
        Body{.position = {0.4, 0}, .mass = 0.2, .shapes = {{.geometry = Capsule{{-0.4, 0}, {0.4, 0}, 0.08}}}});
    world.add(Joint{.b = lever, .at = Vec2{0, 0}, .type = RevoluteJoint{.limits = {0, 1}}});
    const BodyId ball = world.add(Body{.position = {0.5, 1.215}, .mass = 0.08, .radius = 0.135, .restitution = 1});
    double highest = 0;
    run(world, 60, 1.0 / 60, [&](const World& now) {
        if (now.time() > 58) highest = std::max(highest, now.position(ball).y);
    });
    EXPECT_GT(world.collisions(), 60u);
    EXPECT_NEAR(highest, 1.215, 0.01) << "as seen sixty times a second";
}

}  // namespace
}  // namespace carom
