#include "collision/manifold.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outlines.hpp"
#include "trials.hpp"

using namespace carom;
using namespace carom::test;

namespace {

constexpr double far = 1e300;  // a margin that leaves no point out

Convex box(double width, double height) { return pieces_of(Box{width, height})[0]; }

Manifold touch(const Convex& a, const Convex& b, Vec2 between, double margin = 0.1) {
    return manifold(a, {}, b, {}, between, margin);
}

void expect_vector(Vec2 is, Vec2 should_be, double tolerance = 1e-15) {
    EXPECT_NEAR(is.x, should_be.x, tolerance);
    EXPECT_NEAR(is.y, should_be.y, tolerance);
}

/// The points are on the cores' rims, and the gap is what it is said to be.
void expect_consistent(const Manifold& m, const Convex& a, const Frame& fa, const Convex& b, const Frame& fb,
                       Vec2 between) {
    EXPECT_NEAR(length(m.normal), 1, 1e-15);
    for (int k = 0; k < m.count; ++k) {
        const ManifoldPoint& p = m.point[k];
        EXPECT_EQ(p.gap, dot(between + p.core_b - p.core_a, m.normal) - a.radius - b.radius);
        EXPECT_LT(brute_distance(corners_at(a, fa, {}), {p.core_a}), 1e-13);
        EXPECT_LT(brute_distance(corners_at(b, fb, {}), {p.core_b}), 1e-13);
    }
}

}  // namespace

TEST(Manifold, TwoBoxesThatOverlapATenthHaveTwoPoints) {
    const Manifold m = touch(box(1, 1), box(1, 1), {0.9, 0});
    expect_vector(m.normal, {1, 0});
    ASSERT_EQ(m.count, 2);
    for (const ManifoldPoint& p : m.point) {
        EXPECT_NEAR(p.gap, -0.1, 1e-15);
        EXPECT_NEAR(p.core_a.x, 0.5, 1e-15);
        EXPECT_NEAR(p.core_b.x, -0.5, 1e-15);
        EXPECT_NEAR(std::abs(p.core_a.y), 0.5, 1e-15);
    }
    EXPECT_NE(m.point[0].id, m.point[1].id);
}

TEST(Manifold, OfDiscsIsAlongTheLineOfCentres) {
    const Convex disc = pieces_of(Disc{{}, 0.5})[0];
    const Manifold m = touch(disc, disc, {0.6, 0.8}, 0.01);
    ASSERT_EQ(m.count, 1);
    expect_vector(m.normal, {0.6, 0.8});
    EXPECT_NEAR(m.point[0].gap, 0, 1e-15);
    EXPECT_EQ(touch(disc, disc, {0.6, 0.83}, 0.01).count, 0);
    EXPECT_EQ(touch(disc, disc, {}, 0.01).point[0].gap, -1);
}

TEST(Manifold, OfADiscKnowsFaceCornerAndInside) {
    const Convex disc = pieces_of(Disc{{}, 0.5})[0];
    const Convex square = box(2, 2);
    const Manifold face = touch(square, disc, {1.45, 0.3});
    ASSERT_EQ(face.count, 1);
    expect_vector(face.normal, {1, 0});
    expect_vector(face.point[0].core_a, {1, 0.3});
    EXPECT_NEAR(face.point[0].gap, -0.05, 1e-15);
    const Manifold corner = touch(square, disc, {1.3, 1.4});
    ASSERT_EQ(corner.count, 1);
    expect_vector(corner.normal, {0.6, 0.8});
    EXPECT_NEAR(corner.point[0].gap, 0, 1e-15);
    const Manifold inside = touch(square, disc, {-0.75, 0.5});
    ASSERT_EQ(inside.count, 1);
    expect_vector(inside.normal, {-1, 0});
    EXPECT_NEAR(inside.point[0].gap, -0.75, 1e-15);
}

TEST(Manifold, OfCapsulesKnowsParallelCrossedAndEndToEnd) {
    const Convex capsule = pieces_of(Capsule{{-1, 0}, {1, 0}, 0.25})[0];
    const Manifold parallel = touch(capsule, capsule, {0.5, 0.5});
    ASSERT_EQ(parallel.count, 2);
    expect_vector(parallel.normal, {0, 1});
    EXPECT_NEAR(std::abs(parallel.point[0].core_a.x - parallel.point[1].core_a.x), 1.5, 1e-15);
    const Frame upright = frame_at({}, std::acos(0.));
    const Manifold tip = manifold(capsule, {}, capsule, upright, {0.25, 1.45}, 0.1);
    ASSERT_EQ(tip.count, 1);
    expect_vector(tip.normal, {0, 1});
    EXPECT_NEAR(tip.point[0].gap, -0.05, 1e-15);
    const Manifold ends = touch(capsule, capsule, {2.4, 0});
    ASSERT_EQ(ends.count, 1);
    expect_vector(ends.normal, {1, 0});
    EXPECT_NEAR(ends.point[0].gap, -0.1, 1e-15);
    const Manifold crossed = manifold(capsule, {}, capsule, upright, {0.3, 0.1}, 0.1);
    ASSERT_GE(crossed.count, 1);
    EXPECT_NEAR(least_gap(crossed), -0.5 - 0.7, 1e-15);  // shortest out along the first one
}

TEST(Manifold, FarFromTheOriginHasTheSameBits) {
    const Convex a = box(1, 1), b = box(2, 1);
    const Frame here = frame_at({}, 0.1), there = frame_at({1e7, 1e7}, 0.1);
    const Manifold near = manifold(a, here, b, here, {1.4, 0.2}, 0.1);
    const Manifold away = manifold(a, there, b, there, {1.4, 0.2}, 0.1);
    ASSERT_EQ(near.count, 2);
    EXPECT_EQ(near.normal, away.normal);
    for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(near.point[k].gap, away.point[k].gap);
        EXPECT_EQ(near.point[k].core_b, away.point[k].core_b);
    }
}

TEST(Manifold, GapOfOutlinesApartIsTheirDistance) {
    Random random(1);
    int apart = 0, corners = 0, nearly_parallel = 0;
    for (int n = 0; n < trials(100000); ++n) {
        const Convex a = random_outline(random, 1), b = random_outline(random, n % 3 == 0 ? 0.1 : 1);
        const Frame fa = random_frame(random), fb = random_frame(random);
        const Vec2 between = random.uniform(0, 3) * random_frame(random).turn({1, 0});
        const auto p = corners_at(a, fa, {}), q = corners_at(b, fb, between);
        if (brute_separation(p, q, 24) <= 0) continue;  // surely apart
        ++apart;
        const Manifold m = manifold(a, fa, b, fb, between, far);
        const double gap = brute_distance(p, q) - a.radius - b.radius;
        if (m.count == 0) {  // corner on corner
            ++corners;
            continue;
        }
        // Edges within 0.8° of parallel count as parallel when it comes to which of them leads.
        ASSERT_NEAR(least_gap(m), gap, 1e-4 * brute_distance(p, q)) << n;
        nearly_parallel += std::abs(least_gap(m) - gap) > 1e-12;
        expect_consistent(m, a, fa, b, fb, between);
    }
    EXPECT_GT(apart, trials(10000));
    EXPECT_LT(corners, apart / 50);
    EXPECT_LT(nearly_parallel, apart / 500);
}

TEST(Manifold, DepthOfOutlinesThatOverlapIsTheShortestWayOut) {
    Random random(2);
    int overlapping = 0;
    for (int n = 0; n < 3000; ++n) {
        const Convex a = random_outline(random, 1), b = random_outline(random, 1);
        const Frame fa = random_frame(random), fb = random_frame(random);
        const Vec2 between = random.uniform(0, 1) * random_frame(random).turn({1, 0});
        const auto p = corners_at(a, fa, {}), q = corners_at(b, fb, between);
        const double separation = brute_separation(p, q);
        if (separation > -1e-2 || (a.count == 1 && b.count == 1)) continue;
        ++overlapping;
        const Manifold m = manifold(a, fa, b, fb, between, far);
        ASSERT_GT(m.count, 0) << n;
        EXPECT_NEAR(least_gap(m), separation - a.radius - b.radius, 1e-3) << n;  // as fine as the directions
        expect_consistent(m, a, fa, b, fb, between);
    }
    EXPECT_GT(overlapping, 1000);
}

TEST(Manifold, OfSwappedOutlinesIsFlipped) {
    Random random(3);
    int different = 0;
    for (int n = 0; n < 20000; ++n) {
        const Convex a = random_outline(random, 1), b = random_outline(random, 1);
        const Frame fa = random_frame(random), fb = random_frame(random);
        const Vec2 between = random.uniform(0, 2.5) * random_frame(random).turn({1, 0});
        const Manifold m = manifold(a, fa, b, fb, between, 0.1), f = manifold(b, fb, a, fa, -between, 0.1);
        ASSERT_EQ(m.count, f.count) << n;
        if (m.count == 0) continue;
        expect_vector(m.normal, -f.normal, 0.0142);  // 0.8°: of edges as parallel as that the first one leads
        EXPECT_NEAR(least_gap(m), least_gap(f), 1e-4) << n;
        different += length(m.normal + f.normal) > 1e-12;
    }
    EXPECT_LT(different, 100);
}

TEST(Manifold, ScalesWithAllLengths) {
    Random random(4);
    for (int n = 0; n < 20000; ++n) {
        const Convex a = random_outline(random, 1), b = random_outline(random, 1);
        const Frame fa = random_frame(random), fb = random_frame(random);
        const Vec2 between = random.uniform(0, 2.5) * random_frame(random).turn({1, 0});
        const Manifold m = manifold(a, fa, b, fb, between, 0.1);
        for (const double factor : {1024., 1. / 1024}) {
            const auto scaled = [&](Convex c) {
                for (Vec2& corner : c.corner) corner *= factor;
                c.centre *= factor, c.radius *= factor, c.width *= factor;
                return c;
            };
            const Manifold s = manifold(scaled(a), fa, scaled(b), fb, factor * between, factor * 0.1);
            ASSERT_EQ(s.count, m.count);
            ASSERT_EQ(s.normal, m.normal);
            for (int k = 0; k < m.count; ++k) {
                EXPECT_EQ(s.point[k].gap, factor * m.point[k].gap);
                EXPECT_EQ(s.point[k].core_a, factor * m.point[k].core_a);
                EXPECT_EQ(s.point[k].id, m.point[k].id);
            }
        }
    }
}

TEST(Manifold, SlidesOverTheSeamOfTwoBoxes) {
    // Two unit boxes side by side at x = ±0.5, tops at 0.5; a unit box slides over them, also turned by a quarter.
    for (const double sunk : {0., 1e-9, 1e-4, 1e-3, 3e-3})
        for (const double margin : {1e-3, 0.05, 1.})
            for (const bool upright : {false, true})
                for (const bool flipped : {false, true})
                    for (double x = -1.2; x < 1.2; x += 0.00037) {
                        int points = 0;
                        for (const double row : {-0.5, 0.5}) {
                            Vec2 between{x - row, 1 - sunk};
                            if (upright) between = perpendicular(between);
                            const Manifold m = touch(box(1, 1), box(1, 1), flipped ? -between : between, margin);
                            points += m.count;
                            if (m.count == 0) continue;
                            const Vec2 normal = flipped ? -m.normal : m.normal;
                            const Vec2 up = upright ? Vec2{-1, 0} : Vec2{0, 1};
                            ASSERT_NEAR(dot(normal, up), 1, 1e-6) << sunk << " " << margin << " " << x << " " << row;
                        }
                        ASSERT_GE(points, 2) << sunk << " " << margin << " " << x;
                    }
}

TEST(Manifold, RunsIntoAStep) {
    // The next box is 5 % higher.
    for (const double gap : {0.01, 0., -0.001, -0.01, -0.04}) {
        const Manifold m = touch(box(1, 1), box(1, 1), {1 + gap, 0.95});
        ASSERT_GE(m.count, 1) << gap;
        expect_vector(m.normal, {1, 0});
        EXPECT_NEAR(least_gap(m), gap, 1e-15);
    }
}

TEST(Manifold, WithAWallHasTheEndsOfTheEdgeThatFacesIt) {
    const Wall floor{{0, 1}, -1, 1, 0};
    const Convex b = pieces_of(Box{2, 1, {}, 0, 0.25})[0];
    const Manifold flat = manifold(floor, b, frame_at({3, -0.6}, 0), 0.1);
    ASSERT_EQ(flat.count, 2);
    expect_vector(flat.normal, {0, 1});
    for (const ManifoldPoint& p : flat.point) {
        EXPECT_NEAR(p.gap, -0.1, 1e-15);
        EXPECT_NEAR(p.core_b.y, -0.25, 1e-15);
        EXPECT_NEAR(p.core_a.y, -0.4, 1e-15);
    }
    EXPECT_EQ(manifold(floor, b, frame_at({3, -0.2}, 0.7), 0.01).count, 1);
    EXPECT_EQ(manifold(floor, b, frame_at({3, 0.5}, 0), 0.1).count, 0);
    EXPECT_EQ(manifold(floor, pieces_of(Disc{})[0], frame_at({0, -0.55}, 0), 0.1).count, 1);
    // A plank that comes down: of its four corners that at the far end is the highest but one, and the next to touch.
    const Convex plank = pieces_of(Box{2, 0.01})[0];
    const Manifold tilted = manifold(floor, plank, frame_at({0, -1 + std::sin(0.1)}, 0.1), 0.25);
    ASSERT_EQ(tilted.count, 2);
    for (const ManifoldPoint& p : tilted.point)
        EXPECT_NEAR(p.core_b.y, (p.core_b.x > 0 ? 1 : -1) * std::sin(0.1), 0.006);
}
