// An elastic ball between a floor and a driven disc that comes down on it was let bounce four million times for each
// body there was, in every step.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(ElasticBallInAPress, IsInAJam) {
    for (const bool under_forces : {false, true})
        for (const int balls : {1, 2}) {
            World world({.gravity = {0, -9.81}});
            world.add(HalfPlane{});
            for (int k = 0; k < balls; ++k) world.add(Body{.position = {0, 0.3 + 0.25 * k}, .radius = 0.1});
            world.add(Body{.kind = Kind::driven, .position = {0, 1.65}, .velocity = {0, -0.7}, .radius = 1});
            if (under_forces) world.add(Drag{.linear = 0.01});
            for (int i = 0; i < 60; ++i) {
                const std::uint64_t before = world.collisions();
                world.step(1.0 / 60);
                ASSERT_LE(world.collisions() - before, 10000u) << i;
            }
        }
}

}  // namespace
}  // namespace carom
