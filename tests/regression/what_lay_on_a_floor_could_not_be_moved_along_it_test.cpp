// cast_shape said of what lay exactly on a floor that it met it at fraction 0 in every direction, also along it and
// away from it, and that it met every next tile of a level floor.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom::test {
namespace {

const Geometry heroes[] = {Box{1, 1}, Disc{.radius = 0.5}, Capsule{{0, -0.2}, {0, 0.2}, 0.3},
                           Polygon{{{-0.5, -0.5}, {0.5, -0.5}, {0, 0.5}}}, Box{1, 1, {}, 0, 0.1}};

struct Level {
    const char* name;
    World world;
    Sought sought{};
};

/// Floors at y = −0.5.
std::vector<Level> levels() {
    const auto fixed = [](std::vector<Shape> shapes, Vec2 at = {}, double angle = 0) {
        return Body{.kind = Kind::fixed, .position = at, .angle = angle, .shapes = std::move(shapes)};
    };
    std::vector<Level> all;
    const auto level = [&](const char* name) -> World& {
        all.push_back({name, World({.solver = SoftStep{}})});
        return all.back().world;
    };
    level("box").add(fixed({{.geometry = Box{20, 2}}}, {0, -1.5}));
    level("turned box").add(fixed({{.geometry = Box{2, 20}}}, {0, -1.5}, 1.57079632679489662));
    World& tiles = level("tiles");
    for (int i = -10; i <= 10; ++i) tiles.add(fixed({{.geometry = Box{1, 1}}}, {i * 1.0, -1}));
    level("chain").add(fixed({{.geometry = Chain{{{-9, -0.5}, {-3, -0.5}, {0.5, -0.5}, {4, -0.5}, {9, -0.5}}}}}));
    level("segment").add(fixed({{.geometry = Segment{{-9, -0.5}, {9, -0.5}}}}));
    level("wall").add(HalfPlane{.point = {0, -0.5}});
    all.back().sought.walls = true;
    return all;
}

TEST(WhatLayOnAFloorCouldNotBeMovedAlongIt, SlidesAndRisesAndDoesNotSink) {
    for (const Level& level : levels())
        for (const Geometry& hero : heroes) {
            SCOPED_TRACE(level.name);
            SCOPED_TRACE(hero.index());
            const auto cast = [&](Vec2 at, Vec2 way) {
                const auto hit = level.world.cast_shape(hero, {at, 0}, way, level.sought);
                return hit ? hit->fraction : -1;
            };
            for (const double gap : {0.0, 1e-13, -1e-13}) {
                EXPECT_EQ(cast({0, gap}, {5, 0}), -1);
                EXPECT_EQ(cast({0.3, gap}, {-5, 0}), -1);
                EXPECT_EQ(cast({0, gap}, {0, 5}), -1);
                EXPECT_EQ(cast({0, gap}, {3, 0.1}), -1);
                EXPECT_EQ(cast({0, gap}, {}), -1);
                EXPECT_NEAR(cast({0, gap}, {0, -1}), 0, 1e-12);
                EXPECT_NEAR(cast({0, gap}, {5, -0.01}), 0, 1e-10);
            }
            EXPECT_EQ(cast({0, -0.01}, {5, 0}), 0);  // it overlaps
            EXPECT_EQ(cast({0, -0.01}, {0, 5}), 0);
            EXPECT_NEAR(cast({0, 1}, {0, -2}), 0.5, 1e-9);
            EXPECT_NEAR(cast({0, 1}, {0, -1}), 1, 1e-9);
        }
}

TEST(WhatLayOnAFloorCouldNotBeMovedAlongIt, IsStoppedByAStepAndPassesOneThatIsLevel) {
    World world({.solver = SoftStep{}});
    world.add(Body{.kind = Kind::fixed, .position = {0, -1}, .shapes = {{.geometry = Box{20, 2}}}});
    const BodyId step =
        world.add(Body{.kind = Kind::fixed, .position = {2.5, 0.1}, .shapes = {{.geometry = Box{1, 0.2}}}});
    const auto hit = world.cast_shape(Box{1, 1}, {{0, 0.5}, 0}, {3, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->body, step);
    EXPECT_NEAR(hit->fraction, 0.5, 1e-9);
    EXPECT_EQ(hit->normal, (Vec2{-1, 0}));
    const auto at_it = world.cast_shape(Box{1, 1}, {{1.5, 0.5}, 0}, {3, 0});
    ASSERT_TRUE(at_it);
    EXPECT_EQ(at_it->body, step);
    EXPECT_EQ(at_it->fraction, 0);
    EXPECT_FALSE(world.cast_shape(Box{1, 1}, {{1.5, 0.5}, 0}, {-3, 0}));
    EXPECT_FALSE(world.cast_shape(Box{1, 1}, {{1.5, 0.5}, 0}, {0, 3}));
    EXPECT_FALSE(world.cast_shape(Box{1, 1}, {{0, 0.7}, 0}, {6, 0}));       // its bottom grazes the step's top
    EXPECT_FALSE(world.cast_shape(Box{1, 1}, {{1.5, 0.7}, 0}, {6, 0}));     // corner at corner
    EXPECT_TRUE(world.cast_shape(Box{1, 1}, {{1.5, 0.7}, 0}, {6, -0.01}));  // and into it
}

TEST(WhatLayOnAFloorCouldNotBeMovedAlongIt, RoundWallsAreMetWhereTheyCurveIn) {
    World world({.solver = Events{}});
    world.add(Stadium{.a = {-1, 0}, .b = {1, 0}, .radius = 1});
    const Disc disc{.radius = 0.5};
    EXPECT_FALSE(world.cast_shape(disc, {{-1, -0.5}, 0}, {2, 0}, {.walls = true}));
    EXPECT_FALSE(world.cast_shape(disc, {{1, -0.5}, 0}, {0, 1}, {.walls = true}));
    EXPECT_NEAR(world.cast_shape(disc, {{1, -0.5}, 0}, {0, 2}, {.walls = true})->fraction, 0.5, 1e-9);
}

}  // namespace
}  // namespace carom::test
