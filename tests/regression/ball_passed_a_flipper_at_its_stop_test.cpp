// A flipper was pressed against a stop, and a ball came at its end from the side on which the stop is beyond it: the
// plane of the flipper's own side was taken for one that keeps the ball off. There was no contact for a whole step, and
// the ball went through.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

constexpr Vec2 pivot{-0.085, 0.14};
constexpr double ball = 0.0135, thickness = 0.008;  // radii [m]

/// How near the ball's centre comes to the middle line of a flipper that is held up against the end of a lane.
double nearest_of_a_ball(double along, double angle, double speed) {
    World world({.solver = SoftStep{}, .restitution_mixing = Mixing::maximum});
    world.add(Body{.kind = Kind::fixed,
                   .shapes = {{.geometry = Capsule{{-0.25, 0.25}, {-0.09, 0.15}, 0.004}}},
                   .restitution = 0.3});
    const BodyId flipper = world.add(Body{.position = pivot,
                                          .angle = -0.5,
                                          .mass = 0.2,
                                          .shapes = {{.geometry = Capsule{{0, 0}, {0.065, 0}, thickness}}},
                                          .restitution = 0.2});
    world.add(Joint{.b = flipper,
                    .at = pivot,
                    .type = RevoluteJoint{.motor = JointMotor{.speed = 30, .maximum = 20}, .limits = {0, 1.0}}});
    run(world, 0.5, 1.0 / 60);
    const Vec2 up{-std::sin(0.5), std::cos(0.5)}, out{std::cos(0.5), std::sin(0.5)};
    const Vec2 from = std::cos(angle) * up + std::sin(angle) * out;
    const BodyId id = world.add(Body{.position = pivot + along * out + (ball + thickness) * up + 0.15 * from,
                                     .velocity = -speed * from,
                                     .mass = 0.08,
                                     .radius = ball,
                                     .restitution = 0.5});
    double nearest = 1;
    run(world, 0.2, 1.0 / 60, [&](const World& now) {
        const Vec2 p = to_body(now.pose(flipper), now.position(id)) - to_body(now.pose(flipper), pivot);
        const double beyond = p.x - std::clamp(p.x, 0.0, 0.065);
        nearest = std::min(nearest, std::hypot(beyond, p.y));
    });
    return nearest;
}

TEST(BallAtAFlipperAtItsStop, DoesNotPassThrough) {
    // By a third: the motor bears the blow only after it, and lets the ball sink in until then; it passed by 0.
    const double least = 2.0 / 3 * (ball + thickness);
    for (const double along : {0.02, 0.03, 0.04, 0.05})
        for (const double angle : {-0.2, 0.2, 0.4, 0.6, 0.8})
            for (const double speed : {2.0, 5.0, 10.0})
                EXPECT_GT(nearest_of_a_ball(along, angle, speed), least) << along << ' ' << angle << ' ' << speed;
}

}  // namespace
}  // namespace carom
