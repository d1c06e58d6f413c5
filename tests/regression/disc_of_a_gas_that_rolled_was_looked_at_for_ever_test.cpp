// A disc of an exact gas that rolled on a body which turned, as near to it as rounding, was looked at in steps that
// never went too far, and hardly any way: after a thousand of them it was taken never to strike. Where no time was left
// in a step it was looked at a thousand times at one instant. Steps of eleven bodies took seconds.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "solvers/events/company.hpp"

namespace carom {
namespace {

/// A disc at x on a body that turns at w, under g.
struct Roller {
    static constexpr double x = 0.5, w = 0.05, g = 1;

    /// Until it strikes the top of the body.
    static double time_until_hit(double gap) {
        const GasObstacle top{.a = {2, 0}, .b = {-2, 0}, .normal = {0, 1}, .mover = 0};
        GasMover m;
        m.reach = 2, m.half = {2, 0}, m.w = w;
        return time_to(m, 0, top, at(gap), 0.1);
    }
    /// Coriolis's acceleration holds g and the centrifugal one up: what is left of the gap's derivatives is the third,
    /// -2 w³ x, and the fourth, 6 w² g - 4 w³ |v| = 4 w² g. So it falls by 3e-10 m at most, after 0.04 s.
    static GasFlight at(double gap) {
        constexpr double radius = 0.1;
        const Vec2 place{x, radius + gap};
        return {place, {-(g + w * w * place.y) / (2 * w), w * x}, {0, -g}, radius};
    }
    static double gap_after(double gap, double t) {
        return gap - w * w * w * x * t * t * t / 3 + w * w * g * t * t * t * t / 6;
    }
};

TEST(DiscOfAGasThatRolls, StrikesInTheEnd) {
    for (const double gap : {1e-10, 1e-11}) {
        double before = 0, after = 0.03;
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (before + after);
            (Roller::gap_after(gap, middle) > 0 ? before : after) = middle;
        }
        // It touches from 4e-14 m on: 1e-14 of how far it may get and the body reaches.
        EXPECT_NEAR(Roller::time_until_hit(gap) / before, 1, 4e-14 / gap) << gap;
    }
}

TEST(DiscOfAGasThatRolls, PassesByWhereItsGapOpensAgain) { EXPECT_EQ(Roller::time_until_hit(1e-9), HUGE_VAL); }

}  // namespace
}  // namespace carom
