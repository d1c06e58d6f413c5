// A plank that bounces a little and was put against a wall sank into it at 13 mm/s, up to its thickness, and bounced
// once in each substep: its foot stood on the floor and turned it back in, but a corner on which a body falls over was
// passed over even while it overlapped, so that the bounce never came to rest.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "overlap.hpp"

namespace carom {
namespace {

Body box(Kind kind, Vec2 at, double angle, Box size, double restitution) {
    return {.kind = kind,
            .position = at,
            .angle = angle,
            .shapes = {{.geometry = size, .density = 10, .restitution = restitution, .friction = 0.6}}};
}

TEST(LeaningPlank, DoesNotSinkIntoTheWall) {
    constexpr double length = 1, thick = 0.05;
    for (const double restitution : {0.2, 0.3, 0.5, 0.9})
        for (const double angle : {1.0, 1.1, 1.2, 1.3}) {
            World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
            world.add(box(Kind::fixed, {0, -0.5}, 0, Box{10, 1}, restitution));
            world.add(box(Kind::fixed, {-0.5, 2}, 0, Box{1, 6}, restitution));
            const Vec2 middle{0.5 * (length * std::cos(angle) + thick * std::sin(angle)),
                              0.5 * (length * std::sin(angle) + thick * std::cos(angle))};
            world.add(box(Kind::dynamic, middle, -angle, Box{length, thick}, restitution));
            double deepest = 0;
            run(world, 3, 1.0 / 60, [&](const World& w) { deepest = std::max(deepest, test::deepest_overlap(w)); });
            EXPECT_LE(deepest, 0.01 * thick) << restitution << ", " << angle;
        }
}

}  // namespace
}  // namespace carom
