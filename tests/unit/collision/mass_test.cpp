#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "collision/convex.hpp"
#include "error_of.hpp"
#include "outlines.hpp"

using namespace carom;
using namespace carom::test;

namespace {

using std::numbers::pi;

MassProperties mass_of(const Geometry& geometry, double density = 1) {
    return mass_properties({{.geometry = geometry, .density = density}}, 1);
}

void expect_mass(const MassProperties& is, double mass, Vec2 centre, double moment) {
    EXPECT_NEAR(is.mass, mass, 1e-14 * mass);
    EXPECT_NEAR(is.centre.x, centre.x, 1e-14);
    EXPECT_NEAR(is.centre.y, centre.y, 1e-14);
    EXPECT_NEAR(is.moment, moment, 1e-14 * moment);
}

/// A rectangle of squares, minus what is outside.
MassProperties by_squares(const Convex& outline, int across) {
    const Aabb box = bounds(outline, {});
    const auto corners = corners_at(outline, {}, {});
    const Vec2 cell = (box.high - box.low) / across;
    MassProperties sum;
    double second = 0;
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
            const Vec2 p = box.low + Vec2{(i + 0.5) * cell.x, (j + 0.5) * cell.y};
            bool inside = outline.count > 2;
            for (int k = 0; k < outline.count && inside; ++k)
                inside = dot(p - outline.corner[k], outline.normal[k]) <= 0;
            if (!inside && brute_distance(corners, {p}) > outline.radius) continue;
            sum.mass += cell.x * cell.y;
            sum.centre += cell.x * cell.y * p;
            second += cell.x * cell.y * squared_length(p);
        }
    sum.centre = sum.centre / sum.mass;
    sum.moment = second - sum.mass * squared_length(sum.centre);
    return sum;
}

}  // namespace

TEST(Mass, OfDiscBoxAndCapsule) {
    expect_mass(mass_of(Disc{{3, 4}, 2}, 5), 20 * pi, {3, 4}, 0.5 * 20 * pi * 4);
    expect_mass(mass_of(Box{3, 2, {1, -1}, 0.7}, 2), 12, {1, -1}, 12 * (9 + 4) / 12.);
    // A rectangle and two half discs, the centre of each 4r/3π from its diameter.
    const double r = 0.5, l = 3, disc = pi * r * r;
    const double off = l / 2 + 4 * r / (3 * pi), half = r * r / 2 - std::pow(4 * r / (3 * pi), 2);
    expect_mass(mass_of(Capsule{{1, 0}, {1, 3}, r}), 2 * r * l + disc, {1, 1.5},
                2 * r * l * (l * l + 4 * r * r) / 12 + disc * (half + off * off));
}

TEST(Mass, OfARoundedBox) {
    // A cross of two rectangles, less the square in the middle, and four quarter discs.
    const double r = 0.2, w = 2, h = 1, x = w / 2 - r, y = h / 2 - r, disc = pi * r * r;
    const double c = 4 * r / (3 * pi), quarter = r * r / 2 - 2 * c * c;
    const double area = 2 * x * h + 2 * y * w - 4 * x * y + disc;
    const double moment = 2 * x * h * (4 * x * x + h * h) / 12 + w * 2 * y * (w * w + 4 * y * y) / 12 -
                          4 * x * y * (4 * x * x + 4 * y * y) / 12 +
                          disc * (quarter + (x + c) * (x + c) + (y + c) * (y + c));
    expect_mass(mass_of(Box{w, h, {5, 5}, 0, r}), area, {5, 5}, moment);
    expect_mass(mass_of(Box{1, 1, {5, 5}, 0, 0.5}), pi / 4, {5, 5}, pi / 32);
    expect_mass(mass_of(Box{2, 1, {}, 0, 0.5}), 1 + pi / 4, {}, mass_of(Capsule{{-0.5, 0}, {0.5, 0}, 0.5}).moment);
}

TEST(Mass, OfAnLIsThatOfItsTwoBoxes) {
    const Polygon l{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}};
    const std::vector<Shape> boxes{{.geometry = Box{3, 1, {1.5, 0.5}}, .density = 1},
                                   {.geometry = Box{1, 1, {0.5, 1.5}}, .density = 1}};
    const MassProperties two = mass_properties(boxes, 0);
    expect_mass(two, 4, {1.25, 0.75}, 3 * (9 + 1) / 12. + 2 / 12. + 3 * (0.0625 + 0.0625) + 0.5625 + 0.5625);
    expect_mass(mass_of(l), two.mass, two.centre, two.moment);
}

TEST(Mass, OfRoundedPolygonsAgreesWithCountingSquares) {
    Random random(1);
    for (int n = 0; n < 20; ++n) {
        Hull hull{{}, n % 2 ? 0.3 : 0};
        for (int i = 0; i < 6; ++i) hull.points.push_back({random.uniform(2, 4), random.uniform(-4, -2)});
        const MassProperties exact = mass_of(hull), counted = by_squares(pieces_of(hull)[0], 500);
        EXPECT_NEAR(counted.mass / exact.mass, 1, 2e-3);
        EXPECT_LT(length(counted.centre - exact.centre), 2e-3);
        EXPECT_NEAR(counted.moment / exact.moment, 1, 4e-3);
    }
}

TEST(Mass, IsSpreadEvenlyWithoutDensities) {
    const std::vector<Shape> shapes{
        {.geometry = Box{2, 1, {-1, 0}}}, {.geometry = Box{2, 2, {1, 0}}}, {.geometry = Segment{}}};
    const MassProperties m = mass_properties(shapes, 12);
    EXPECT_NEAR(m.mass, 12, 1e-14);
    EXPECT_NEAR(m.centre.x, (-4 + 8) / 12., 1e-15);
    EXPECT_EQ(mass_properties({{.geometry = Chain{{{0, 0}, {1, 0}}}}}, 12).mass, 0);
    std::vector<Shape> mixed = shapes;
    mixed[0].density = 2;
    EXPECT_EQ(error_of([&] { mass_properties(mixed, 1); }),
              "Shape.density must be given for all shapes of a body or for none, got it for 1 of 2");
    mixed[1].density = 1;
    EXPECT_NEAR(mass_properties(mixed, 1).mass, 8, 1e-14);
}

TEST(Mass, MovesTheBodyToItsCentre) {
    Body body;
    body.position = {10, 20}, body.angle = std::acos(0.);
    body.shapes = {{.geometry = Box{2, 1, {1, 0.5}}, .density = 3}, {.geometry = Segment{{0, 0}, {1, 1}}}};
    const Body moved = with_mass_of_shapes(body);
    EXPECT_NEAR(moved.mass, 6, 1e-15);
    EXPECT_NEAR(*moved.moment_of_inertia, 6 * 5 / 12., 1e-15);
    EXPECT_NEAR(moved.position.x, 9.5, 1e-14);
    EXPECT_NEAR(moved.position.y, 21, 1e-14);
    EXPECT_NEAR(std::get<Segment>(moved.shapes[1].geometry).a.x, -1, 1e-15);
    EXPECT_NEAR(std::get<Segment>(moved.shapes[1].geometry).b.y, 0.5, 1e-15);
    // What is centred already keeps its bits.
    const Body again = with_mass_of_shapes(moved);
    EXPECT_EQ(again.position, moved.position);
}

TEST(Mass, LeavesOtherBodiesAsTheyAre) {
    Body plain;
    EXPECT_FALSE(with_mass_of_shapes(plain).moment_of_inertia);
    Body line;
    line.shapes = {{.geometry = Segment{}}};
    line.mass = 7;
    EXPECT_EQ(with_mass_of_shapes(line).mass, 7);
    EXPECT_FALSE(with_mass_of_shapes(line).moment_of_inertia);
    // A driven paddle turns about where it is put.
    Body paddle;
    paddle.kind = Kind::driven;
    paddle.shapes = {{.geometry = Box{2, 1, {1, 0}}}};
    EXPECT_EQ(with_mass_of_shapes(paddle).position, (Vec2{}));
    Body both = line;
    both.radius = 1;
    EXPECT_EQ(error_of([&] { with_mass_of_shapes(both); }), "Body.radius must be 0 for a body with shapes, got 1 m");
}
