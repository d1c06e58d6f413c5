// A lift on a curve was put where the curve has it at the time that the world tells, when a restored world looked at
// who may be left out; in the world that was saved it stayed where the sum of the substeps had it, a rounding away.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "restored.hpp"

namespace carom {
namespace {

/// Crates of which some ride on a lift and the others stand beside it.
World yard() {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{.precise = Precise::never}});
    world.add(HalfPlane{.side = {.friction = 0.6}});
    const BodyId lift = world.add(Body{.kind = Kind::driven,
                                       .position = {0, 2},
                                       .shapes = {{.geometry = Box{3, 0.3}}},
                                       .restitution = 0,
                                       .friction = 0.8});
    world.drive(lift, [](double t) { return Pose{{std::sin(t), 2 + std::sin(2 * t)}, 0}; });
    for (int i = 0; i < 8; ++i)
        world.add(Body{.position = {0.75 * i - 1, 3.0 + 0.1 * i},
                       .mass = 1.0 + i,
                       .shapes = {{.geometry = Box{0.5, 0.6}}},
                       .restitution = 0,
                       .friction = 0.5});
    return world;
}

TEST(RestoredRidersOfALift, GoOnWithTheSameBits) {
    World world = yard();
    for (int i = 0; i < 200; ++i) {
        world.step(1.0 / 60);
        World restored = yard(), copy = world;
        test::restore_from(world, restored);
        copy.step(1.0 / 60), restored.step(1.0 / 60);
        ASSERT_EQ(state_hash(restored), state_hash(copy)) << "after " << world.time() << " s";
    }
}

}  // namespace
}  // namespace carom
