// A force that is infinite, or no number, where the proposed step comes to made a path of it that is no number either,
// and a first touch was found on that: the disc was thrown back at once by a wall nine metres away, or by a disc.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <limits>

#include "error_of.hpp"

namespace carom::test {
namespace {

constexpr double edge = 0.505;  // [m], within the 51st step

World flying(double beyond) {
    World world({.solver = Impulse{.time_of_impact = true}});
    const BodyId disc = world.add(Body{.velocity = {1, 0.3}, .radius = 1, .name = "disc"});
    const auto force = [beyond](Vec2 x, Vec2, double, double) { return Vec2{x.x > edge ? beyond : 0, 0}; };
    world.add(ForceField{.body = disc, .force = force});
    return world;
}

/// It goes wrong as it does without a solver, in the same step, and strikes nothing before.
void goes_wrong(World world) {
    const std::string error = error_of([&] { run(world, 1, 0.01); });
    EXPECT_NE(error.find("the run went wrong at t = 0.51 s: body 'disc'"), std::string::npos) << error;
    EXPECT_NE(error.find("the force field"), std::string::npos) << error;
    EXPECT_EQ(world.collisions(), 0U);
}

TEST(ForceWithoutBound, IsNoBounceOffAFarWall) {
    for (const double beyond : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()}) {
        World room = flying(beyond), plane = flying(beyond), two = flying(beyond);
        room.add(Rectangle{{-10, -10}, {10, 10}});
        plane.add(HalfPlane{.point = {10, 0}, .normal = {-1, 0}});
        two.add(Body{.position = {5, 5}, .radius = 1});
        goes_wrong(std::move(room));
        goes_wrong(std::move(plane));
        goes_wrong(std::move(two));
    }
}

}  // namespace
}  // namespace carom::test
