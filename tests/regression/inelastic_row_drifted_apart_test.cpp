// A box that runs into seven others in a row, without gravity and without a bounce, as wagons couple: the last tenth of
// the blow was left to sweeps, unevenly over both corners, and the boxes went on with 0.97 to 1.04 of their speed,
// turned at up to 0.7 rad/s and overlapped by 1.6 mm.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(InelasticRow, GoesOnAsOne) {
    for (const int count : {4, 8, 16}) {
        World world({.solver = SoftStep{}});
        for (int i = 0; i < count; ++i)
            world.add(Body{.position = {1.3 * i, 0},
                           .mass = 2,
                           .shapes = {{.geometry = Box{1, 0.5}}},
                           .restitution = 0,
                           .friction = 0});
        constexpr double speed = 8;
        world.set_velocity(world.ids()[0], {speed, 0}, 0);
        for (int i = 0; i < 600; ++i) world.step(1.0 / 60);
        // All momentum is shared. Three thousandths of a blow are left to sweeps, which end most of them.
        for (const BodyId id : world.ids()) {
            EXPECT_NEAR(world.velocity(id).x * count / speed, 1, 1e-3) << count;
            EXPECT_NEAR(world.angular_velocity(id), 0, 1e-3) << count;
        }
    }
}

}  // namespace
}  // namespace carom
