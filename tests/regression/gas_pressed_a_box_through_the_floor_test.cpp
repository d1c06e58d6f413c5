// Discs of an exact gas that fell on a box on the floor pressed it through: within a turn of a substep every hit kinked
// the way of the box into the floor, which answered only in the next turn, and softly. Fifteen of 5 kg that bounce off
// nothing had a box of 1 kg half a metre below the floor. What it lies on holds against the hit at once now.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

struct Pressed {
    double deepest = 0;
    Energy energy;
};

Pressed fall_on_box(double restitution, double mass, int discs, double seconds) {
    const Side side{.restitution = restitution, .friction = 0.3};
    World world({.gravity = {0, -9.81}, .solver = Events{}});
    world.add(Rectangle{{-0.6, 0}, {0.6, 30}, side, side, side, side});
    const BodyId box = world.add(Body{.position = {0, 0.2},
                                      .mass = 1,
                                      .shapes = {{.geometry = Box{.width = 1, .height = 0.4}}},
                                      .restitution = restitution,
                                      .friction = 0.3});
    for (int i = 0; i < discs; ++i)
        world.add(Body{.position = {0.05 * (i % 3) - 0.05, 1.2 + 1.1 * i},
                       .mass = mass,
                       .radius = 0.5,
                       .restitution = restitution,
                       .friction = 0.3});
    Pressed pressed;
    while (world.time() < seconds) {
        world.step(1.0 / 120);
        pressed.deepest = std::max(pressed.deepest, -world.bounds(box).low.y);
    }
    pressed.energy = energy(world);
    return pressed;
}

/// A contact gives way by some 1e-4 of its body's size in a substep before the turn ends; thrice that, for it gives way
/// to what the box lost on its way, too.
constexpr double some = 3e-4;

TEST(BoxUnderAGas, IsNotPressedThroughTheFloorByDiscsThatLie) {
    const Pressed pressed = fall_on_box(0, 5, 5, 1.5);
    EXPECT_LT(pressed.deepest, some);
    EXPECT_NEAR(pressed.energy.residual, 0, 1e-3 * pressed.energy.heat.total());
}

TEST(BoxUnderAGas, IsNotPressedThroughTheFloorByOneThatBounces) {
    const Pressed pressed = fall_on_box(0.5, 20, 1, 0.6);
    EXPECT_LT(pressed.deepest, some);
    EXPECT_NEAR(pressed.energy.residual, 0, 0.02 * pressed.energy.heat.total());
}

}  // namespace
}  // namespace carom
