// A plank that falls over the corner on which it stands stopped dead as its other end struck: the corner that stood was
// taken for the whole contact, which rests and does not bounce (28 of 35 starting angles at e = 0.9, all at 0.1).

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace {

using namespace carom;

struct Fall {
    double before = 0, after = 0;  ///< angular velocity around the blow [rad/s]
    double approach = 0;           ///< of the hardest impact that was told [m/s]
};

/// A plank of 4 m and 0.2 m, leant by so much, until its other end has struck.
Fall fall_of_plank(double angle, double restitution) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {1, 0.8}});
    const BodyId plank = world.add(Body{.position = {0, 2 * std::cos(angle) + 0.1 * std::sin(angle)},
                                        .angle = -angle,
                                        .mass = 100,
                                        .shapes = {{.geometry = Box{0.2, 4}}},
                                        .restitution = restitution,
                                        .friction = 0.8});
    Fall fall;
    for (int i = 0; i < 400; ++i) {
        const double before = world.angular_velocity(plank);
        world.step(1.0 / 60);
        for (const Impact& impact : world.events().impacts) fall.approach = std::max(fall.approach, impact.approach);
        if (world.angular_velocity(plank) > before + 0.5) return {before, world.angular_velocity(plank), fall.approach};
    }
    return fall;
}

// The end comes down at ω times the plank's length, and goes back with e of that. The other end is free to lift, by
// which the spin becomes less than e ω; at least a half of that is left. Up to a step before the blow, as it is read
// here, the spin is less by some 2 %.
TEST(FallingPlank, BouncesOffItsOtherEndAndTellsOfIt) {
    for (const double e : {0.1, 0.3, 0.5, 0.9, 0.99})
        for (double angle = 0.05; angle < 0.4; angle += 0.01) {
            const Fall fall = fall_of_plank(angle, e);
            ASSERT_LT(fall.before, -2) << e << ' ' << angle;
            EXPECT_GT(fall.after, -0.5 * e * fall.before) << e << ' ' << angle;
            EXPECT_NEAR(fall.approach, -4 * fall.before, 0.05 * fall.approach) << e << ' ' << angle;
        }
}

}  // namespace
