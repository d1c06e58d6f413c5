// A column of 25 boxes fell on a plate that sways up and down by a twentieth of g, which a column that stands on it
// rides along with. Precise solves took it for none that rests, since its bodies are never slow where their plate
// moves, and so for one that is dear; after a dozen steps it was left to sweeps, under which it buckled.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

#include "physics/frame.hpp"

namespace carom::test {
namespace {

/// How far the top box is off its place on the plate after so long [m].
double off_place(int boxes, double strokes, double of_gravity, double seconds) {
    constexpr double gravity = 9.81, side = 0.2;
    const double omega = 2 * std::numbers::pi * strokes, amplitude = of_gravity * gravity / (omega * omega);
    World world({.gravity = {0, -gravity}, .solver = SoftStep{}});
    const BodyId plate = world.add(Body{
        .kind = Kind::driven, .shapes = {{.geometry = Box{10, 0.1, {0, -0.05}}}}, .restitution = 0, .friction = 0.5});
    world.drive(plate, [=](double t) { return Pose{{0, amplitude * (1 - std::cos(omega * t))}, 0}; });
    for (int i = 0; i < boxes; ++i)
        world.add(Body{.position = {0, (i + 0.5) * side},
                       .shapes = {{.geometry = Box{side, side}}},
                       .restitution = 0,
                       .friction = 0.5});
    run(world, seconds, frame);
    const Vec2 place = world.position(plate) + Vec2{0, (boxes - 0.5) * side};
    return length(world.positions().back() - place);
}

// It sinks by what springs of contacts give under the load that the sway adds, 1e-7 m.
TEST(ShakenColumns, Stand) {
    EXPECT_LE(off_place(25, 1, 0.05, 12), 1e-6);
    EXPECT_LE(off_place(40, 5, 0.5, 3), 1e-6);
}

}  // namespace
}  // namespace carom::test
