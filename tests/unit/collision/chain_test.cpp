#include <gtest/gtest.h>

#include <cmath>

#include "collision/manifold.hpp"
#include "outlines.hpp"

using namespace carom;
using namespace carom::test;

namespace {

/// Of the pieces of a chain with an outline at a place and an angle.
std::vector<Manifold> touches(const std::vector<Convex>& chain, const Convex& b, Vec2 at, double angle, double margin) {
    std::vector<Manifold> found;
    for (const Convex& piece : chain) {
        const Manifold m = manifold(piece, {}, b, frame_at(at, angle), at, margin);
        const Manifold f = manifold(b, frame_at(at, angle), piece, {}, -at, margin);
        EXPECT_EQ(f.count, m.count);
        if (m.count == 0) continue;
        EXPECT_LT(length(f.normal + m.normal), 1e-12);
        found.push_back(m);
    }
    return found;
}

const Convex disc = pieces_of(Disc{{}, 0.1})[0];
const Convex plank = pieces_of(Box{0.4, 0.2})[0];
const Convex capsule = pieces_of(Capsule{{-0.2, 0}, {0.2, 0}, 0.1})[0];

}  // namespace

TEST(Chain, IsSolidFromTheLeftAlone) {
    const auto line = pieces_of(Chain{{{-1, 0}, {1, 0}}});
    for (const Convex& b : {disc, plank, capsule}) {
        ASSERT_EQ(touches(line, b, {0, 0.09}, 0, 0.01).size(), 1u);
        EXPECT_EQ(touches(line, b, {0, 0.09}, 0, 0.01)[0].normal, (Vec2{0, 1}));
        EXPECT_NEAR(least_gap(touches(line, b, {0, 0.09}, 0, 0.01)[0]), -0.01, 1e-15);
        EXPECT_TRUE(touches(line, b, {0, -0.01}, 0, 0.01).empty());
        EXPECT_TRUE(touches(line, b, {0, -0.11}, 0, 0.1).empty());
    }
}

TEST(Chain, WithoutCornersHasNoBumps) {
    Chain flat;
    for (int i = -10; i <= 10; ++i) flat.points.push_back({0.25 * i, 1});
    const auto pieces = pieces_of(flat);
    for (const Convex& b : {disc, plank, capsule})
        for (const double sunk : {-1e-3, 0., 1e-4, 1e-2, 5e-2})
            for (double x = -1.5; x < 1.5; x += 0.00123) {
                const auto found = touches(pieces, b, {x, 1.1 - sunk}, 0, 0.02);
                ASSERT_GE(found.size(), 1u);
                for (const Manifold& m : found) {
                    ASSERT_EQ(m.normal, (Vec2{0, 1})) << sunk << " " << x;
                    EXPECT_NEAR(least_gap(m), -sunk, 1e-15);
                }
            }
}

TEST(Chain, TurnsTheNormalOfADiscRoundAConvexCorner) {
    // A roof: the room is above. Exactly one piece answers, all the way round.
    const auto roof = pieces_of(Chain{{{-1, -1}, {0, 0}, {1, -1}}});
    for (double angle = 0.1; angle < 3.04; angle += 1e-3) {
        const Vec2 out = frame_at({}, angle).turn({1, 0}),
                   normal = frame_at({}, std::clamp(angle, 0.78539816339744831, 3 * 0.78539816339744831)).turn({1, 0});
        const auto found = touches(roof, disc, 0.09 * out, 0, 0.02);
        // On the slopes the disc is deeper, and near the top it is over both.
        ASSERT_EQ(found.size(), 1u) << angle;
        EXPECT_LT(length(found[0].normal - normal), 1e-12) << angle;
    }
    for (const double width : {0.5, 3.}) {
        const auto blunt = pieces_of(Chain{{{-width, -0.01}, {0, 0}, {width, -0.01}}});
        for (double x = -0.01; x < 0.01; x += 1e-6) EXPECT_EQ(touches(blunt, disc, {x, 0.1}, 0, 0.02).size(), 1u) << x;
    }
}

TEST(Chain, HoldsADiscInAConcaveCornerFromBothSides) {
    const auto valley = pieces_of(Chain{{{-1, 1}, {0, 0}, {1, 1}}});
    const double r = 0.1, touching = r * std::sqrt(2.);
    const auto found = touches(valley, disc, {0, touching - 0.01}, 0, 0.02);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].normal.x, std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(found[1].normal.x, -std::sqrt(0.5), 1e-15);
    // Deep in the corner neither piece's end answers.
    for (const Manifold& m : touches(valley, disc, {0.03, 0.05}, 0, 0.02))
        EXPECT_NEAR(std::abs(m.normal.x), std::sqrt(0.5), 1e-15);
}

TEST(Chain, BoundsTheRoomOverItsNeighboursAsFarAsItBendsOn) {
    // A ramp that rises more and more, and then falls off: each of its lines bounds the room until the top.
    const auto ramp = pieces_of(Chain{{{-1, 0}, {0, 0}, {1, 0.1}, {2, 0.4}, {3, 0.9}, {4, 0.2}}});
    const auto over = [&](const Convex& b, std::size_t piece, double x, double margin) {
        return manifold(ramp[piece], {}, b, {}, {x, 1}, margin);
    };
    for (const Convex& b : {disc, plank, capsule}) {
        EXPECT_EQ(over(b, 0, 2.5, 10).count, 1);
        EXPECT_TRUE(over(b, 0, 2.5, 10).beside);
        EXPECT_EQ(over(b, 0, 2.5, 10).normal, (Vec2{0, 1}));
        EXPECT_NEAR(least_gap(over(b, 0, 2.5, 10)), 0.9, 1e-15);
        EXPECT_EQ(over(b, 0, 2.5, 2).count, 0);   // farther than it comes
        EXPECT_EQ(over(b, 0, 3.5, 10).count, 0);  // beyond the top
        EXPECT_EQ(over(b, 3, 0.5, 10).count, 1);  // the last line that rises
        EXPECT_EQ(over(b, 4, 0.5, 10).count, 0);
    }
    // Of a closed chain all lines that are not turned away do.
    Chain ring{.closed = true};
    for (int i = 0; i < 12; ++i) ring.points.push_back(frame_at({}, i * 0.52359877559829887).turn({1, 0}));
    for (const Convex& piece : pieces_of(ring)) {
        EXPECT_NEAR(piece.previous_reach, std::sqrt(0.5), 1e-12);
        EXPECT_NEAR(piece.next_reach, piece.previous_reach, 1e-12);
    }
}

TEST(Chain, GivesNormalsBetweenThoseOfItsPiecesAlone) {
    const auto hill = pieces_of(Chain{{{-2, 0}, {-1, 0}, {0, 0.5}, {1, 0.3}, {1.5, -0.2}, {2, 0.4}}});
    Random random(1);
    int answers = 0;
    for (int n = 0; n < 100000; ++n) {
        const Convex b = random_outline(random, 0.15);
        const Vec2 at{random.uniform(-1.8, 1.8), random.uniform(-0.2, 0.8)};
        for (const Manifold& m : touches(hill, b, at, random.uniform(-4, 4), 0.01)) {
            ++answers;
            ASSERT_NEAR(length(m.normal), 1, 1e-12);
            ASSERT_GT(m.normal.y, 0.6) << n;  // the steepest slope has 0.64, from x = 1.5 on
        }
    }
    EXPECT_GT(answers, 10000);
}

TEST(Chain, NeverLosesABoxThatSlidesOverItsCorners) {
    for (const double bend : {-0.5, -0.1, -1e-9, 0., 1e-9, 0.1, 0.5}) {
        // From the left along the flat, then up or down.
        const auto pieces = pieces_of(Chain{{{-2, 0}, {0, 0}, {2, 2 * bend}}});
        for (double x = -0.3; x < 0.3; x += 1e-3)
            for (const double angle : {0., -1e-6, 0.05, std::atan(bend), std::atan(bend) / 2}) {
                const Frame frame = frame_at({}, angle);
                double lowest = 1e300;  // the plank is let down until the first of all touches
                for (int i = 0; i < 4; ++i) {
                    const Vec2 c = frame.turn(plank.corner[i]) + Vec2{x, 0};
                    lowest = std::min(lowest, c.y - std::max(c.x, 0.) * bend);
                }
                for (int i = 0; i < 4; ++i) {  // the chain's corner against the plank's edges
                    const Vec2 from = frame.turn(plank.corner[i]) + Vec2{x, 0};
                    const Vec2 to = frame.turn(plank.corner[(i + 1) % 4]) + Vec2{x, 0};
                    if (from.x < 0 && to.x > 0)
                        lowest = std::min(lowest, from.y - from.x * (to.y - from.y) / (to.x - from.x));
                }
                double least = 1e300;
                for (const Manifold& m : touches(pieces, plank, {x, -lowest - 1e-3}, angle, 0.01))
                    least = std::min(least, least_gap(m));
                ASSERT_LT(least, -0.8e-3) << bend << " " << x << " " << angle;
                ASSERT_GT(least, -1.2e-3) << bend << " " << x << " " << angle;
            }
    }
}

TEST(Chain, DoesNotTiltABoxThatOverhangsACorner) {
    for (const double bend : {0.05, 0.1, 0.5, 2.}) {
        const auto edge = pieces_of(Chain{{{-2, 0}, {0, 0}, {2, -2 * bend}}});
        const auto mirrored = pieces_of(Chain{{{-2, -2 * bend}, {0, 0}, {2, 0}}});
        for (const double sunk : {0., 1e-4, 1e-3})
            for (double x = -0.3; x < 0.19; x += 1e-3)
                for (const bool mirror : {false, true}) {
                    const Vec2 at{mirror ? -x : x, 0.1 - sunk};
                    const auto found = touches(mirror ? mirrored : edge, plank, at, 0, 0.005);
                    ASSERT_GE(found.size(), 1u) << bend << " " << x;
                    for (const Manifold& m : found)
                        ASSERT_NEAR(m.normal.y, 1, 1e-4) << bend << " " << sunk << " " << x << " " << mirror;
                }
    }
}

TEST(Chain, HasASharpCornerAllRound) {
    const auto spike = pieces_of(Chain{{{-1, -10}, {0, 0}, {1, -10}}});
    for (double angle = 0.1; angle < 3.04; angle += 1e-3) {
        const Vec2 out = frame_at({}, angle).turn({1, 0});
        const auto found = touches(spike, disc, 0.09 * out, 0, 0.02);
        ASSERT_EQ(found.size(), 1u) << angle;
        EXPECT_LT(length(found[0].normal - out), 1e-12) << angle;
    }
}

// A gap shorter than 1.4 cm was compared with the sine of an angle, and whose the contact is then was a matter of
// units.
TEST(Chain, IsTheSameInKilometres) {
    constexpr double km = 1024;
    Random random(1);
    int touching = 0;
    for (int n = 0; n < 20000; ++n) {
        const double left = random.uniform(-0.5, 0.5), right = random.uniform(-0.5, 0.5);
        const auto pieces = [&](double m) { return pieces_of(Chain{{{m, m * right}, {0, 0}, {-m, m * left}}}); };
        const auto chain = pieces(1), ridge = pieces(km);
        const double size = random.uniform(0.02, 0.5);
        Random again = random;
        const Convex stone = random_outline(random, size), rock = random_outline(again, km * size);
        const Frame at = random_frame(random);
        const double x = random.uniform(-0.5, 0.5);
        const Vec2 between{x, random.uniform(0, 0.6)};
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const Manifold m = manifold(chain[i], {}, stone, at, between, 0.1);
            const Manifold k = manifold(ridge[i], {}, rock, at, km * between, km * 0.1);
            ASSERT_EQ(m.count, k.count) << n;
            touching += m.count;
            for (int j = 0; j < m.count; ++j) ASSERT_EQ(km * m.point[j].gap, k.point[j].gap) << n;
        }
    }
    EXPECT_GT(touching, 2000);
}
