// Crates that were put down just touching, and a step of a nanosecond after each of 1/60 s, such as the rest of a
// frame: the top crate was thrown up at 6.6 m/s. The rest of a velocity that is stopped in a nanosecond is a great
// force, and the precise solve began the next substep with it for all of its time, which sweeps do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(TowerPutDownTouching, IsNotThrownUpAfterATinyStep) {
    constexpr int crates = 8;
    constexpr double g = 10, dt = 1.0 / 60;
    // All that they can have: the speed of a step of free fall, each. It was 94 J with 1e-9 s.
    constexpr double fallen = 0.5 * crates * (g * dt) * (g * dt);
    for (const double tiny : {1e-10, 1e-9, 1e-8, 1e-7}) {
        World world({.gravity = {0, -g}, .solver = SoftStep{.sleep = false, .statics = false}});
        world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
        for (int i = 0; i < crates; ++i)
            world.add(
                Body{.position = {0, 0.5 + i}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.6});
        double most = 0;
        for (int i = 0; i < 40; ++i) {
            world.step(i % 2 ? tiny : dt);
            most = std::max(most, energy(world).kinetic);
        }
        EXPECT_LT(most, fallen) << tiny;
        EXPECT_LT(energy(world).kinetic, 1e-12) << tiny;  // at rest, but for rounding; it was 0.5 to 8000 J
        // What is put down touching sinks by less than a thousandth; the top crate was 4 cm to 20 m up.
        EXPECT_NEAR(world.positions()[crates - 1].y, crates - 0.5, 1e-3) << tiny;
    }
}

}  // namespace
}  // namespace carom
