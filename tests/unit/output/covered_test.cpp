// Curves that run over themselves. A phase picture of 4000 turns took gnuplot 50 s, of 10000 six minutes: Cairo works
// out the outline of a whole path at once, and each turn was in it.

#include <cmath>
#include <numbers>

#include "helpers.hpp"
#include "output/strokes.hpp"

namespace carom {
namespace {

PanelPlace square(double pixels) {
    return {.x = {.low = -1.1, .high = 1.1}, .y = {.low = -1.1, .high = 1.1}, .width = pixels, .height = pixels};
}

/// So many turns, each of which is larger than the one before by so many radii.
Curve turns(double count, double growth, Stroke stroke) {
    Curve curve{.stroke = stroke};
    constexpr double steps = 200;
    for (double k = 0; k <= count * steps; ++k) {
        const double angle = 2 * std::numbers::pi * k / steps, r = 1 + growth * k / steps;
        curve.x.push_back(r * std::cos(angle)), curve.y.push_back(r * std::sin(angle));
    }
    return curve;
}

std::size_t points_of(const std::vector<std::vector<Vec2>>& pieces) {
    std::size_t sum = 0;
    for (const auto& piece : pieces) sum += piece.size();
    return sum;
}

TEST(Covered, WhatRunsOverItselfIsDrawnOnce) {
    const PanelPlace place = square(500);
    for (const Stroke stroke : {Stroke::line, Stroke::points, Stroke::ring}) {
        const std::size_t once = points_of(strokes(turns(1, 0, stroke), place));
        EXPECT_GT(once, 30u);
        // A piece that begins within one that is drawn, or a mark at the edge between two places, may come twice.
        EXPECT_LE(points_of(strokes(turns(1000, 0, stroke), place)), 2 * once);
    }
    // Dashes have a phase, and marks on a line are joined by it.
    for (const Stroke stroke : {Stroke::dashed, Stroke::dotted, Stroke::line_and_points})
        EXPECT_GT(points_of(strokes(turns(100, 0, stroke), place)),
                  90 * points_of(strokes(turns(1, 0, stroke), place)));
}

TEST(Covered, WhatComesBesideIsDrawn) {
    // Two pixels a turn, where the line is 2.2 wide: all of them are to be seen.
    const PanelPlace place = square(500);
    const double pixel = 2.2 / 500;
    const std::size_t once = points_of(strokes(turns(1, 0, Stroke::line), place));
    EXPECT_GT(points_of(strokes(turns(10, 2 * pixel, Stroke::line), place)), 9 * once);
    // Creeping on by a little it is drawn again for each third of a pixel, and not for each turn.
    const std::size_t creeping = points_of(strokes(turns(1000, 3e-3 * pixel, Stroke::line), place));
    EXPECT_LT(creeping, 30 * once);
    EXPECT_GT(creeping, 5 * once);
}

TEST(Covered, LongPathsArePartedAndGoOnWhereTheyWere) {
    Curve curve;
    for (int k = 0; k < 4000; ++k) {
        curve.x.push_back(-1 + 5e-4 * k);
        curve.y.push_back(k % 2 ? 0.2 : -0.2);
    }
    PanelPlace place = square(500);
    place.width = 8e3;
    const auto pieces = strokes(curve, place);
    EXPECT_GE(pieces.size(), 4u);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        EXPECT_LE(pieces[k].size(), 1000u);
        if (k > 0) {
            EXPECT_EQ(pieces[k].front(), pieces[k - 1].back()) << k;
        }
    }
}

TEST(Covered, WhatIsOutsideHasAPlaceInTheLegend) {
    const Curve far{.x = {5, 6, 7}, .y = {5, 6, 5}};
    EXPECT_EQ(strokes(far, square(500)).size(), 1u);
    // And what goes past on both sides is drawn.
    EXPECT_EQ(points_of(strokes({.x = {-9, 9}, .y = {-9, 9}}, square(500))), 2u);
    EXPECT_EQ(points_of(strokes({.x = {-1e300, 1e300}, .y = {0, 0}}, square(500))), 2u);
}

}  // namespace
}  // namespace carom
