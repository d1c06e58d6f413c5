// Of two boxes that lie flat in one another the closest points were a corner of one and its foot on the line of a side
// of the other, beyond that side's end.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

/// How far a point is from the rim of an upright box.
double off_rim(Vec2 point, Vec2 centre, const Box& box) {
    const double beyond_x = std::abs(point.x - centre.x) - box.width / 2,
                 beyond_y = std::abs(point.y - centre.y) - box.height / 2;
    return std::abs(std::max(beyond_x, beyond_y));
}

TEST(ClosestPoints, OfBoxesThatOverlapAreOnTheirRims) {
    const Box box_a{0.374, 1.064}, box_b{0.249, 0.583};
    for (double x = -0.3; x < 0.305; x += 0.03)
        for (double y = -0.8; y < 0.805; y += 0.08) {
            World world;
            const BodyId a = world.add(Body{.shapes = {{.geometry = box_a}}});
            const BodyId b = world.add(Body{.position = {x, y}, .shapes = {{.geometry = box_b}}});
            const ClosestPoints points = *world.closest_points(a, b);
            const double overlap_x = (box_a.width + box_b.width) / 2 - std::abs(x),
                         overlap_y = (box_a.height + box_b.height) / 2 - std::abs(y);
            ASSERT_NEAR(points.distance, -std::min(overlap_x, overlap_y), 1e-15) << x << ' ' << y;
            EXPECT_NEAR(off_rim(points.on_a, {}, box_a), 0, 1e-12) << x << ' ' << y;
            EXPECT_NEAR(off_rim(points.on_b, {x, y}, box_b), 0, 1e-12) << x << ' ' << y;
            EXPECT_NEAR(length(points.on_a - points.on_b), -points.distance, 1e-12) << x << ' ' << y;
        }
}

}  // namespace
}  // namespace carom
