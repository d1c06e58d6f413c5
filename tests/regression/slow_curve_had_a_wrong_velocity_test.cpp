// The velocity of a body on a curve was a difference over 1/1024 s however slow the curve was: of one that swings with
// 1e-9 rad/s 1e-4 of it was rounding, all of it where it went through 0, and what lay on a slow lift was thrown about.

#include <cmath>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(SlowCurve, HasTheVelocityOfAFastOne) {
    for (const double w : {1e-9, 1e-6, 1e-4, 1e-2}) {
        World world({.solver = NoContact{}});
        const BodyId plate = world.add(Body{.kind = Kind::driven});
        world.drive(plate, [w](double t) { return Pose{{3, 3 + std::sin(w * t)}, std::sin(w * t)}; });
        for (int i = 0; i < 200; ++i) {
            world.step(0.0371 / w);
            const double speed = w * std::cos(w * world.time());
            EXPECT_NEAR(world.velocity(plate).y, speed, 1e-8 * w) << w;
            EXPECT_NEAR(world.angular_velocity(plate), speed, 1e-8 * w) << w;
            EXPECT_EQ(world.velocity(plate).x, 0);
        }
    }
}

/// How far off at most the force is that bears a box on a lift, of its weight, in units of time 1/w.
double error_of_force(double w) {
    World world({.gravity = {0, -w * w}, .solver = SoftStep{}});
    const BodyId lift = world.add(Body{.kind = Kind::driven, .shapes = {{.geometry = Box{10, 1, {0, -0.5}}}}});
    world.drive(lift, [w](double t) { return Pose{{0, 0.1 * std::sin(w * t)}, 0}; });
    world.add(box({0, 0.5}, 1, 1, 0.3));
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        world.step(0.02 / w);
        double force = 0;
        for (const auto& c : world.contacts()) force += c.normal_force;
        const double middle = w * world.time() - 0.0025;  // of the last of four substeps
        if (i > 3) worst = std::max(worst, std::abs(force / (w * w) - (1 - 0.1 * std::sin(middle))));
    }
    return worst;
}

TEST(SlowCurve, BearsWhatAFastOneDoes) {
    // A substep's difference for the curve's acceleration: 0.1 (w h)²/24 = 1e-7, and velocities that are good to 1e-9.
    for (const double w : {1e-7, 1e-5, 1e-4, 1e-3, 1.0}) EXPECT_LE(error_of_force(w), 2e-7) << w;
}

}  // namespace
}  // namespace carom::test
