// What hangs on joints struck at the very end of the part of a substep that was to end before it: its bodies had flown
// on straight ways until then, and the blow met velocities that no joint allows. An elastic bounce gained a fifth.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

/// The largest part of its energy that a welded pair, thrown elastically at a wall to the right, gains or loses.
double gained(Vec2 velocity, double spin, double gravity, bool boxes) {
    World world({.gravity = {gravity, 0}, .solver = SoftStep{}});
    world.add(HalfPlane{.point = {1, 0}, .normal = {-1, 0}});
    BodyId pair[2];
    for (const int i : {0, 1}) {
        const double x = i == 0 ? -0.125 : 0.125;
        Body body{.position = {x, 0},
                  .velocity = velocity + spin * Vec2{0, x},
                  .angular_velocity = spin,
                  .radius = 0.1,
                  .restitution = 1,
                  .friction = 0.5};
        if (boxes) body.radius = 0, body.shapes = {{.geometry = Box{0.2, 0.05}}};
        pair[i] = world.add(body);
    }
    world.add(Joint{.a = pair[0], .b = pair[1], .at = Vec2{}, .type = WeldJoint{}});
    const double before = energy(world).total();
    double most = 0;
    for (int i = 0; i < 30; ++i) {
        world.step(1.0 / 60);
        most = std::max(most, std::abs(energy(world).residual));
    }
    return most / before;
}

TEST(WeldedPair, GainsNothingAtAWall) {
    Random random(1);
    for (int n = 0; n < 400; ++n) {
        const Vec2 velocity{random.uniform(2, 9), random.uniform(-9, 9)};
        const double spin = random.uniform(-10, 10), gravity = n % 2 * 10.0;
        // Of first order in how far it turns in the thousandth of a substep that is left, and falls in it.
        EXPECT_LT(gained(velocity, spin, gravity, n % 4 > 1), 3e-3) << n;
    }
}

TEST(WeldedPair, StrikesAtAnySpeed) {
    World world({.solver = SoftStep{}});
    world.add(HalfPlane{.point = {1e198, 0}, .normal = {-1, 0}});
    const BodyId a = world.add(Body{.velocity = {1e200, 0}, .radius = 0.1, .restitution = 1});
    const BodyId b = world.add(Body{.position = {1, 0}, .velocity = {1e200, 0}, .radius = 0.1, .restitution = 1});
    world.add(Joint{.a = a, .b = b, .at = Vec2{}, .type = WeldJoint{}});
    EXPECT_NO_FATAL_FAILURE(world.step(1.0 / 60));  // its square is infinite: a part of no length had no factor
}

}  // namespace
}  // namespace carom
