#include "collision/queries.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outlines.hpp"

using namespace carom;
using namespace carom::test;

namespace {

void expect_hit(const std::optional<PieceHit>& hit, double fraction, Vec2 point, Vec2 normal) {
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction, fraction, 1e-9);
    EXPECT_LT(length(hit->point - point), 1e-8);
    EXPECT_LT(length(hit->normal - normal), 1e-8);
}

std::optional<PieceHit> ray(const Geometry& geometry, Vec2 origin, Vec2 way) {
    return ray_hit(pieces_of(geometry)[0], {}, origin, way);
}

/// Of a point; brute force.
double distance_to(const Convex& outline, Vec2 point) {
    bool inside = outline.count > 2;
    for (int i = 0; i < outline.count && inside; ++i) inside = dot(point - outline.corner[i], outline.normal[i]) < 0;
    return (inside ? -1 : 1) * brute_distance(corners_at(outline, {}, {}), {point}) - outline.radius;
}

/// Things on a line: a disc at 2, a box at 4 that is a sensor, a wall at 6 of category 4, a box at 8.
struct Row {
    std::vector<Piece> pieces;
    std::vector<PlacedPiece> placed;

    Row() {
        const auto add = [&](const Geometry& geometry) -> Piece& {
            pieces.push_back({.outline = pieces_of(geometry)[0]});
            return pieces.back();
        };
        add(Box{});
        add(Disc{});
        add(Box{}).sensor = true;
        add(Segment{{0, -1}, {0, 1}}).filter.category = 4;
        const double x[] = {8, 2, 4, 6};
        for (std::size_t k = 0; k < pieces.size(); ++k) placed.push_back({&pieces[k], frame_at({x[k], 0}, 0)});
    }
};

}  // namespace

TEST(Ray, MeetsWhatIsFirst) {
    expect_hit(ray(Disc{{3, 0}, 1}, {0, 0}, {4, 0}), 0.5, {2, 0}, {-1, 0});
    expect_hit(ray(Disc{{3, 0}, 1}, {3, 5}, {0, -8}), 0.5, {3, 1}, {0, 1});
    expect_hit(ray(Box{2, 2}, {-3, 0.5}, {4, 0}), 0.5, {-1, 0.5}, {-1, 0});
    expect_hit(ray(Box{2, 2, {}, 0, 0.5}, {-3, 0.25}, {4, 0}), 0.5, {-1, 0.25}, {-1, 0});
    const double r = std::sqrt(0.5);
    expect_hit(ray(Box{2, 2, {}, 0, 0.5}, {3, 3}, {-4, -4}), (2.5 - r / 2) / 4, {0.5 + r / 2, 0.5 + r / 2}, {r, r});
    expect_hit(ray(Capsule{{0, -1}, {0, 1}, 0.5}, {2, 0}, {-3, 0}), 0.5, {0.5, 0}, {1, 0});
    expect_hit(ray(Segment{{0, -1}, {0, 1}}, {2, 0}, {-4, 0}), 0.5, {0, 0}, {1, 0});
    expect_hit(ray(Segment{{0, -1}, {0, 1}}, {-2, 0}, {4, 0}), 0.5, {0, 0}, {-1, 0});
    expect_hit(ray(Box{2, 2}, {-3, 0}, {2, 0}), 1, {-1, 0}, {-1, 0});  // the very end of the ray
}

TEST(Ray, MissesWhatIsBesideOrBehindOrAround) {
    EXPECT_FALSE(ray(Disc{{3, 0}, 1}, {0, 0}, {1.9, 0}));
    EXPECT_FALSE(ray(Disc{{3, 0}, 1}, {0, 0}, {-4, 0}));
    EXPECT_FALSE(ray(Disc{{3, 0}, 1}, {0, 1.1}, {8, 0}));
    EXPECT_FALSE(ray(Box{2, 2}, {0.1, 0.2}, {5, 1}));
    EXPECT_FALSE(ray(Box{2, 2, {}, 0, 0.3}, {0.1, 0.2}, {5, 1}));
    EXPECT_FALSE(ray(Disc{}, {0.1, 0.2}, {5, 1}));
    EXPECT_FALSE(ray(Box{2, 2}, {-3, 0}, {0, 0}));
    EXPECT_FALSE(ray(Box{2, 2}, {-3, 1.5}, {10, 0}));
    EXPECT_FALSE(ray(Segment{{0, -1}, {0, 1}}, {-2, 1.1}, {4, 0}));
    // A chain from its left, which is above, alone.
    const Chain ground{{{-1, 0}, {1, 0}}};
    expect_hit(ray(ground, {0, 1}, {0, -2}), 0.5, {0, 0}, {0, 1});
    EXPECT_FALSE(ray(ground, {0, -1}, {0, 2}));
}

TEST(Ray, AgreesWithWalkingAlongIt) {
    Random random(1);
    int hits = 0;
    for (int n = 0; n < 20000; ++n) {
        const Convex outline = random_outline(random, 1);
        if (outline.radius == 0 && outline.count < 3) continue;
        const Vec2 origin = random.uniform(0, 3) * random_frame(random).turn({1, 0});
        const Vec2 way = random.uniform(0, 4) * random_frame(random).turn({1, 0});
        const auto hit = ray_hit(outline, {}, origin, way);
        const bool inside = distance_to(outline, origin) < 0;
        if (hit) {
            ++hits;
            EXPECT_FALSE(inside) << n;
            EXPECT_NEAR(distance_to(outline, hit->point), 0, 1e-12) << n;
            EXPECT_LT(dot(hit->normal, way), 0);
            EXPECT_GT(distance_to(outline, hit->point + 1e-6 * hit->normal), 0.99e-6) << n;
        }
        for (int k = 0; k < 50 && !inside; ++k) {
            const double part = (hit ? hit->fraction : 1) * k / 50;
            EXPECT_GT(distance_to(outline, origin + part * way), -1e-9) << n;
        }
    }
    EXPECT_GT(hits, 1500);
}

TEST(Ray, DoesNotSlipThroughCorners) {
    for (int corners = 3; corners <= 8; ++corners)
        for (const double rounding : {0., 0.1}) {
            Hull hull{{}, rounding};
            for (int i = 0; i < corners; ++i)
                hull.points.push_back(frame_at({}, 6.2831853071795864 * i / corners).turn({1, 0}));
            const Convex outline = pieces_of(hull)[0];
            Random random(1);
            for (int n = 0; n < 2000; ++n)
                for (const Vec2 corner : hull.points) {
                    const Vec2 origin = random.uniform(2, 3) * random_frame(random).turn({1, 0});
                    const Vec2 inner = 0.999999 * corner;  // seen past the corner itself, or the edge beside it
                    ASSERT_TRUE(ray_hit(outline, {}, origin, 2 * (inner - origin))) << corners << " " << n;
                    ASSERT_TRUE(ray_hit(outline, {}, origin, -2 * origin));
                }
            for (const Vec2 corner : hull.points) ASSERT_TRUE(ray_hit(outline, {}, 2 * corner, -2 * corner));
        }
}

TEST(Ray, OfFarAwayKeepsItsDigits) {
    const auto hit = ray_hit(pieces_of(Disc{})[0], frame_at({1e6, 1e6}, 1), {0, 1e6 + 0.3}, {2e6, 0});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->point.x, 1e6 - 0.4, 1e-9);
    EXPECT_NEAR(hit->normal.x, -0.8, 1e-9);
}

TEST(Queries, OfARayKnowOrderAndFilters) {
    const Row row;
    const auto hits = all_hits(row.placed, {0, 0}, {10, 0});
    ASSERT_EQ(hits.size(), 3u);
    EXPECT_EQ(hits[0].index, 1u);
    EXPECT_EQ(hits[1].index, 3u);
    EXPECT_EQ(hits[2].index, 0u);
    EXPECT_EQ(all_hits(row.placed, {0, 0}, {10, 0}, {.sensors = true}).size(), 4u);
    expect_hit(first_hit(row.placed, {0, 0}, {10, 0}), 0.15, {1.5, 0}, {-1, 0});
    EXPECT_EQ(first_hit(row.placed, {0, 0}, {10, 0}, {.categories = 4})->index, 3u);
    EXPECT_EQ(first_hit(row.placed, {10, 0}, {-10, 0})->index, 0u);
    EXPECT_FALSE(first_hit(row.placed, {0, 2}, {10, 0}));
}

TEST(Queries, OfAMovingOutline) {
    const Row row;
    const Convex box = pieces_of(Box{})[0];
    const auto hit = first_hit(row.placed, box, frame_at({0, 0}, 0), {10, 0});
    expect_hit(hit, 0.1, {1.5, 0}, {-1, 0});
    EXPECT_EQ(hit->index, 1u);
    EXPECT_EQ(first_hit(row.placed, box, frame_at({4, 0}, 0.3), {10, 0})->index, 3u);
    EXPECT_EQ(first_hit(row.placed, box, frame_at({8.2, 0.1}, 0.3), {10, 0})->fraction, 0);
    EXPECT_FALSE(first_hit(row.placed, box, frame_at({0, 1.8}, 0), {10, 0}));
    // A disc past the end of the wall, by its rim.
    const Convex disc = pieces_of(Disc{})[0];
    expect_hit(first_hit(row.placed, disc, frame_at({4, 1.3}, 0), {4, 0}), 0.4, {6, 1}, {-0.8, 0.6});
}

TEST(Queries, OfWhatOverlaps) {
    const Row row;
    using Found = std::vector<std::size_t>;
    EXPECT_EQ(overlapping(row.placed, Vec2{2.3, 0.3}), Found{1});
    EXPECT_EQ(overlapping(row.placed, Vec2{2.4, 0.4}), Found{});
    EXPECT_EQ(overlapping(row.placed, Vec2{8.4, 0.4}), Found{0});
    EXPECT_EQ(overlapping(row.placed, Aabb{{2.4, 0.2}, {7, 1}}), (Found{1, 3}));
    EXPECT_EQ(overlapping(row.placed, Aabb{{2.4, 0.4}, {5.9, 1}}), Found{});
    EXPECT_EQ(overlapping(row.placed, Aabb{{2.4, 0.4}, {5.9, 1}}, {.sensors = true}), Found{2});
    EXPECT_EQ(overlapping(row.placed, pieces_of(Capsule{{6.4, 0}, {7.2, 0}, 0.35})[0], frame_at({0, 0}, 0)), Found{0});
    EXPECT_EQ(overlapping(row.placed, pieces_of(Capsule{{6.4, 0}, {7.2, 0}, 0.45})[0], {}), (Found{0, 3}));
    EXPECT_EQ(overlapping(row.placed, pieces_of(Segment{{5, -0.5}, {7, 0.4}})[0], {}), Found{3});  // crosswise
}

TEST(Queries, OfClosestPoints) {
    const Convex box = pieces_of(Box{})[0], disc = pieces_of(Disc{})[0];
    const ClosestPoints near = closest_points(box, frame_at({1, 0}, 0), disc, frame_at({3, 0.2}, 2));
    EXPECT_NEAR(near.distance, 1, 1e-15);
    EXPECT_LT(length(near.on_a - Vec2{1.5, 0.2}), 1e-15);
    EXPECT_LT(length(near.on_b - Vec2{2.5, 0.2}), 1e-15);
    EXPECT_NEAR(closest_points(box, {}, disc, frame_at({0.7, 0.1}, 0)).distance, -0.3, 1e-15);
    // A thin plank and a point just off its end, where GJK is known to fail.
    const Convex plank = pieces_of(Box{1, 0.0016})[0], point = convex(std::vector<Vec2>{{}}, 0);
    EXPECT_NEAR(closest_points(plank, {}, point, frame_at({0.505, 0}, 0)).distance, 0.005, 1e-15);
    Random random(1);
    for (int n = 0; n < 20000; ++n) {
        const Convex a = random_outline(random, 1), b = random_outline(random, 1);
        const Frame fa = frame_at({1, 2}, random.uniform(-4, 4)), fb = frame_at({4, random.uniform(0, 4)}, 1);
        const auto p = corners_at(a, fa, fa.position), q = corners_at(b, fb, fb.position);
        if (brute_separation(p, q, 24) <= 0) continue;
        const ClosestPoints found = closest_points(a, fa, b, fb);
        ASSERT_NEAR(found.distance, brute_distance(p, q) - a.radius - b.radius, 1e-14) << n;
        EXPECT_NEAR(length(found.on_b - found.on_a), std::abs(found.distance), 1e-14) << n;
    }
}
