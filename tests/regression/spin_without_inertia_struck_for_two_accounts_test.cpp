// Where joints are near a strike, the work of a spin that nothing changes was on the account of who keeps it and on the
// method's too.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(SpinWithoutInertia, StrikesAPendulumForOneAccount) {
    World world({.solver = SoftStep{}});
    const BodyId bob = world.add(Body{.radius = 0.3});
    world.add(Joint{.b = bob, .at = Vec2{0, 1}, .type = RevoluteJoint{}});
    world.add(Body{.position = {-1, 0},
                   .velocity = {2, 0},
                   .angular_velocity = 3,
                   .shapes = {{.geometry = Segment{{-0.3, 0}, {0.3, 0}}}}});
    for (int i = 0; i < 120; ++i) {
        world.step(1.0 / 60);
        ASSERT_NEAR(energy(world).unaccounted(), 0, 1e-13) << i;
    }
    EXPECT_GT(world.collisions(), 0u);
    EXPECT_NE(energy(world).work.driven, 0);
}

}  // namespace
}  // namespace carom
