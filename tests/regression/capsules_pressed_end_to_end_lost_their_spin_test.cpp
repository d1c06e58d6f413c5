// Smooth capsules that were pressed end to end and went round one another lost 3 % of their angular momentum in three
// seconds at 60/s, and 0.8 % at 240/s. A corner, or a round end, that lies on a side is pressed along the normal of
// that side, which turns with its body alone; at the end of a substep it was taken to have turned by what both bodies
// turn alike, as where sides lie on one another, and the end to be over the point of the side over which it had been in
// the middle. So whatever slid along a side that turned was of first order.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

// A spring presses them on one another until they fold up. The impulses are along one line, so that nothing turns them;
// what does is of third order, but for the substeps in which ends and sides meet: 1.0e-3 at 60/s and 2e-6 at 240/s.
TEST(CapsulesPressedEndToEnd, KeepTheirSpin) {
    for (const double off : {0.0, 0.02})
        for (const double dt : {1.0 / 60, 1.0 / 240}) {
            World world({.solver = SoftStep{}});
            BodyId ids[2];
            for (const int side : {-1, 1}) {
                const Vec2 at{0.7 * side, off * side};
                ids[(side + 1) / 2] = world.add(Body{.position = at,
                                                     .velocity = cross(2, at),
                                                     .angular_velocity = 2,
                                                     .shapes = {{.geometry = Capsule{{-0.5, 0}, {0.5, 0}, 0.2}}},
                                                     .restitution = 0});
            }
            world.add(Spring{.a = ids[0], .b = ids[1], .stiffness = 20});
            const double turning = momentum_balance(world).total.angular;
            run(world, 3, dt);
            const double most = dt > 0.01 ? 2e-3 : 1e-5;
            EXPECT_NEAR(momentum_balance(world).total.angular, turning, most * turning) << off << ' ' << dt;
        }
}

// A plank that slides off the sharp edge of a post, without friction, keeps its energy while it does: what it gains or
// loses falls with the square of the step, by 16, and as nothing else is small beside it by no less than 12. It was
// 8.0e-4 J of 2 J at 60/s, and a quarter of that at 240/s.
TEST(PlankOnAnEdge, KeepsItsEnergyAsItSlidesOff) {
    const auto error = [](double dt) {
        World world({.gravity = {0, -9.81}, .solver = SoftStep{.sleep = false}});
        Body post{.kind = Kind::fixed, .position = {-0.25, 0.5}, .shapes = {{.geometry = Box{0.5, 1}}}}, plank;
        plank.shapes = {{.geometry = Box{2, 0.1}}};
        const double tilt = 0.2;  // the lower side goes through the edge
        plank.angle = -tilt, plank.position = {0.3, 1 + 0.05 / std::cos(tilt) - 0.3 * std::tan(tilt)};
        for (Body* body : {&post, &plank}) body->restitution = 0, body->friction = 0;
        world.add(post), world.add(plank);
        const double before = energy(world).total();
        double most = 0;
        run(world, 0.3, dt, [&](const World& now) { most = std::max(most, std::abs(energy(now).total() - before)); });
        return most;
    };
    const double at_60 = error(1.0 / 60), at_240 = error(1.0 / 240);
    EXPECT_LT(at_60, 2e-5);
    EXPECT_LT(at_240, at_60 / 12);
}

// A box slides on a plank that a curve rocks. Where it is on the plank after three seconds is what its equation of
// motion says, with the friction of the force that presses it (gravity, the plank's spin and Coriolis').
TEST(BoxOnARockingPlank, SlidesAsItShould) {
    constexpr double g = 9.81, friction = 0.3, swing = 0.5, rate = 2, above = 0.1, time = 3;
    constexpr int steps = 400'000;
    double x = 1, v = 0;
    for (int i = 0; i < steps; ++i) {
        constexpr double h = time / steps;
        const double t = (i + 0.5) * h, angle = swing * std::sin(rate * t), spin = swing * rate * std::cos(rate * t),
                     turning = -rate * rate * angle;
        const double pressed = g * std::cos(angle) + turning * x + 2 * spin * v - spin * spin * above;
        const double pulled = v + h * (-g * std::sin(angle) + spin * spin * x + turning * above);
        v = pulled - std::clamp(pulled, -friction * pressed * h, friction * pressed * h), x += h * v;
    }
    const auto error = [&](double dt) {
        World world({.gravity = {0, -g}, .solver = SoftStep{}});
        Body rocker{.kind = Kind::driven, .shapes = {{.geometry = Box{40, 1, {0, -0.5}}}}}, box;
        box.shapes = {{.geometry = Box{0.4, 0.2}}};
        box.position = {1, above}, box.velocity = cross(swing * rate, box.position);
        box.angular_velocity = swing * rate;
        for (Body* body : {&rocker, &box}) body->restitution = 0, body->friction = friction;
        const BodyId plank = world.add(rocker), id = world.add(box);
        world.drive(plank, [=](double t) { return Pose{{}, swing * std::sin(rate * t)}; });
        run(world, time, dt);
        return std::abs(to_body(world.pose(plank), world.position(id)).x - x);
    };
    // Of second order, to what the steps above leave (6e-6 m). It was 1.3e-3, 5e-4 and 2.1e-4 m.
    const double at_30 = error(1.0 / 30), at_60 = error(1.0 / 60), at_120 = error(1.0 / 120);
    EXPECT_LT(at_30, 7e-4);
    EXPECT_LT(at_60, at_30 / 3.5);
    EXPECT_LT(at_120, at_60 / 3.5);
}

}  // namespace
}  // namespace carom
