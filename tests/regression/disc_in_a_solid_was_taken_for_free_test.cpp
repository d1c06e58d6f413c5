// The exact gas took a disc that began deep in a box or polygon for a free one, which rattled in the solid for ever: it
// was held against the lines of the outline alone, and touched none of them. One whose centre was hardly in it was
// refused with too small a depth, and `relax` pushed it farther in.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <string>
#include <vector>

namespace carom {
namespace {

enum class SolidIs { fixed, driven, stepped };

World room_with(SolidIs kind, Vec2 start, double radius, bool relax) {
    World world({.solver = Events{.relax = relax}});
    world.add(Rectangle{.low = {0, 0}, .high = {10, 10}});
    Body block{.position = {5, 5}, .angle = 0.5, .shapes = {{.geometry = Box{4, 2}}}, .name = "block"};
    if (kind != SolidIs::stepped) block.kind = kind == SolidIs::fixed ? Kind::fixed : Kind::driven;
    world.add(block);
    world.add(Body{.position = start, .velocity = {1, 0.3}, .radius = radius, .name = "p"});
    return world;
}

/// A place by the axes of the block.
Vec2 in_block(double along, double across) {
    return Vec2{5, 5} +
           Vec2{along * std::cos(0.5) - across * std::sin(0.5), along * std::sin(0.5) + across * std::cos(0.5)};
}

std::string refusal_of(World world) {
    try {
        world.step(0.01);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

class DiscInASolid : public testing::TestWithParam<SolidIs> {};

TEST_P(DiscInASolid, IsRefusedWithItsDepth) {
    const auto has = [](const std::string& said, const char* what) {
        EXPECT_NE(said.find(what), std::string::npos) << said;
    };
    has(refusal_of(room_with(GetParam(), in_block(0, 0.25), 0.1, false)), "do: bodies 'p' and 'block' by 0.85 m. Move");
    has(refusal_of(room_with(GetParam(), in_block(-1.95, 0.25), 0.1, false)),
        "do: bodies 'p' and 'block' by 0.15 m. Move");
    has(refusal_of(room_with(GetParam(), in_block(0, 1.0625), 0.1, false)),
        "do: bodies 'p' and 'block' by 0.0375 m. Move");
    EXPECT_EQ(refusal_of(room_with(GetParam(), in_block(0, 1.1), 0.1, false)), "");
}

TEST_P(DiscInASolid, IsMovedOutOfItTheShortestWay) {
    for (const Vec2 start : {in_block(0.5, 0.25), in_block(0.5, 0.95)}) {
        World world = room_with(GetParam(), start, 0.1, true);
        world.set_velocity(world.ids()[1], {}, 0);
        world.add(Body{.position = {1, 1}, .velocity = {1e-6, 0}, .radius = 0.1});
        world.step(1e-3);
        // A thousandth of the radius beyond touching.
        EXPECT_LT(length(world.position(world.ids()[1]) - in_block(0.5, 1.1001)), 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(All, DiscInASolid, testing::Values(SolidIs::fixed, SolidIs::driven, SolidIs::stepped));

// The shortest way out of one piece leads over a seam into the next, which sent it back.
TEST(DiscBetweenPiecesOfASolid, IsMovedOutOfAllOfThem) {
    const Shape left{.geometry = Box{.width = 2, .height = 2, .centre = {-1, 0}}},
        right{.geometry = Box{.width = 2, .height = 2, .centre = {1, 0}}},
        angle{.geometry = Polygon{.points = {{-3, -1}, {3, -1}, {3, 1}, {0, 1}, {0, 3}, {-3, 3}}}};
    for (const std::vector<Shape>& shapes : {std::vector{left, right}, std::vector{angle}})
        for (const double x : {0.05, 0.1, -0.15})
            for (const double radius : {0.2, 0.0}) {
                World world({.solver = Events{.relax = true}});
                world.add(Rectangle{.low = {-5, -5}, .high = {5, 5}});
                const BodyId solid = world.add(Body{.kind = Kind::fixed, .shapes = shapes}),
                             disc = world.add(Body{.position = {x, 0.2}, .velocity = {1, 0.3}, .radius = radius});
                world.step(1e-3);
                EXPECT_GT(world.closest_points(solid, disc)->distance, 0) << x << ' ' << radius;
                EXPECT_LT(length(world.position(disc) - Vec2{x, 0.2}), 1.21 + radius) << "by the shortest way";
            }
}

// Points lie on rims and corners, where rounding is no depth.
TEST(PointOnTheRimOfASolid, MayBegin) {
    for (const Vec2 at : {in_block(0.7, 1), in_block(2, -0.3), in_block(2, 1), in_block(-2, -1)})
        EXPECT_EQ(refusal_of(room_with(SolidIs::fixed, at, 0, false)), "");
    EXPECT_NE(refusal_of(room_with(SolidIs::fixed, in_block(0.7, 1 - 1e-6), 0, false)), "");
}

}  // namespace
}  // namespace carom
