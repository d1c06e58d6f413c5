#include <gtest/gtest.h>

#include <limits>

#include "scenes.hpp"

namespace carom::test {
namespace {

class Pairs : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(Both, Pairs, testing::Values(Pair::dormand_prince54, Pair::dormand_prince853),
                         [](const auto& test) {
                             return std::string(test.param == Pair::dormand_prince54 ? "dp54" : "dp853");
                         });

// With an error per step in proportion to the tolerance, the error at the end is too: measured 2 to 10 tolerances with
// the pair of orders 5 and 4, 0.05 to 1.6 with the other, over eight decades.
TEST_P(Pairs, ErrorIsInProportionToTheTolerance) {
    for (const Scene& scene : scenes) {
        const auto exact = everything(after(scene.make(GaussRadau{}), 1.7, 10));
        for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
            const World world = after(scene.make(Adaptive{GetParam(), tolerance}), 1.7, 17);
            const double error = largest_difference(everything(world), exact);
            EXPECT_LT(error, 20 * tolerance) << scene.name << " " << tolerance;
            EXPECT_GT(error, 0.02 * tolerance) << scene.name << " " << tolerance;
        }
    }
}

// Frames are cut from the same motion: how often one looks does not change it. (Long frames allow longer steps, so the
// bits differ.)
TEST_P(Pairs, FramesOfAnyLengthShowTheSameMotion) {
    for (const Scene& scene : scenes) {
        const Adaptive method{GetParam(), 1e-9};
        World rare = scene.make(method), often = scene.make(method), truth = scene.make(GaussRadau{});
        for (int k = 0; k < 90; ++k) {
            rare.step(1.0 / 60);
            truth.step(1.0 / 60);
            for (int i = 0; i < 10; ++i) often.step(1.0 / 600);
            EXPECT_LT(largest_difference(everything(rare), everything(often)), 3e-8) << scene.name << " frame " << k;
            EXPECT_LT(largest_difference(everything(rare), everything(truth)), 3e-8) << scene.name << " frame " << k;
        }
    }
}

TEST_P(Pairs, EnergyAndItsAccountsAddUp) {
    World world = damped_pendulum(Adaptive{GetParam(), 1e-11});
    for (int k = 0; k < 100; ++k) {
        world.step(1.0 / 60);
        EXPECT_LT(std::abs(energy(world).residual), 1e-8);
    }
}

// Changes from outside begin a new step: what was computed ahead is forgotten.
TEST_P(Pairs, AChangedVelocityCounts) {
    const auto play = [](const Integrator& method) {
        World world = after(elastic_pendulum(method), 0.5, 30);
        world.set_velocity(world.ids()[1], {0, 1}, 0);
        return everything(after(world, 0.5, 30));
    };
    EXPECT_LT(largest_difference(play(Adaptive{GetParam(), 1e-10}), play(GaussRadau{})), 1e-8);
}

// A force that acts for two frames only, after long steps of a motion that needs none.
TEST_P(Pairs, AShortForceIsSeen) {
    World world({.integrator = Adaptive{GetParam(), 1e-6}});
    world.add(Body{});
    world.add(ForceField{.force = [](Vec2, Vec2, double, double t) {
        const double s = (t - 5) * 60;  // a bump (1 − s²)² over two frames, of impulse 16/15/60
        return Vec2{std::abs(s) < 1 ? (1 - s * s) * (1 - s * s) : 0, 0};
    }});
    run(world, 10, 1.0 / 60);
    EXPECT_NEAR(world.velocities()[0].x, 16.0 / 15 / 60, 1e-4);
}

TEST_P(Pairs, AStepThatCollapsesIsAnErrorWithItsTime) {
    // Free fall from 1 into a point mass of GM = 1: after π/√8 = 1.1107 s.
    World world({.integrator = Adaptive{GetParam(), 1e-9}});
    world.add(Body{.kind = Kind::fixed, .mass = 1});
    world.add(Body{.position = {1, 0}, .mass = 1});
    world.add(Attraction{.strength = 1});
    EXPECT_NE(complaint(world, 2).find("t = 1.1107"), std::string::npos) << complaint(world, 2);
}

TEST_P(Pairs, AForceThatIsNoNumberIsAnError) {
    World world({.integrator = Adaptive{GetParam()}});
    world.add(Body{});
    world.add(ForceField{.force = [](Vec2, Vec2, double, double t) {
        return Vec2{t > 1 ? std::numeric_limits<double>::quiet_NaN() : 0, 0};
    }});
    EXPECT_NE(complaint(world, 2).find("t = 1 s"), std::string::npos) << complaint(world, 2);
}

}  // namespace
}  // namespace carom::test
