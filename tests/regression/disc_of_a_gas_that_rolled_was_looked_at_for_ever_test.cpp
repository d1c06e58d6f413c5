// A disc of an exact gas that rolled on a body which turned, as near to it as rounding, was looked at in steps that
// never went too far, and hardly any way: after a thousand of them it was taken never to strike. Where no time was left
// in a step it was looked at a thousand times at one instant. Steps of eleven bodies took seconds.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "solvers/events/company.hpp"

namespace carom {
namespace {

constexpr double x = 0.5, w = 0.05, g = 1;

/// The top of a body that turns about its middle.
const GasObstacle top{.a = {2, 0}, .b = {-2, 0}, .normal = {0, 1}, .mover = 0};

GasMover turning() {
    GasMover m;
    m.reach = 2, m.half = {2, 0}, m.w = w;
    return m;
}

/// A disc beside it. Coriolis's acceleration holds g and the centrifugal one up: what is left of the gap's derivatives
/// is the third, -2 w³ x, and the fourth, 6 w² g - 4 w³ |v| = 4 w² g. So it falls by 3e-10 m at most, after 0.04 s.
GasFlight rolling(double gap) {
    constexpr double radius = 0.1;
    const Vec2 at{x, radius + gap};
    return {at, {-(g + w * w * at.y) / (2 * w), w * x}, {0, -g}, radius};
}

TEST(DiscOfAGasThatRolls, StrikesInTheEnd) {
    for (const double gap : {1e-10, 1e-11}) {
        const auto later = [gap](double t) {
            return gap - w * w * w * x * t * t * t / 3 + w * w * g * t * t * t * t / 6;
        };
        double before = 0, after = 0.03;
        for (int k = 0; k < 60; ++k) (later(0.5 * (before + after)) > 0 ? before : after) = 0.5 * (before + after);
        // It touches from 4e-14 m on: 1e-14 of how far it may get and the body reaches.
        EXPECT_NEAR(time_to(turning(), 0, top, rolling(gap), 0.1) / before, 1, 4e-14 / gap) << gap;
    }
}

TEST(DiscOfAGasThatRolls, PassesByWhereItsGapOpensAgain) {
    EXPECT_EQ(time_to(turning(), 0, top, rolling(1e-9), 0.1), HUGE_VAL);
}

}  // namespace
}  // namespace carom
