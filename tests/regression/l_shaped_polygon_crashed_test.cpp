// An ear of an L with equal arms has the notch on its edge. Where rounding had that outside, the ear was cut off, of
// what was left parts had no area and no corners, and the first step wrote to memory that was not its own.

#include <gtest/gtest.h>

#include <carom/random.hpp>
#include <cmath>

#include "collision/polygons.hpp"
#include "unit/collision/outlines.hpp"

namespace carom::test {
namespace {

/// By its corners on a grid of that size [m].
Polygon on_grid(double size, Vec2 from, std::initializer_list<Vec2> corners) {
    Polygon polygon;
    for (const Vec2 c : corners) polygon.points.push_back(from + size * c);
    return polygon;
}

TEST(LShapedPolygon, OfAnySizeIsSplitIntoAllOfItsArea) {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const double size = random.uniform(0.1, 2);
        const Vec2 from{random.uniform(-3, 3), random.uniform(-3, 3)};
        const Polygon shapes[] = {
            on_grid(size, from, {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}),                  // L
            on_grid(size, from, {{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 3}, {0, 3}}),  // stairs
            on_grid(size, from, {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}),  // U
            on_grid(size, from,
                    {{1, 0},
                     {2, 0},
                     {2, 1},
                     {3, 1},
                     {3, 2},
                     {2, 2},
                     {2, 3},
                     {1, 3},
                     {1, 2},
                     {0, 2},
                     {0, 1},
                     {1, 1}}),  // cross
        };
        const double off = i % 2 == 0 ? 0 : std::exp(random.uniform(-37, -21));  // 1e-16 to 1e-9 m
        for (Polygon shape : shapes) {
            for (Vec2& c : shape.points) c += Vec2{random.uniform(-off, off), random.uniform(-off, off)};
            double area = 0;
            for (const Convex& piece : pieces_of(shape)) {
                ASSERT_GE(piece.count, 3);
                area += 0.5 * doubled_area({piece.corner, piece.corner + piece.count});
            }
            const double whole = 0.5 * doubled_area(shape.points);
            EXPECT_NEAR(area, whole, 1e-13 * (whole + dot(from, from)) + 10 * off);  // rounding of where corners are
        }
    }
}

}  // namespace
}  // namespace carom::test
