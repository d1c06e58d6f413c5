// Lines have no thickness and are to pass through one another, as points do. A segment that fell on another one, or on
// a chain, was stopped by a blow and fell on from there; chains that met held one another or not as they were added.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

TEST(Lines, PassThroughOneAnotherInWhicheverOrderTheyAreAdded) {
    const std::vector<Geometry> grounds{Segment{{-3, 0}, {3, 0}}, Chain{.points = {{-3, 1}, {-1, 0}, {1, 0}, {3, 1}}}};
    const std::vector<Geometry> falling{Segment{{-0.5, 0.05}, {0.5, 0}},
                                        Chain{.points = {{-0.5, 0}, {0, 0.2}, {0.5, 0.05}}},
                                        Chain{.points = {{0.5, 0.05}, {0, 0.2}, {-0.5, 0}}}};
    for (const Geometry& ground : grounds)
        for (const Geometry& shape : falling)
            for (const bool ground_first : {true, false}) {
                World world({.gravity = {0, -10}, .solver = SoftStep{}});
                const Body below{.kind = Kind::fixed, .shapes = {{.geometry = ground}}};
                if (ground_first) world.add(below);
                const BodyId line =
                    world.add(Body{.position = {0.1, 0.5}, .moment_of_inertia = 0.1, .shapes = {{.geometry = shape}}});
                if (!ground_first) world.add(below);
                run(world, 1, 1.0 / 60);
                EXPECT_NEAR(world.position(line).y, 0.5 - 5, 1e-12);
                EXPECT_EQ(world.angle(line), 0);
            }
}

}  // namespace
}  // namespace carom
