// What stood on a driven body or hung on one was kept awake by it, even where this did not move at all.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

struct Hoist {
    World world{{.gravity = {0, -9.81}, .solver = SoftStep{}}};
    BodyId beam, load, crate;

    Hoist() {
        beam = world.add(Body{.kind = Kind::driven, .shapes = {{.geometry = Box{4, 0.2}}}, .friction = 0.5});
        load = world.add(Body{.position = {0, -1}, .mass = 1, .radius = 0.1});
        world.add(Joint{.a = beam, .b = load, .type = DistanceJoint{}});
        crate = world.add(Body{
            .position = {1, 0.6}, .mass = 1, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.5});
    }
    bool sleep() const { return world.asleep(load) && world.asleep(crate); }
    bool any_sleeps() const { return world.asleep(load) || world.asleep(crate); }
};

TEST(Hoist, LetsSleepWhatItHoldsStill) {
    Hoist hoist;
    run(hoist.world, 2, 1.0 / 60);
    EXPECT_TRUE(hoist.sleep());
    EXPECT_LE(std::abs(energy(hoist.world).residual), 1e-9);

    hoist.world.set_velocity(hoist.beam, {0, 0.5}, 0);
    run(hoist.world, 1, 1.0 / 60);
    EXPECT_FALSE(hoist.any_sleeps());
    EXPECT_NEAR(hoist.world.position(hoist.load).y, -0.5, 0.05);
    EXPECT_NEAR(hoist.world.position(hoist.crate).y, 1.1, 0.05);

    hoist.world.set_velocity(hoist.beam, {}, 0);
    run(hoist.world, 5, 1.0 / 60);
    EXPECT_TRUE(hoist.world.asleep(hoist.crate));  // the load may swing on
}

TEST(Hoist, KeepsAwakeWhatItMovesAlongACurve) {
    Hoist hoist;
    hoist.world.drive(hoist.beam, [](double t) { return Pose{{0, t < 3 ? 0 : 0.1 * (t - 3)}, 0}; });
    run(hoist.world, 4, 1.0 / 60);
    EXPECT_FALSE(hoist.any_sleeps());
    EXPECT_NEAR(hoist.world.position(hoist.crate).y, 0.7, 0.02);
}

}  // namespace
}  // namespace carom
