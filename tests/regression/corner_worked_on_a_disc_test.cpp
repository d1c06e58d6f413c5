// A disc that rested on one wall and came to a second was carried by both: it flew on through the first, or lost and
// won energy on no account (fuzzer, seeds 155712 and 263481). It slides away from the first, strikes it, or is caught.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

#include "throughput.hpp"

namespace carom {
namespace {

using std::numbers::pi;

/// A disc of radius 0.1 m thrown between two walls through the origin that open by `opening`, about a middle that may
/// lean.
World corner(double opening, double lean, Random& random) {
    World world({.gravity = {0, -10}});
    for (const double side : {-0.5, 0.5}) {
        const double along = 0.5 * pi + lean + side * opening;
        const double normal = along - (side > 0 ? 0.5 : -0.5) * pi;
        world.add(HalfPlane{.normal = {std::cos(normal), std::sin(normal)},
                            .side = {.restitution = random.uniform() < 0.5 ? 0 : random.uniform()}});
    }
    const double out = 0.1 / std::sin(0.5 * opening) + random.uniform(0, 0.3);
    world.add(Body{.position = out * Vec2{-std::sin(lean), std::cos(lean)},
                   .velocity = {random.uniform(-3, 3), random.uniform(-3, 3)},
                   .angular_velocity = random.uniform(-30, 30),
                   .radius = 0.1,
                   .restitution = random.uniform() < 0.5 ? 0 : random.uniform(),
                   .friction = random.uniform()});
    return world;
}

double depth(const World& world) {
    double most = 0;
    for (const HalfPlane& wall : world.half_planes())
        most = std::max(most, 0.1 - dot(world.positions()[0], wall.normal) / length(wall.normal));
    return most;
}

TEST(Corner, DoesNoWorkOnADisc) {
    Random random(13);
    for (int n = 0; n < 300; ++n) {
        World world = corner(random.uniform(0.1, 3.1), random.uniform(-1.5, 1.5), random);
        test::Throughput through(world);
        for (int i = 0; i < 60; ++i) {
            world.step(1.0 / 60);
            through.add(world);
            test::expect_closed(world, through);
            ASSERT_LT(depth(world), 1e-9) << n;  // of a body on walls: gaps of 1e-9 radii are contact
        }
    }
}

}  // namespace
}  // namespace carom
