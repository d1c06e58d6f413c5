// An elastic point a rounding above a wall onto which a force presses it struck that a million times in each step of a
// hundredth of a second: the height of a flight that is none was a part of its size.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(ElasticPoint, RestsWhereItLiesButForARounding) {
    World world;
    world.add(HalfPlane{.point = {0, 0.3}});
    const BodyId id = world.add(Body{.position = {0, 0.3}});
    world.add(ConstantForce{.body = id, .force = {0, -10}});
    world.set_position(id, {0, 0.1 + 0.2}, 0);
    run(world, 0.1, 0.01);
    EXPECT_LE(world.collisions(), 20U);
    EXPECT_NEAR(world.position(id).y, 0.3, 1e-12);
}

// What is no rounding bounces on.
TEST(ElasticPoint, BouncesOnFromAHundredthOfAMillimetre) {
    constexpr double height = 1e-5;
    World world;
    world.add(HalfPlane{});
    const BodyId id = world.add(Body{.position = {0, height}});
    world.add(ConstantForce{.body = id, .force = {0, -10}});
    run(world, 1, 0.01);
    EXPECT_NEAR(energy(world).total(), 10 * height, 1e-12);
    EXPECT_NEAR(static_cast<double>(world.collisions()), 1 / (2 * std::sqrt(2 * height / 10)), 1);
}

}  // namespace
}  // namespace carom
