// A point, or a segment, that had a spin slid over a box: the precise solve measured what it missed against the
// momentum of a spin that nothing changes, and took anything for a solution: 1e16 J of negative heat.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

/// The most kinetic energy [J] on the way of what slides over a box and off it.
double most_energy(double spin, double speed, double friction, bool is_segment) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.3}});
    world.add(
        Body{.position = {0, 0.2}, .shapes = {{.geometry = Box{0.4, 0.4}}}, .restitution = 0.5, .friction = friction});
    Body slider{.position = {is_segment ? -0.15 : 0, 0.45},
                .velocity = {speed, 0},
                .angular_velocity = spin,
                .restitution = 0,
                .friction = friction};
    if (is_segment) slider.shapes = {{.geometry = Segment{{-0.1, 0}, {0.1, 0}}}};
    world.add(slider);
    double most = 0;
    for (int i = 0; i < 400; ++i) {
        world.step(1.0 / 240);
        const Energy e = energy(world);
        most = std::max(most, e.kinetic + e.rotational);
        EXPECT_NEAR(e.unaccounted(), 0, 1e-11);
    }
    return most;
}

TEST(SpinningPointOnABox, FallsAsOneThatDoesNotSpin) {
    for (int k = -5; k <= 5; ++k)
        for (const double friction : {0.0, 0.3, 0.6}) {
            const double speed = 0.2 * k, unspun = most_energy(0, speed, friction, false);
            for (const double spin : {0.5, 10.0})
                EXPECT_NEAR(most_energy(spin, speed, friction, false), unspun, 1e-9) << speed << ' ' << friction;
            EXPECT_LE(most_energy(0.5, speed, friction, true), 4.9 + 0.5) << speed << ' ' << friction;
        }
}

}  // namespace
}  // namespace carom
