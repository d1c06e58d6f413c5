// Gauss-Radau took a million steps where a hundred do, when forces were small beside what a place's last bit makes of
// them.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

TEST(Regression, GaussRadauCreptFarFromTheOrigin) {
    long evaluations = 0;
    World world({.integrator = GaussRadau{}, .solver = NoContact{}});
    const BodyId a = world.add(Body{.position = {1500, 0}}), b = world.add(Body{.position = {1501 + 1e-4, 0}});
    world.add(Spring{.a = a, .b = b, .stiffness = 1, .rest_length = 1});
    world.add(ForceField{.body = a, .force = [&](Vec2, Vec2, double, double) { return ++evaluations, Vec2{}; }});
    world.step(20.3);
    // ω = √2: 29 radians at about one a step, some ten rounds over eight nodes each. It was 10 000.
    EXPECT_LT(evaluations, 4000);
    // The start is 1e-4 to the rounding of 1501; a place is rounded to 2e-13 in every step.
    const double stretch = world.position(b).x - world.position(a).x - 1;
    EXPECT_NEAR(stretch, 1e-4 * std::cos(std::sqrt(2) * 20.3), 3e-12);
}

}  // namespace
}  // namespace carom
