// The velocity of a body on a curve, and the work of a potential that changes, were differences over 1/1024 s however
// fast the curve was: at 200 Hz 6 % too small, at 1000 Hz nearly nothing, and nothing at all at 1024 Hz.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

#include "math/slope.hpp"

namespace carom {
namespace {

using std::numbers::pi;

TEST(Regression, FastCurveHadAWrongVelocity) {
    for (const double hertz : {1., 10., 30., 200., 300., 500., 1000., 1024., 2048., 10240., 123456., 1e7}) {
        const double w = 2 * pi * hertz;
        World world({.solver = NoContact{}});
        const BodyId plate = world.add(Body{.kind = Kind::driven});
        world.drive(plate, [w](double t) { return Pose{{3, 0.01 * std::sin(w * t + 0.3)}, std::cos(w * t)}; });
        for (int i = 0; i < 100; ++i) {
            world.step(0.0371 / hertz);
            const double t = world.time();
            EXPECT_NEAR(world.velocity(plate).y, 0.01 * w * std::cos(w * t + 0.3), 1e-8 * 0.01 * w) << hertz;
            EXPECT_NEAR(world.angular_velocity(plate), -w * std::sin(w * t), 1e-8 * w) << hertz;
            EXPECT_EQ(world.velocity(plate).x, 0);
        }
    }
}

TEST(Regression, FastPotentialDidAWrongWork) {
    const double w = 2 * pi * 500;
    World world({.integrator = Rk4{}, .solver = NoContact{}});
    world.add(Body{});
    world.add(ForceField{.force = [](Vec2, Vec2, double, double) { return Vec2{}; },
                         .potential = [w](Vec2, double, double t) { return std::sin(w * t); }});
    for (int i = 0; i < 33; ++i) world.step(1e-5);
    // Simpson's rule: (w h)⁴/2880 = 3e-10; the slope: 1e-8 of w, for 1/w.
    EXPECT_NEAR(energy(world).work.user, std::sin(w * 33e-5), 2e-8);
}

TEST(Slope, OfWhatIsNotSmoothIsTheOneOverAMillisecond) {
    const auto jump = [](double t) { return t < 0.5 ? 0. : 1.; };
    EXPECT_DOUBLE_EQ(slope(jump, 0.5), 7 * 1024 / 12.);
    EXPECT_EQ(slope(jump, 0.6), 0);
    const auto kink = [](double t) { return std::abs(t - 0.5); };
    EXPECT_NEAR(slope(kink, 0.5), 0, 1e-12);
    EXPECT_NEAR(slope(kink, 0.5 + 1e-4), 1, 1e-9);
    EXPECT_EQ(slope([](double) { return 1e9; }, 0.5), 0);
    EXPECT_TRUE(std::isnan(slope([](double) { return NAN; }, 0.5)));
}

}  // namespace
}  // namespace carom
