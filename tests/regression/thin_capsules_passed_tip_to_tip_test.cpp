// Two square corners are let past one another within 0.5 % of the thinner one; for capsules that was 0.5 % of their
// length: two of 1 m and 4 mm that met tip to tip at right angles sank by their radius into one another first.
#include <algorithm>
#include <numbers>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

/// By how much of their radius two rods, 1 m long, that fly at one another tip to tip get into one another.
double deepest(const Geometry& rod, double radius) {
    constexpr double speed = 0.1, tilt = std::numbers::pi / 4;
    World world({.solver = SoftStep{}});
    BodyId ids[2];
    for (const int side : {0, 1}) {
        const double sign = 2 * side - 1;
        ids[side] = world.add(Body{.position = {sign * (0.5 * std::sin(tilt) + 2 * radius + 0.01), 0},
                                   .angle = sign * tilt,
                                   .velocity = {-sign * speed, 0},
                                   .mass = 1,
                                   .shapes = {{.geometry = rod}},
                                   .restitution = 0,
                                   .friction = 0});
    }
    double nearest = 1;
    for (int step = 0; step < 300; ++step) {
        world.step(1.0 / 600);
        nearest = std::min(nearest, world.closest_points(ids[0], ids[1])->distance);
    }
    return -nearest / radius;
}

TEST(ThinRods, MeetTipToTip) {
    // Two corners level with one another are let in by 0.5 % of twice the radius.
    for (const double radius : {0.001, 0.002, 0.004, 0.01}) {
        EXPECT_LE(deepest(Capsule{{0, -0.5}, {0, 0.5}, radius}, radius), 0.011) << radius;
        EXPECT_LE(deepest(Box{.width = 2 * radius, .height = 1 + 2 * radius, .rounding = radius}, radius), 0.011);
    }
}

}  // namespace
}  // namespace carom::test
