// Eighty boxes in a square drum that turned at 3 rad/s crept through its walls of half a metre at 0.15 m/s, and twelve
// were outside after ten seconds: contacts of a crowd stayed in the plane in which they were when a step began, while
// the wall turned out of it.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

constexpr double half_width = 4.75, wall_thickness = 0.5;

void add_boxes(World& world) {
    for (int i = 0; i < 80; ++i)
        world.add(Body{.position = {-4 + (i % 9) * 1.0, -4 + (i / 9) * 0.9},
                       .angle = 1.0 * i,
                       .shapes = {{.geometry = Box{0.6, 0.4}, .density = 1, .restitution = 0, .friction = 0.6}}});
}
std::vector<Shape> walls() {
    constexpr double middle = half_width + 0.5 * wall_thickness, length = 2 * middle + wall_thickness;
    std::vector<Shape> all;
    for (const double side : {-middle, middle})
        for (const bool upright : {false, true})
            all.push_back(
                {.geometry = upright ? Box{wall_thickness, length, {side, 0}} : Box{length, wall_thickness, {0, side}},
                 .density = 50,
                 .restitution = 0,
                 .friction = 0.6});
    return all;
}

class Drum : public testing::TestWithParam<Kind> {};
TEST_P(Drum, KeepsItsCrowd) {
    constexpr double speed = 3;
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    const BodyId drum = world.add(Body{.kind = GetParam(), .angular_velocity = speed, .shapes = walls()});
    if (GetParam() == Kind::dynamic)
        world.add(
            Joint{.b = drum, .at = Vec2{}, .type = RevoluteJoint{.motor = JointMotor{.speed = speed, .maximum = 1e6}}});
    add_boxes(world);
    double deepest = 0;
    run(world, 4, 1.0 / 60, [&](const World& w) {
        for (const Overlap& o : w.overlaps())
            if (o.shapes.a.body == drum || o.shapes.b.body == drum) deepest = std::max(deepest, o.depth);
    });
    EXPECT_LE(deepest, 0.2 * wall_thickness);
}
INSTANTIATE_TEST_SUITE_P(Turned, Drum, testing::Values(Kind::driven, Kind::dynamic));

}  // namespace
}  // namespace carom
