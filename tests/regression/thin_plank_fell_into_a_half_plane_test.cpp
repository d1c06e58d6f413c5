// Planks as thin as a fiftieth of their length that toppled or were thrown ended inside the floor, by up to five times
// their thickness and for most of a second, where it was a half-plane or the side of a rectangle: its contact was with
// the two lowest corners, and those of the short end are that until a plank lies flat to a fiftieth.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <numbers>

#include "overlap.hpp"

namespace carom {
namespace {

TEST(ThinPlank, LandsOnAHalfPlane) {
    constexpr double thick = 0.01;
    Random random(1);
    for (const double length : {0.5, 1.0})
        for (int i = 0; i < 30; ++i) {
            World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
            world.add(HalfPlane{.normal = {0, 1}, .side = {.restitution = 0, .friction = 0.6}});
            world.add(Body{.position = {0, length * random.uniform(0.6, 1.5)},
                           .angle = random.uniform(0, 2 * std::numbers::pi),
                           .velocity = {random.uniform(-2, 2), 0},
                           .angular_velocity = random.uniform(-6, 6),
                           .shapes = {{.geometry = Box{length, thick}, .restitution = 0, .friction = 0.6}}});
            double deepest = 0;
            run(world, 2, 1.0 / 60, [&](const World& w) { deepest = std::max(deepest, test::deepest_overlap(w)); });
            EXPECT_LE(deepest, 0.1 * thick) << length << ", " << i;
        }
}

}  // namespace
}  // namespace carom
