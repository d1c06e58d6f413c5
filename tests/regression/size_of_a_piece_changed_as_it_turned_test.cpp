// The size of a piece was the longer side of its box along the axes of the world: a square that stood on a corner was
// 1.4 times as large as one that lay, and was thrown out of an overlap as much faster.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

/// How far apart two squares are that were put into one another, in a world that is turned by so much.
double apart(double angle, int steps) {
    const double sine = std::sin(angle), cosine = std::cos(angle);
    World world({.solver = SoftStep{}});
    for (int k = 0; k < 2; ++k) {
        const Vec2 x{0.9 * k, 0.1 * k};
        world.add(Body{.position = {cosine * x.x - sine * x.y, sine * x.x + cosine * x.y},
                       .angle = angle,
                       .shapes = {{.geometry = Box{1, 1}}},
                       .restitution = 0});
    }
    for (int k = 0; k < steps; ++k) world.step(1.0 / 60);
    return length(world.positions()[1] - world.positions()[0]);
}

TEST(Regression, SquaresPartAlikeHoweverTheyAreTurned) {
    for (const int steps : {1, 3, 6})
        for (const double angle : {0.3, 0.7, 1.2})
            EXPECT_NEAR(apart(angle, steps), apart(0, steps), 1e-9) << angle << ", " << steps << " steps";  // rounding
}

}  // namespace
}  // namespace carom
