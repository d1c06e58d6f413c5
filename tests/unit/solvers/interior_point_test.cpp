#include "solvers/interior_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace carom {
namespace {

constexpr double mass = 2, friction = 0.5;
/// Edges that push and part a little, both, are left by it: of products of 1e-12 the roots.
constexpr double root_of_products = 2e-6;

/// A body that turns about its middle, 1 m wide and a quarter of a metre above the ground, with contacts along its
/// lower side.
struct Sledge {
    IslandBodies bodies{1};
    BlockMatrix<3> matrix;

    Sledge(double vx, double vy) {
        bodies.mass = {mass, mass, 0.5};
        bodies.free = {vx, vy, 0};
        matrix.analyse(1, {});
    }
    InteriorPoint on(int contacts, double rolling = 0) {
        InteriorPoint inside(bodies, matrix);
        for (int i = 0; i < contacts; ++i) {
            const double x = contacts > 1 ? -0.5 + i / (contacts - 1.0) : 0;
            const auto push = [&](Vec2 along) { return IslandRow::push(no_place, 0, along, {}, {x, -0.25}); };
            inside.add({push({0, 1}), push({-1, 0}), IslandRow::turn(no_place, 0), mass, friction, rolling, 0, 0, 0});
        }
        return inside;
    }
};

TEST(InteriorPoint, EndsAnApproachAndHoldsWhatFrictionCanHold) {
    Sledge sledge(0.3, -1);
    for (const int contacts : {2, 3, 20}) {  // of which two would do
        InteriorPoint inside = sledge.on(contacts);
        ASSERT_TRUE(inside.solve()) << contacts;
        for (const double v : inside.velocities()) EXPECT_NEAR(v, 0, root_of_products) << contacts;
        double normal = 0, slip = 0;
        for (int i = 0; i < contacts; ++i) {
            const ConeImpulse given = inside.impulse(i);
            EXPECT_GE(given.normal, 0);
            EXPECT_LE(std::abs(given.slip), friction * given.normal * (1 + 1e-15));
            normal += given.normal, slip += given.slip;
        }
        EXPECT_NEAR(normal, mass * 1, 1e-8) << contacts;  // momentum is missed by 1e-9 at most
        EXPECT_NEAR(slip, mass * 0.3, 1e-8) << contacts;
    }
}

TEST(InteriorPoint, LetsWhatFrictionCannotHoldSlideAlongTheGroundAndNotOffIt) {
    Sledge sledge(2, -1);
    InteriorPoint inside = sledge.on(2);
    ASSERT_TRUE(inside.solve());
    // Without a look at who slides it would part at friction times its speed, 0.6 m/s. A look leaves µ² / (1 + µ²) of
    // what the one before left, and two are taken.
    const double left = std::pow(friction * friction / (1 + friction * friction), 2);
    EXPECT_NEAR(inside.velocities()[1], 0, left * friction * 2);
    EXPECT_NEAR(inside.velocities()[0], 2 - friction * (1 + inside.velocities()[1]), 1e-6);  // Coulomb
}

// A floor beneath may be near and yet as fast from coming as its gap is long by the time of a substep that is cut
// short. It changes nothing, whatever that speed: it was the measure of all speeds, and what one of 1e5 m/s left of the
// others was as good as nothing.
TEST(InteriorPoint, TakesNoMeasureOfWhatIsOnlyNear) {
    for (const double far : {1.0, 1e5, 1e9}) {
        Sledge sledge(0.3, -1);
        InteriorPoint inside = sledge.on(2);
        for (const double x : {-0.5, 0.5}) {
            const auto push = [&](Vec2 along) { return IslandRow::push(no_place, 0, along, {}, {x, -0.25}); };
            inside.add({push({0, 1}), push({-1, 0}), IslandRow::turn(no_place, 0), mass, friction, 0, -far, 0, 0});
        }
        ASSERT_TRUE(inside.solve()) << far;
        for (const double v : inside.velocities()) EXPECT_NEAR(v, 0, root_of_products) << far;
        EXPECT_NEAR(inside.impulse(0).normal + inside.impulse(1).normal, mass * 1, 1e-8) << far;
    }
}

TEST(InteriorPoint, LeavesWhatFliesAlone) {
    Sledge sledge(1, 1);
    InteriorPoint inside = sledge.on(2);
    ASSERT_TRUE(inside.solve());
    EXPECT_NEAR(inside.velocities()[0], 1, root_of_products);
    EXPECT_NEAR(inside.velocities()[1], 1, root_of_products);
}

TEST(InteriorPoint, StopsARollAsFarAsItsMomentGoes) {
    constexpr double arm = 0.01;  // m
    Sledge sledge(0, -1);
    sledge.bodies.free[2] = 3;  // rad/s
    InteriorPoint inside = sledge.on(1, arm);
    ASSERT_TRUE(inside.solve());
    const ConeImpulse given = inside.impulse(0);
    EXPECT_NEAR(given.normal, mass * 1, 0.02 * mass);  // it rolls on: a little of the normal speed is left
    EXPECT_NEAR(given.roll, -arm * given.normal, 1e-6);
}

}  // namespace
}  // namespace carom
