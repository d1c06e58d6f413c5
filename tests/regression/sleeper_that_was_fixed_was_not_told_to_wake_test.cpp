// A crate that slept and was made fixed or driven was asleep no more, but no event said so until it was dynamic again:
// whoever counted sleepers by events counted it for good.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(SleeperThatWasFixed, IsToldToWake) {
    for (const Kind kind : {Kind::fixed, Kind::driven}) {
        World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
        world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
        BodyId crate[2];
        for (int i = 0; i < 2; ++i)
            crate[i] = world.add(
                Body{.position = {0, 0.5 + i}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.5});
        run(world, 1, 1.0 / 60);
        ASSERT_TRUE(world.asleep(crate[0]));
        Body held = world.body(crate[0]);
        held.kind = kind;
        world.set(crate[0], held);
        world.step(1.0 / 60);
        const auto& wakes = world.events().wakes;
        EXPECT_FALSE(world.asleep(crate[0]));
        EXPECT_EQ(std::count(wakes.begin(), wakes.end(), crate[0]), 1);
        held.kind = Kind::dynamic;
        world.set(crate[0], held);
        world.step(1.0 / 60);
        EXPECT_EQ(std::count(wakes.begin(), wakes.end(), crate[0]), 0);
        run(world, 1, 1.0 / 60);
        EXPECT_TRUE(world.asleep(crate[0]));
        EXPECT_TRUE(world.asleep(crate[1]));
    }
}

}  // namespace
}  // namespace carom
