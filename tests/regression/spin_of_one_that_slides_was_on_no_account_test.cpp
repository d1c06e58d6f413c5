// Under the default solver a disc of fixed rotation that spins and slides on a rough wall took energy from nobody: what
// keeps its spin works against friction, and that was on no account.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "throughput.hpp"

namespace carom {
namespace {

TEST(SpinOfOneThatSlides, IsKeptByWhatDrivesIt) {
    constexpr double mu = 0.1, g = 10, r = 0.3, spin = -2;
    World world({.gravity = {0, -g}});
    world.add(HalfPlane{.side = {.friction = mu}});
    Body disc{.position = {0, r}, .angular_velocity = spin, .radius = r, .friction = mu};
    disc.fixed_rotation = true;
    const BodyId id = world.add(disc);
    test::Throughput through(world);
    for (int i = 0; i < 200; ++i) {
        world.step(0.01);
        through.add(world);
        test::expect_closed(world, through);
    }
    // It ends as fast as its rim, and as much as it has was heat on the way: half of the work.
    const double speed = -spin * r;
    EXPECT_NEAR(world.velocity(id).x, speed, 1e-12);
    EXPECT_NEAR(energy(world).work.driven, speed * speed, 1e-12);
    EXPECT_NEAR(energy(world).heat.friction, 0.5 * speed * speed, 1e-12);
}

}  // namespace
}  // namespace carom
