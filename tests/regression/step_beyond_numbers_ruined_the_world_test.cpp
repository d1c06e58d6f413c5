// A step of 1e-308 s, which has no reciprocal, left contacts that were no numbers, and one of 1e308 s never ended; a
// box as large as numbers go found one of three bodies, for its size is none; and a disc whose moment of inertia is no
// number was taken, with an energy that is none either.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "error_of.hpp"

namespace carom::test {
namespace {

World ball_on_a_floor() {
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    world.add(HalfPlane{});
    world.add(Body{.position = {0, 0.5}, .radius = 0.5, .restitution = 0});
    world.add(Body{.position = {3, 3}, .radius = 0.5, .restitution = 0.2});
    return world;
}

TEST(BeyondNumbers, AStepIsRefusedAndTheWorldIsAsItWas) {
    World world = ball_on_a_floor();
    world.step(0.01);
    const World before = world;
    EXPECT_EQ(error_of([&] { world.step(1e308); }), "World::step: dt must be at most 1e300 s, got 1e+308 s");
    for (const double dt : {1e-308, 1.7e-313})
        EXPECT_TRUE(error_of([&] { world.step(dt); }).starts_with("World::step: dt must be at least 1e-300 s")) << dt;
    EXPECT_EQ(state_hash(world), state_hash(before));
    world.step(1e-300);
    world.step(0.01);
    EXPECT_NEAR(world.position(world.ids()[0]).y, 0.5, 1e-3) << "lies on the floor";
}

TEST(BeyondNumbers, ABoxFindsAllThatIsInIt) {
    World world;
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Box{}}}});
    world.add(Body{.kind = Kind::fixed, .position = {5, 5}, .radius = 1});
    world.add(Body{.kind = Kind::fixed, .position = {-1e6, 5}, .radius = 1});
    EXPECT_EQ(world.shapes_in_box({-1e308, -1e308}, {1e308, 1e308}).size(), 3u);
    EXPECT_EQ(world.shapes_in_box({-1e308, 5.5}, {1e308, 1e308}).size(), 2u);
    EXPECT_EQ(world.shapes_in_box({5.8, 5.8}, {1e308, 1e308}).size(), 0u) << "a corner beside the disc";
    EXPECT_EQ(world.shapes_in_box({6, 5}, {1e308, 1e308}).size(), 1u) << "which it touches";
}

TEST(BeyondNumbers, AMomentOfInertiaIsRefused) {
    World world;
    EXPECT_EQ(error_of([&] { world.add(Body{.radius = 1e160, .name = "huge"}); }),
              "Body 'huge' must have a moment of inertia that a number can hold [kg m²], got inf");
    EXPECT_EQ(world.size(), 0u);
}

}  // namespace
}  // namespace carom::test
