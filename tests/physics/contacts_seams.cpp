// Floors of many pieces and single corners: who goes past touches nothing that is not there.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

constexpr double dt = 1.0 / 60, g = 10;

struct Slider {
    const char* name;
    Geometry outline;
    double height;  ///< of its position above the floor [m]
};
const Slider sliders[] = {{"disc", Disc{{}, 0.25}, 0.25},
                          {"capsule", Capsule{{-0.3, 0}, {0.3, 0}, 0.25}, 0.25},
                          {"rounded box", Box{0.4, 0.4, {}, 0, 0.05}, 0.2},
                          {"box", Box{0.5, 0.5}, 0.25}};

Shape piece_of_floor(bool of_segments, double x) {
    return of_segments ? Shape{.geometry = Segment{{x - 0.5, 0}, {x + 0.5, 0}}}
                       : Shape{.geometry = Box{1, 1, {x, -0.5}}};
}
Body smooth(Vec2 at, std::vector<Shape> shapes) {
    return {.position = at, .shapes = std::move(shapes), .restitution = 0, .friction = 0};
}

struct Slide {
    double kept, highest, lowest;  ///< of its speed, and of its height
};
/// A slider on a smooth floor of pieces a metre long, over eighty of their seams; elsewhere so many others that the
/// contacts are swept and not solved precisely.
Slide slide(const Slider& slider, bool of_segments, int others, double speed) {
    World world({.gravity = {0, -g}, .solver = SoftStep{.sleep = false}});
    Body floor = smooth({}, {});
    floor.kind = Kind::fixed;
    for (int i = -1; i < 90; ++i) floor.shapes.push_back(piece_of_floor(of_segments, i));
    for (int i = 0; i < others; ++i) floor.shapes.push_back(piece_of_floor(of_segments, 1000.0 + i));
    world.add(floor);
    Body body = smooth({0, slider.height}, {Shape{.geometry = slider.outline, .density = 1}});
    for (int i = 0; i < others; ++i) body.position.x = 1000.0 + i, world.add(body);
    body.position.x = 0, body.velocity.x = speed;
    const BodyId id = world.add(body);
    Slide found{0, -1, 1};
    while (world.position(id).x < 80) {
        world.step(dt);
        const double above = world.position(id).y - slider.height;
        found.highest = std::max(found.highest, above), found.lowest = std::min(found.lowest, above);
    }
    found.kept = world.velocity(id).x / speed;
    return found;
}

// Nothing acts along a smooth level floor. What is left is rounding; and of the height what the precise solve takes for
// rest, 1e-10 of a substep's velocities, over eighty seconds.
TEST(Seams, TakeNoSpeedFromWhatSlidesOverThem) {
    for (const Slider& slider : sliders)
        for (const bool of_segments : {false, true})
            for (const double speed : {1.0, 3.0, 10.0, 30.0}) {
                const Slide alone = slide(slider, of_segments, 0, speed);
                EXPECT_NEAR(alone.kept, 1, 1e-12) << slider.name << " at " << speed << " m/s, segments " << of_segments;
                EXPECT_NEAR(alone.highest, 0, 1e-9) << slider.name;
                EXPECT_NEAR(alone.lowest, 0, 1e-9) << slider.name;
            }
}

// Sweeps let what rests sink in by the width of a hair s, up to g/ω² = 0.17 mm at four substeps, and then every seam of
// the floor is a corner above its lowest point. A seam that is met could take what there is in such a fall, g s / v² of
// the speed, 2e-3 and 2e-5; eighty of them are to take less than a tenth of that.
TEST(Seams, TakeNoSpeedFromWhatHasSunkInByAHair) {
    for (const Slider& slider : sliders)
        for (const double speed : {1.0, 10.0}) {
            const Slide among = slide(slider, false, 30, speed);
            EXPECT_NEAR(among.kept, 1, 2e-4 / (speed * speed)) << slider.name << " at " << speed << " m/s";
            EXPECT_LE(among.highest, 1e-9) << slider.name;
            EXPECT_GE(among.lowest, -2e-4) << slider.name;
        }
}

/// By how much a disc that passes another body at the least distance of a hair is turned aside, and slowed.
double turned_aside(Geometry other, double reach, double speed, double restitution) {
    World world({.solver = SoftStep{.sleep = false}});
    Body obstacle{.position = {}, .shapes = {Shape{.geometry = std::move(other)}}};
    obstacle.kind = Kind::fixed;
    world.add(obstacle);
    const Vec2 v{speed, 0};
    const BodyId disc = world.add({.position = {-1.3, reach + 0.25 + 1e-9},
                                   .velocity = v,
                                   .shapes = {Shape{.geometry = Disc{{}, 0.25}, .density = 1}},
                                   .restitution = restitution});
    while (world.position(disc).x < 1.3) world.step(dt);
    return length(world.velocity(disc) - v) / speed;
}

// It touches nothing, at whatever speed, and goes straight on.
TEST(Seams, LetADiscPassACornerByAHair) {
    for (const double speed : {0.1, 0.3, 1.0, 3.0, 10.0})
        for (const double restitution : {0.0, 1.0}) {
            EXPECT_EQ(turned_aside(Disc{{}, 0.5}, 0.5, speed, restitution), 0) << "disc at " << speed << " m/s";
            EXPECT_EQ(turned_aside(Box{1, 1}, 0.5, speed, restitution), 0) << "box at " << speed << " m/s";
            EXPECT_EQ(turned_aside(Capsule{{0, -0.5}, {0, 0.5}, 0.1}, 0.6, speed, restitution), 0)
                << "capsule at " << speed << " m/s";
        }
}

}  // namespace
}  // namespace carom
