#include "collision/queries.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outlines.hpp"
#include "trials.hpp"

using namespace carom;
using namespace carom::test;

namespace {

void expect_hit(const std::optional<Meeting>& hit, double fraction, Vec2 point, Vec2 normal) {
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction, fraction, 1e-9);
    EXPECT_LT(length(hit->point - point), 1e-8);
    EXPECT_LT(length(hit->normal - normal), 1e-8);
}

std::optional<Meeting> ray(const Geometry& geometry, Vec2 origin, Vec2 way) {
    return ray_meets(pieces_of(geometry)[0], {}, origin, way);
}

/// Of a point; brute force.
double distance_to(const Convex& outline, Vec2 point) {
    bool inside = outline.count > 2;
    for (int i = 0; i < outline.count && inside; ++i) inside = dot(point - outline.corner[i], outline.normal[i]) < 0;
    return (inside ? -1 : 1) * brute_distance(corners_at(outline, {}, {}), {point}) - outline.radius;
}

Meeting meeting(const std::optional<Hit>& hit) {
    return hit ? Meeting{hit->point, hit->normal, hit->fraction} : Meeting{.fraction = -1};
}

/// Bodies of one shape each, or as many as are added before the next body.
struct Things {
    std::vector<Piece> pieces;
    std::vector<BodyId> ids;
    Motion motion;
    mutable Places places;

    void body(Vec2 position, double angle = 0) {
        ids.push_back({static_cast<std::uint32_t>(ids.size()), 1});
        motion.linear.push_back(position), motion.angular.push_back(angle);
        shapes_ = 0;
    }
    Piece& shape(const Geometry& geometry) {
        const std::size_t first = pieces.size();
        for (const Convex& outline : pieces_of(geometry))
            pieces.push_back({.outline = outline, .row = static_cast<std::uint32_t>(ids.size() - 1), .shape = shapes_});
        ++shapes_;
        return pieces[first];
    }
    PlacedPieces all() const {
        places.forget_from(0);
        places.follow(pieces, motion);
        return {pieces, ids, places};
    }

  private:
    std::uint32_t shapes_ = 0;
};

/// Things on a line: a disc at 2, a box at 4 that is a sensor, a wall at 6 of category 4, a box at 8.
struct Row : Things {
    Row() {
        body({8, 0}), shape(Box{});
        body({2, 0}), shape(Disc{});
        body({4, 0}), shape(Box{}).sensor = true;
        body({6, 0}), shape(Segment{{0, -1}, {0, 1}}).filter.category = 4;
    }
};

using Rows = std::vector<std::uint32_t>;
Rows rows_of(const std::vector<ShapeId>& shapes) {
    Rows rows;
    for (const ShapeId& shape : shapes) rows.push_back(shape.body.index);
    return rows;
}
Rows rows_of(const std::vector<Hit>& hits) {
    Rows rows;
    for (const Hit& hit : hits) rows.push_back(hit.body.index);
    return rows;
}

std::vector<Convex> one(const Geometry& geometry) { return pieces_of(geometry); }

/// A U, open at the top, of several pieces.
const Polygon u{{{-2, 0}, {2, 0}, {2, 3}, {1, 3}, {1, 1}, {-1, 1}, {-1, 3}, {-2, 3}}};

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
    for (int n = 0; n < trials(20000); ++n) {
        const Convex outline = random_outline(random, 1);
        if (outline.radius == 0 && outline.count < 3) continue;
        const Vec2 origin = random.uniform(0, 3) * random_frame(random).turn({1, 0});
        const Vec2 way = random.uniform(0, 4) * random_frame(random).turn({1, 0});
        const auto hit = ray_meets(outline, {}, origin, way);
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
    EXPECT_GT(hits, trials(1500));
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
                    ASSERT_TRUE(ray_meets(outline, {}, origin, 2 * (inner - origin))) << corners << " " << n;
                    ASSERT_TRUE(ray_meets(outline, {}, origin, -2 * origin));
                }
            for (const Vec2 corner : hull.points) ASSERT_TRUE(ray_meets(outline, {}, 2 * corner, -2 * corner));
        }
}

TEST(Ray, OfFarAwayKeepsItsDigits) {
    const auto hit = ray_meets(pieces_of(Disc{})[0], frame_at({1e6, 1e6}, 1), {0, 1e6 + 0.3}, {2e6, 0});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->point.x, 1e6 - 0.4, 1e-9);
    EXPECT_NEAR(hit->normal.x, -0.8, 1e-9);
}

TEST(Queries, OfARayKnowOrderAndFilters) {
    const Row row;
    EXPECT_EQ(rows_of(all_hits(row.all(), {0, 0}, {10, 0})), (Rows{1, 3, 0}));
    EXPECT_EQ(rows_of(all_hits(row.all(), {0, 0}, {10, 0}, {.sensors = true})), (Rows{1, 2, 3, 0}));
    EXPECT_EQ(rows_of(all_hits(row.all(), {0, 0}, {10, 0}, {.except = row.ids[3]})), (Rows{1, 0}));
    expect_hit(meeting(first_hit(row.all(), {0, 0}, {10, 0})), 0.15, {1.5, 0}, {-1, 0});
    EXPECT_EQ(first_hit(row.all(), {0, 0}, {10, 0}, {.filter = Filter{.mask = 4}})->body.index, 3u);
    EXPECT_EQ(first_hit(row.all(), {10, 0}, {-10, 0})->body.index, 0u);
    EXPECT_FALSE(first_hit(row.all(), {0, 2}, {10, 0}));
}

TEST(Queries, FindWhatAShapeOfTheirFilterWouldMeet) {
    Row row;
    row.pieces[0].filter = {.mask = 2};  // the box at 8 meets category 2 alone
    row.pieces[1].filter = {.group = -7};
    EXPECT_EQ(rows_of(all_hits(row.all(), {0, 0}, {10, 0})), (Rows{1, 3, 0}));
    EXPECT_EQ(rows_of(all_hits(row.all(), {0, 0}, {10, 0}, {.filter = Filter{}})), (Rows{1, 3}));
    EXPECT_EQ(rows_of(all_hits(row.all(), {0, 0}, {10, 0}, {.filter = Filter{.category = 2}})), (Rows{1, 3, 0}));
    EXPECT_EQ(rows_of(all_hits(row.all(), {0, 0}, {10, 0}, {.filter = Filter{.group = -7}})), (Rows{3}));
}

TEST(Queries, SeeAConcaveShapeAsOne) {
    Things bodies;
    bodies.body({0, 0}), bodies.shape(u);
    bodies.shape(Disc{{0, 2}, 0.5});
    ASSERT_GT(bodies.pieces.size(), 3u);
    // Through both arms and the disc between them: each shape once.
    const auto hits = all_hits(bodies.all(), {-3, 2}, {6, 0});
    ASSERT_EQ(hits.size(), 2u);
    expect_hit(meeting(hits[0]), 1 / 6., {-2, 2}, {-1, 0});
    EXPECT_EQ(hits[1].shape, 1u);
    // From inside: through no seam.
    for (const Vec2 way : {Vec2{4, 0}, Vec2{-4, 0}, Vec2{4, -0.4}, Vec2{0, 3}, Vec2{1.9, 2}})
        for (const Vec2 origin : {Vec2{-1.7, 0.3}, Vec2{0.2, 0.6}, Vec2{1.6, 0.9}, Vec2{1.4, 2.5}}) {
            const auto hit = first_hit(bodies.all(), origin, way);
            EXPECT_TRUE(!hit || hit->shape == 1) << origin.x << " " << way.x;
        }
    EXPECT_EQ(overlapping(bodies.all(), Aabb{{-3, 0}, {3, 4}}).size(), 2u);
}

TEST(Queries, OfAMovingOutline) {
    const Row row;
    const auto box = one(Box{});
    const auto hit = first_hit(row.all(), box, frame_at({0, 0}, 0), {10, 0});
    expect_hit(meeting(hit), 0.1, {1.5, 0}, {-1, 0});
    EXPECT_EQ(hit->body.index, 1u);
    EXPECT_EQ(first_hit(row.all(), box, frame_at({4, 0}, 0.3), {10, 0})->body.index, 3u);
    EXPECT_EQ(first_hit(row.all(), box, frame_at({8.2, 0.1}, 0.3), {10, 0})->fraction, 0);
    EXPECT_FALSE(first_hit(row.all(), box, frame_at({0, 1.8}, 0), {10, 0}));
    // A disc past the end of the wall, by its rim.
    const auto disc = one(Disc{});
    expect_hit(meeting(first_hit(row.all(), disc, frame_at({4, 1.3}, 0), {4, 0})), 0.4, {6, 1}, {-0.8, 0.6});
    // The U comes down over the disc, which meets its inside.
    expect_hit(meeting(first_hit(row.all(), one(u), frame_at({2, 6.5}, 3.14159265358979324), {0, -8})), 0.625, {2, 0.5},
               {0, 1});
}

TEST(Queries, OfWhatOverlaps) {
    const Row row;
    EXPECT_EQ(rows_of(overlapping(row.all(), Vec2{2.3, 0.3})), Rows{1});
    EXPECT_EQ(rows_of(overlapping(row.all(), Vec2{2.4, 0.4})), Rows{});
    EXPECT_EQ(rows_of(overlapping(row.all(), Vec2{8.4, 0.4})), Rows{0});
    EXPECT_EQ(rows_of(overlapping(row.all(), Aabb{{2.4, 0.2}, {7, 1}})), (Rows{1, 3}));
    EXPECT_EQ(rows_of(overlapping(row.all(), Aabb{{2.4, 0.4}, {5.9, 1}})), Rows{});
    EXPECT_EQ(rows_of(overlapping(row.all(), Aabb{{2.4, 0.4}, {5.9, 1}}, {.sensors = true})), Rows{2});
    EXPECT_EQ(rows_of(overlapping(row.all(), one(Capsule{{6.4, 0}, {7.2, 0}, 0.35}), {})), Rows{0});
    EXPECT_EQ(rows_of(overlapping(row.all(), one(Capsule{{6.4, 0}, {7.2, 0}, 0.45}), {})), (Rows{0, 3}));
    EXPECT_EQ(rows_of(overlapping(row.all(), one(Segment{{5, -0.5}, {7, 0.4}}), {})), Rows{3});  // crosswise
}

TEST(Queries, OfClosestPointsOfBodies) {
    Things bodies;
    bodies.body({0, 0}), bodies.shape(u);
    bodies.body({0, 4}), bodies.shape(Disc{{3, 0}, 0.5}), bodies.shape(Disc{{0, -1.5}, 0.5}).sensor = true;
    bodies.shape(Disc{{0, -1}, 0.5});
    const auto near = closest_points(bodies.all(), 1, 0);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->shape_a, 2u);
    EXPECT_NEAR(near->distance, 0.5, 1e-15);
    const auto sensor = closest_points(bodies.all(), 0, 1, {.sensors = true});
    EXPECT_EQ(sensor->shape_b, 1u);
    EXPECT_NEAR(sensor->distance, 0.5, 1e-15);
    EXPECT_FALSE(closest_points(bodies.all(), 0, 1, {.filter = Filter{.mask = 8}}));
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
