// What is met where a ray or an outline leaves the room between walls: closed forms, and brute force.
#include "collision/room.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outlines.hpp"

using namespace carom;
using namespace carom::test;

namespace {

void expect_wall(const std::optional<Hit>& hit, std::uint32_t number, double fraction, Vec2 point, Vec2 normal) {
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->at_wall());
    EXPECT_EQ(hit->shape, number);
    EXPECT_NEAR(hit->fraction, fraction, 1e-14);
    EXPECT_LT(length(hit->point - point), 1e-14);
    EXPECT_LT(length(hit->normal - normal), 1e-14);
}

Walls room(std::vector<Rectangle> rectangles, std::vector<HalfPlane> planes = {}, std::vector<Stadium> stadiums = {}) {
    return {rectangles, planes, stadiums, {}};
}

/// How deep a point is in any of the walls; less than 0 in the room.
double depth_of(const Walls& walls, Vec2 p) {
    double depth = -HUGE_VAL;
    for (const Wall& wall : walls.all) depth = std::max(depth, wall.offset - dot(wall.normal, p));
    for (const Stadium& s : walls.round) depth = std::max(depth, distance_to_line(p, s.a, s.b) - s.radius);
    return depth;
}
double depth_of(const Walls& walls, std::span<const Convex> outlines, const Frame& at) {
    double depth = -HUGE_VAL;
    for (const Convex& outline : outlines)
        for (int i = 0; i < outline.count; ++i)
            depth = std::max(depth, depth_of(walls, at.position + at.turn(outline.corner[i])) + outline.radius);
    return depth;
}

/// Four walls, a ramp across a corner of theirs and a round one, in which (0, 0) is.
Walls random_room(Random& random) {
    const auto some = [&](double from, double to) { return random.uniform(from, to); };
    const double turn = some(0, 6);
    const Vec2 out{std::cos(turn), std::sin(turn)};
    Stadium round{.a = {some(-3, 0), some(-2, 2)}, .b = {some(0, 3), some(-2, 2)}, .radius = some(2, 4)};
    if (random.uniform() < 0.3) round.b = round.a;
    if (length(round.a) > 1.5) round.radius += 3;
    return room({{.low = {some(-6, -1), some(-6, -1)}, .high = {some(1, 6), some(1, 6)}}},
                {{.point = some(1, 5) * out, .normal = -2 * out}}, {round});
}

}  // namespace

TEST(Room, ARayMeetsEachSideOfARectangleFromInside) {
    const Walls walls = room({{.low = {-1, -2}, .high = {3, 4}}});
    expect_wall(wall_hit(walls, {0, 0}, {-2, 0}), 0, 0.5, {-1, 0}, {1, 0});
    expect_wall(wall_hit(walls, {0, 0}, {6, 2}), 1, 0.5, {3, 1}, {-1, 0});
    expect_wall(wall_hit(walls, {0, 0}, {1, -8}), 2, 0.25, {0.25, -2}, {0, 1});
    expect_wall(wall_hit(walls, {0, 0}, {0, 4}), 3, 1, {0, 4}, {0, -1});
    EXPECT_FALSE(wall_hit(walls, {0, 0}, {0, 3.9}));
}

TEST(Room, ARayFromOutsideMeetsWhatIsBehindTheRoom) {
    const Walls walls = room({{.low = {-1, -2}, .high = {3, 4}}});
    expect_wall(wall_hit(walls, {-5, 0}, {16, 0}), 1, 0.5, {3, 0}, {-1, 0});
    EXPECT_FALSE(wall_hit(walls, {-5, 0}, {-16, 0}));
    EXPECT_FALSE(wall_hit(walls, {-5, 0}, {3, -16}));  // it passes the level of the bottom, beside the room
    EXPECT_FALSE(wall_hit(walls, {-5, 0}, {0, -16}));
}

TEST(Room, ARayMeetsAHalfPlaneFromInFrontAlone) {
    const Walls walls = room({{.low = {-9, -9}, .high = {9, 9}}}, {{.point = {0, 1}, .normal = {0, 5}}});
    expect_wall(wall_hit(walls, {2, 3}, {4, -4}), 4, 0.5, {4, 1}, {0, 1});
    expect_wall(wall_hit(walls, {2, -3}, {0, 16}), 3, 0.75, {2, 9}, {0, -1});
    EXPECT_FALSE(wall_hit(walls, {2, -3}, {0, -16}));
    EXPECT_FALSE(wall_hit({}, {2, -3}, {0, -16}));
}

TEST(Room, ARayMeetsTheSidesAndTheEndsOfAStadium) {
    const Walls walls = room({}, {{.point = {0, -9}}}, {{.a = {-2, 1}, .b = {2, 1}, .radius = 1}});
    expect_wall(wall_hit(walls, {1, 1}, {0, 4}), 1, 0.25, {1, 2}, {0, -1});
    expect_wall(wall_hit(walls, {1, 1}, {2, -2}), 1, 0.5, {2, 0}, {0, 1});
    expect_wall(wall_hit(walls, {-1, 1}, {16, 0}), 1, 0.25, {3, 1}, {-1, 0});
    expect_wall(wall_hit(walls, {2, 1}, {1.2, 1.6}), 1, 0.5, {2.6, 1.8}, {-0.6, -0.8});
    expect_wall(wall_hit(walls, {-5, 1}, {16, 0}), 1, 0.5, {3, 1}, {-1, 0});  // in and out again
    EXPECT_FALSE(wall_hit(walls, {-5, 1}, {-16, 0}));
    EXPECT_FALSE(wall_hit(walls, {0, 1}, {2.9, 0}));
    const Walls circle = room({}, {}, {{.a = {1, 1}, .b = {1, 1}, .radius = 5}});
    expect_wall(wall_hit(circle, {1, 4}, {8, 0}), 0, 0.5, {5, 4}, {-0.8, -0.6});
}

TEST(Room, ARayIsInFrontOfAllWallsUpToTheOneThatItMeets) {
    Random random(1);
    int met = 0;
    for (int n = 0; n < 2000; ++n) {
        const Walls walls = random_room(random);
        const Vec2 from{random.uniform(-1, 1), random.uniform(-1, 1)},
            way{random.uniform(-6, 6), random.uniform(-6, 6)};
        if (depth_of(walls, from) >= 0) continue;
        const auto hit = wall_hit(walls, from, way);
        ASSERT_EQ(hit.has_value(), depth_of(walls, from + way) > 0);
        const double end = hit ? hit->fraction : 1;
        for (int k = 0; k < 20; ++k) EXPECT_LT(depth_of(walls, from + (k / 20. * end) * way), 0);
        if (!hit) continue;
        ++met;
        EXPECT_NEAR(depth_of(walls, from + end * way), 0, 1e-14);
        EXPECT_LT(length(hit->point - (from + end * way)), 1e-13);
        EXPECT_LT(dot(hit->normal, way), 0);
        EXPECT_NEAR(length(hit->normal), 1, 1e-15);
    }
    EXPECT_GT(met, 500);
}

TEST(Room, AMovedOutlineIsInFrontOfAllWallsUpToTheOneThatItMeets) {
    const Geometry shapes[] = {Disc{{0.1, 0}, 0.3}, Capsule{{-0.3, 0}, {0.3, 0.1}, 0.1}, Box{0.8, 0.5, {}, 0.3, 0.05},
                               Segment{{-0.4, 0}, {0.4, 0}}, Polygon{{{-0.4, 0}, {0, 0.1}, {0.4, 0}, {0, 0.6}}}};
    Random random(2);
    int met = 0;
    for (int n = 0; n < 2000; ++n) {
        const Walls walls = random_room(random);
        const auto outlines = pieces_of(shapes[n % 5]);
        const Vec2 place{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
        const Frame from = frame_at(place, random.uniform(-3, 3));
        const Vec2 way{random.uniform(-6, 6), random.uniform(-6, 6)};
        const auto at = [&](double part) { return Frame{from.position + part * way, from.cosine, from.sine}; };
        const auto hit = wall_hit(walls, outlines, from, way);
        if (depth_of(walls, outlines, from) >= 0) {
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->fraction, 0);
            continue;
        }
        ASSERT_EQ(hit.has_value(), depth_of(walls, outlines, at(1)) > 0);
        const double end = hit ? hit->fraction : 1;
        for (int k = 0; k < 20; ++k) EXPECT_LT(depth_of(walls, outlines, at(k / 20. * end)), 0);
        if (!hit) continue;
        ++met;
        EXPECT_NEAR(depth_of(walls, outlines, at(end)), 0, 1e-14);
        EXPECT_NEAR(depth_of(walls, hit->point), 0, 1e-14);
        EXPECT_LT(dot(hit->normal, way), 0);
    }
    EXPECT_GT(met, 500);
}

TEST(Room, AnOutlineThatBeginsInWallsMeetsTheOneItIsInDeepest) {
    const Walls walls = room({{.low = {0, 0}, .high = {4, 4}}}, {}, {{.a = {2, 2}, .b = {2, 2}, .radius = 5}});
    const auto disc = pieces_of(Disc{.radius = 1}), large = pieces_of(Disc{.radius = 7});
    expect_wall(wall_hit(walls, disc, {{0.5, 3.2}}, {1, 0}), 0, 0, {0, 3.2}, {1, 0});
    expect_wall(wall_hit(walls, disc, {{0.9, 3.2}}, {}), 3, 0, {0.9, 4}, {0, -1});
    expect_wall(wall_hit(walls, disc, {{1, 2}}, {-1, 0}), 0, 0, {0, 2}, {1, 0});  // it touches
    EXPECT_FALSE(wall_hit(walls, disc, {{1, 2}}, {1, 0}));
    EXPECT_FALSE(wall_hit(walls, disc, {{1, 2}}, {0, 0.5}));
    EXPECT_FALSE(wall_hit(walls, disc, {{1, 2}}, {}));
    EXPECT_FALSE(wall_hit(walls, disc, {{2, 2}}, {}));
    const Walls circle = room({}, {}, {{.a = {2, 2}, .b = {2, 2}, .radius = 5}});
    expect_wall(wall_hit(circle, large, {{2, 2}}, {1, 0}), 0, 0, {2, -3}, {0, 1});
    expect_wall(wall_hit(circle, disc, {{2, 2}}, {8, 0}), 0, 0.5, {7, 2}, {-1, 0});
    const Walls stadium = room({}, {}, {{.a = {-2, 0}, .b = {2, 0}, .radius = 0.5}});
    expect_wall(wall_hit(stadium, disc, {{1, 0}}, {1, 0}), 0, 0, {1, -0.5}, {0, 1});
}

/// In front of the wall by rounding alone, or behind it.
TEST(Room, WhoTouchesARoundWallDoesNotSlipThroughIt) {
    Random random(3);
    const auto disc = pieces_of(Disc{.radius = 0.3});
    for (int n = 0; n < 2000; ++n) {
        const Walls walls = room({}, {}, {{.a = {-2, 0.1}, .b = {2, n % 2 ? 0.1 : 0.7}, .radius = 1.1}});
        const Stadium& wall = walls.round[0];
        const double turn = random.uniform(-1.5, 1.5);
        const Vec2 out = frame_at({}, turn).turn({1, 0}),
                   side = perpendicular(wall.b - wall.a) / length(wall.b - wall.a);
        const Vec2 at_end = wall.b + 0.8 * out, at_side = 0.3 * wall.a + 0.7 * wall.b + 0.8 * side;
        EXPECT_TRUE(wall_hit(walls, disc, {at_end}, random.uniform(0.1, 9) * out));
        EXPECT_TRUE(wall_hit(walls, disc, {at_end}, 9 * perpendicular(out)));
        EXPECT_TRUE(wall_hit(walls, disc, {at_side}, 9 * side));
        EXPECT_TRUE(wall_hit(walls, disc, {at_side}, 9 * perpendicular(side)));
    }
}
