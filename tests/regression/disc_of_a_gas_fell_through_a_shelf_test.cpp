// Discs of an exact gas with gravity flew through whatever has a straight edge: a parabola that passed the end of an
// edge and came down on its other face was never held against that. Of 200 discs that flew about one box for 200 s 142
// ended in it, and a gas there in "the gas is jammed".

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "trials.hpp"

namespace carom {
namespace {

struct Obstacle {
    std::string name;
    Geometry geometry;
    double top;  ///< of its upper side, which is level [m]
};

std::vector<Obstacle> obstacles() {
    return {{"segment", Segment{{-1, 0}, {1, 0}}, 0},
            {"segment from right to left", Segment{{1, 0}, {-1, 0}}, 0},
            {"box", Box{2, 0.4}, 0.2},
            {"rounded box", Box{.width = 2, .height = 0.4, .rounding = 0.1}, 0.2},
            {"capsule", Capsule{{-1, 0}, {1, 0}, 0.3}, 0.3},
            {"hull", Hull{{{-0.9, 0.1}, {0, -0.2}, {0.9, 0.1}}, 0.1}, 0.2},
            {"concave polygon", Polygon{{{-1, -0.2}, {1, -0.2}, {1, 0.2}, {-1, 0.2}, {0, 0}}}, 0.2}};
}

/// Thrown from below past its end, a disc of radius 0.1 m comes down on its upper side, and flies off as fast. How high
/// over the middle of the obstacle it is in the end.
constexpr double r = 0.1, pull = 3, duration = 2.6;
constexpr Vec2 start{-3, -0.8}, throw_velocity{1.7, 3.5};
double height_in_the_end(double top) {
    const double level = top + r, up = throw_velocity.y;
    const double at_landing = std::sqrt(up * up - 2 * pull * (level - start.y)),
                 left = duration - (up + at_landing) / pull;
    return level + left * (at_landing - 0.5 * pull * left);
}

TEST(DiscOfAGasOverAShelf, LandsOnIt) {
    for (const Obstacle& obstacle : obstacles())
        for (const Vec2 drive : {Vec2{}, Vec2{0.3, 0.4}}) {
            World world({.gravity = {0, -pull}, .solver = Events{}});
            world.add(Rectangle{{-5, -4}, {5, 4}});
            const bool stands = drive == Vec2{};
            world.add(Body{.kind = stands ? Kind::fixed : Kind::driven,
                           .velocity = drive,
                           .shapes = {{.geometry = obstacle.geometry}}});
            const BodyId disc = world.add(Body{.position = start, .velocity = throw_velocity + drive, .radius = r});
            run(world, duration, 0.1);
            EXPECT_EQ(world.collisions(), 1u) << obstacle.name << ' ' << stands;
            // Ten sums or so of metres, and of what is left of the square root.
            EXPECT_NEAR(world.position(disc).y - duration * drive.y, height_in_the_end(obstacle.top), 1e-14)
                << obstacle.name << ' ' << stands;
        }
}

// A body of the gas's company is met likewise, step by step.
TEST(DiscOfAGasOverAShelf, LandsOnOneThatIsMovedInSteps) {
    for (const Obstacle& obstacle : obstacles())
        for (const double step : {0.01, 0.1, 2.6}) {
            World world({.gravity = {0, -pull}, .solver = Events{.substeps = 1}});
            world.add(Rectangle{{-5, -4}, {5, 4}});
            const BodyId shelf = world.add(Body{.mass = 1, .shapes = {{.geometry = obstacle.geometry}}});
            world.add(Joint{.b = shelf, .at = Vec2{0, 0}, .type = WeldJoint{}});
            const BodyId disc = world.add(Body{.position = start, .velocity = throw_velocity, .radius = r});
            run(world, duration, step);
            EXPECT_EQ(world.collisions(), 1u) << obstacle.name << ' ' << step;
            // What turns, if by a rounding of its weld, is met to 1e-14 of how far the disc could get in the step, some
            // tens of metres.
            EXPECT_NEAR(world.position(disc).y, height_in_the_end(obstacle.top), 1e-11) << obstacle.name << ' ' << step;
        }
}

// Under a pull aside as well, from all sides, for 20 s each. A segment has no inside.
TEST(DiscOfAGasOverAShelf, NeverGetsInside) {
    for (const Obstacle& obstacle : obstacles()) {
        if (std::holds_alternative<Segment>(obstacle.geometry)) continue;
        for (std::uint64_t seed = 0; seed < test::trials(20); ++seed) {
            Random random(seed);
            const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
            World world({.gravity = {0.7, -3}, .solver = Events{}});
            world.add(Rectangle{{-5, -4}, {5, 4}});
            world.add(Body{.kind = Kind::fixed, .angle = between(-3, 3), .shapes = {{.geometry = obstacle.geometry}}});
            world.add(Body{.position = {between(-4, 4), between(1.5, 3.5)},
                           .velocity = {between(-2, 2), between(-2, 2)},
                           .radius = r});
            for (int i = 0; i < 200; ++i) {
                world.step(0.1);
                for (const auto& overlap : world.overlaps())
                    ASSERT_LT(overlap.depth, 1e-9 * r) << obstacle.name << ' ' << seed << ' ' << world.time();
            }
        }
    }
}

}  // namespace
}  // namespace carom
