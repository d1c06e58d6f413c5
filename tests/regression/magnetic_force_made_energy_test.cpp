// Under Verlet, the default, a force that turns velocities made them faster, without bound: the velocity in the middle
// of a half kick was foretold but once. After 200 gyrations of 40 steps by 17 %.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

TEST(AMagneticForce, KeepsTheSpeedUnderVerlet) {
    constexpr double rate = 2 * std::numbers::pi;  // a gyration a second
    World world;
    world.add(ForceField{.force = [](Vec2, Vec2 v, double, double) { return rate * Vec2{-v.y, v.x}; }});
    const BodyId charge = world.add(Body{.velocity = {1, 0}});
    run(world, 200, 1.0 / 40);
    EXPECT_NEAR(length(world.velocity(charge)), 1, 1e-11);  // 8000 steps of rounding, 1e-15 each
    EXPECT_NEAR(energy(world).residual, 0, 1e-11);
}

}  // namespace
}  // namespace carom::test
