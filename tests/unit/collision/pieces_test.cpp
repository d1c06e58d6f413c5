#include <gtest/gtest.h>

#include <cmath>

#include "collision/polygons.hpp"
#include "error_of.hpp"
#include "outlines.hpp"

using namespace carom;
using namespace carom::test;

namespace {

double area_of(const Convex& piece) { return doubled_area({piece.corner, piece.corner + piece.count}) / 2; }

void expect_well_formed(const Convex& piece) {
    EXPECT_LE(piece.count, Convex::most_corners);
    for (int i = 0; i < piece.count; ++i) {
        const Vec2 edge = piece.corner[(i + 1) % piece.count] - piece.corner[i];
        EXPECT_NEAR(length(piece.normal[i]), 1, 1e-15);
        EXPECT_NEAR(dot(piece.normal[i], edge), 0, 1e-13);
        if (piece.count == 2) continue;
        for (int j = 0; j < piece.count; ++j) EXPECT_LE(dot(piece.corner[j] - piece.corner[i], piece.normal[i]), 1e-13);
    }
}

/// The areas add up, and so nothing overlaps if nothing sticks out.
std::vector<Convex> expect_split(const Geometry& geometry, double area) {
    const std::vector<Convex> pieces = pieces_of(geometry);
    double sum = 0;
    for (const Convex& piece : pieces) expect_well_formed(piece), sum += area_of(piece);
    EXPECT_NEAR(sum, area, 1e-13 * area);
    return pieces;
}

Polygon star(int points, double inner) {
    Polygon polygon;
    for (int i = 0; i < 2 * points; ++i)
        polygon.points.push_back((i % 2 ? inner : 1) * frame_at({}, 3.14159265358979 * i / points).turn({1, 0}));
    return polygon;
}

}  // namespace

TEST(Pieces, OfABoxKeepItsSizeWhenRounded) {
    const Convex piece = pieces_of(Box{3, 2, {1, 1}, 0, 0.5})[0];
    EXPECT_EQ(piece.count, 4);
    const Aabb box = bounds(piece, {});
    EXPECT_EQ(box.low, (Vec2{-0.5, 0}));
    EXPECT_EQ(box.high, (Vec2{2.5, 2}));
    EXPECT_EQ(piece.width, 1);
    EXPECT_EQ(pieces_of(Box{3, 2, {}, 0, 1})[0].count, 2);
    EXPECT_EQ(pieces_of(Box{2, 2, {}, 0, 1})[0].count, 1);
    EXPECT_EQ(error_of([] {
                  pieces_of(Box{3, 2, {}, 0, 1.5});
              }),
              "Box.rounding must be at most half the shorter side, 1 m, got 1.5 m");
}

TEST(Pieces, OfHullsLeaveOutWhatIsInsideOrOnAnEdge) {
    const Hull hull{{{0, 0}, {2, 0}, {1, 0}, {1, 1}, {2, 2}, {0, 2}, {0, 1}, {0, 0}, {0.3, 0.4}}};
    EXPECT_EQ(expect_split(hull, 4)[0].count, 4);
    EXPECT_EQ(error_of([] {
                  pieces_of(Hull{{{0, 0}, {1, 1}, {2, 2}, {1, 1}}});
              }),
              "Hull.points must be at least 3 that do not lie in a line");
}

TEST(Pieces, OfManyCornersShareEdges) {
    for (const int n : {8, 9, 14, 15, 40}) {
        Hull hull;
        for (int i = 0; i < n; ++i) hull.points.push_back(frame_at({}, 6.2831853071795864 * i / n).turn({1, 0}));
        const auto pieces = expect_split(hull, n / 2. * std::sin(6.2831853071795864 / n));
        EXPECT_EQ(pieces.size() == 1, n <= 8);
        EXPECT_EQ(expect_split(Polygon{hull.points}, n / 2. * std::sin(6.2831853071795864 / n)).size(), pieces.size());
    }
}

TEST(Pieces, OfConcavePolygonsAreFew) {
    const std::vector<Vec2> l{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
    EXPECT_EQ(expect_split(Polygon{l}, 4).size(), 2u);
    EXPECT_EQ(expect_split(Polygon{{l.rbegin(), l.rend()}}, 4).size(), 2u);
    const Polygon plus{
        {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}}};
    EXPECT_LE(expect_split(plus, 5).size(), 5u);
    for (const int points : {3, 5, 20})
        for (const double inner : {0.1, 0.4, 0.8}) {
            const double area = points * inner * std::sin(3.14159265358979 / points);
            const auto pieces = expect_split(star(points, inner), area);
            EXPECT_LE(pieces.size(), 2u * static_cast<unsigned>(points));
        }
}

TEST(Pieces, OfPolygonsThatAreNoneAreErrors) {
    const auto complaint = [](std::vector<Vec2> points) { return error_of([&] { pieces_of(Polygon{points}); }); };
    EXPECT_EQ(complaint({{0, 0}, {1, 0}}), "Polygon.points must be at least 3, got 2");
    EXPECT_EQ(complaint({{0, 0}, {1, 0}, {1, 1}, {0, 0}}),
              "Polygon.points must be different points, but 0 and 3 are both (0, 0)");
    EXPECT_EQ(complaint({{0, 0}, {1, 0}, {2, 0}, {1, 1}}),
              "Polygon.points must not lie in a line: points 0, 1 and 2 do");
    EXPECT_EQ(complaint({{0, 0}, {1, 0}, {2, 0}}), "Polygon.points must not lie in a line: points 0, 1 and 2 do");
    EXPECT_EQ(
        complaint({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
        "Polygon.points must be a polygon that does not meet itself: the edge from 0 to 1 meets the one from 2 to 3");
    EXPECT_EQ(error_of([] {
                  pieces_of(Polygon{star(5, 0.4).points, 0.1});
              }),
              "Polygon.rounding must be 0 for a concave polygon, got 0.1 m");
}

TEST(Pieces, OfChainsKnowTheirNeighbours) {
    const auto open = pieces_of(Chain{{{0, 0}, {1, 0}, {1, 1}}});
    ASSERT_EQ(open.size(), 2u);
    EXPECT_EQ(open[0].normal[0], (Vec2{0, 1}));
    EXPECT_EQ(open[1].normal[0], (Vec2{-1, 0}));
    EXPECT_TRUE(open[0].one_sided && !open[0].has_previous && open[0].has_next);
    EXPECT_EQ(open[0].next_normal, (Vec2{-1, 0}));
    EXPECT_TRUE(open[1].has_previous && !open[1].has_next);
    EXPECT_EQ(open[1].previous_normal, (Vec2{0, 1}));
    const auto closed = pieces_of(Chain{{{0, 0}, {1, 0}, {1, 1}}, true});
    ASSERT_EQ(closed.size(), 3u);
    EXPECT_EQ(closed[0].previous_normal, closed[2].normal[0]);
    EXPECT_EQ(closed[2].next_normal, closed[0].normal[0]);
    EXPECT_EQ(error_of([] {
                  pieces_of(Chain{{{0, 0}, {1, 0}, {1, 0}}});
              }),
              "Chain.points must differ from the one before, and 2 is (1, 0) again");
}
