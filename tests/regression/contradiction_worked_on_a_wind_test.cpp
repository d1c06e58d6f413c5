// A motor and a pin that contradict one another pull a million times as hard as anything else, and one's pull on rows
// that the other had turned was taken for what both would give the body in its flight: it flew at 1e6 m/s, for a
// moment, through forces that look at velocities.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

TEST(Contradiction, WorksOnNoWind) {
    for (int n = 0; n < 100; ++n) {
        Random random(static_cast<std::uint64_t>(n));
        const auto place = [&] { return Vec2{random.uniform(-5, 5), random.uniform(-5, 5)}; };
        World world({.gravity = place(), .integrator = RungeKutta{}, .solver = SoftStep{}});
        const BodyId body = world.add(Body{.position = place(), .velocity = place(), .radius = 0.1});
        world.add(Joint{.b = body, .anchor_a = place(), .anchor_b = place(), .type = MotorJoint{place(), 3}});
        world.add(Joint{.b = body, .anchor_a = place(), .anchor_b = place(), .type = RevoluteJoint{}});
        world.add(Drag{.linear = 0.1});
        for (int i = 0; i < 4; ++i) {
            world.step(0.1);
            // What moves at 5 m/s, on levers of 7 m at 3 rad/s: 25 m/s take 6 J a step. It flies at twice that at most.
            EXPECT_LT(std::abs(energy(world).heat.drag), 4 * 4 * 6.3) << n;
        }
    }
}

}  // namespace
}  // namespace carom
