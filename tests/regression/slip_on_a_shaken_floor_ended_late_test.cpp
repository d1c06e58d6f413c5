// A slip on a floor that is driven along a curve ended at the wrong instant, for the floor was taken to go on as fast
// as it did: a box on a floor that is shaken was 1.5 mm from where it should be after a second, and no less than that
// at 120 steps a second.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

constexpr double pull = 0.3 * 9.81, swing = 0.2, rate = 8, time = 1;

double floor_at(double t) { return swing * std::sin(rate * t); }

struct Sliding {
    double x = 0, v = 0;
};

/// By Coulomb's law, in steps that leave 1e-6 m.
Sliding by_hand() {
    constexpr int steps = 400'000;
    constexpr double h = time / steps;
    Sliding box;
    for (int i = 0; i < steps; ++i) {
        const double slip = swing * rate * std::cos(rate * (i + 1) * h) - box.v;
        const double gained = std::clamp(slip, -pull * h, pull * h);
        box.x += h * (box.v + 0.5 * gained), box.v += gained;
    }
    return box;
}

// The floor is as fast as 1.6 m/s and accelerated by up to four times what friction gives the box, which sticks to it
// in parts of each period. In the mean of a substep that acceleration is known, and then the end of a slip is to second
// order: 4e-8 m at 60/s.
TEST(SlipOnAShakenFloor, EndsWhenItShould) {
    const Sliding wanted = by_hand();
    for (const double dt : {1.0 / 60, 1.0 / 120, 1.0 / 480}) {
        World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
        Body floor{.kind = Kind::driven, .position = {0, -0.5}, .shapes = {{.geometry = Box{40, 1}}}};
        Body box{.position = {0, 0.1}, .shapes = {{.geometry = Box{0.4, 0.2}}}};
        for (Body* body : {&floor, &box}) body->restitution = 0, body->friction = 0.3;
        world.drive(world.add(floor), [](double t) { return Pose{{floor_at(t), -0.5}, 0}; });
        const BodyId id = world.add(box);
        run(world, time, dt);
        EXPECT_NEAR(world.position(id).x, wanted.x, 2e-6) << dt;
        EXPECT_NEAR(world.velocity(id).x, wanted.v, 2e-5) << dt;
    }
}

}  // namespace
}  // namespace carom
