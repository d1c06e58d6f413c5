// A disc of an exact gas that struck a box on a floor booked heat that never was: 43.6 J where 29 J were lost, and in
// stacks of boxes up to 35 times the energy of the disc. Where a hit ended a turn, the box was moved once more by its
// own solver, which was booked, and then got the velocity of the longer way in its place. A turn ends before such a hit
// now, which finds the box as its own solver has it. And of two that a box lay against the one that was found first was
// said to take what both did.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

Body box(double height, double mass, double restitution) {
    return {.position = {0, height},
            .mass = mass,
            .shapes = {{.geometry = Box{.width = 1, .height = 0.5}}},
            .restitution = restitution};
}

World disc_above_boxes(int boxes, double restitution, double gravity, double mass, double aside) {
    World world({.gravity = {0, -gravity}, .solver = Events{}});
    world.add(HalfPlane{.side = {.restitution = restitution}});
    for (int k = 0; k < boxes; ++k) world.add(box(0.25 + 0.5 * k, 1 + 0.5 * k, restitution));
    world.add(Body{.position = {aside, 0.5 * boxes + 0.5},
                   .velocity = {0, -5},
                   .mass = mass,
                   .radius = 0.1,
                   .restitution = restitution});
    return world;
}

/// What forces do not know of within a substep is of second order in it: 0.5 % of the disc's energy here, and 5 % in
/// stacks, whose blows are many in a substep. Work of putting boxes apart that hits pressed together is booked as that.
TEST(HitOnWhatLeans, HeatIsWhatIsLost) {
    for (const int boxes : {1, 2, 3})
        for (const double restitution : {0.1, 0.4, 0.8, 1.0})
            for (const double aside : {0.0, 0.3})
                for (const double mass : {0.5, 2.0, 10.0}) {
                    World world = disc_above_boxes(boxes, restitution, 5, mass, aside);
                    run(world, 0.15, 1.0 / 60);
                    const double of = 0.5 * mass * 25;
                    EXPECT_NEAR(energy(world).residual, 0, (boxes == 1 ? 0.005 : 0.05) * of)
                        << boxes << " boxes, restitution " << restitution << ", " << mass << " kg, aside " << aside;
                }
}

/// A box of 1 kg and a disc of 2 kg under a restitution of 0.1: they lie there in the end, and all but 1 J, which the
/// height of the disc is, is heat.
TEST(HitOnWhatLeans, HeatIsWhatADiscHadThatComesToRest) {
    World world = disc_above_boxes(1, 0.1, 5, 2, 0.3);
    const double start = energy(world).total();
    run(world, 0.5, 1.0 / 60);
    EXPECT_NEAR(energy(world).heat.total(), start - energy(world).total(), 0.05);
}

/// Turns of a substep of 1e-5 s are as short as a millionth of that, and what bounces in them still does.
TEST(HitOnWhatLeans, HeatIsWhatIsLostInShortSteps) {
    for (const double aside : {0.0, 0.1, 0.3}) {
        World world = disc_above_boxes(1, 0.8, 0, 10, aside);
        run(world, 0.2, 1.0 / 20000);
        const Energy e = energy(world);
        EXPECT_NEAR(e.residual, 0, 1e-3 * 125) << aside;
        EXPECT_NEAR(125 - e.total(), e.heat.total(), 1e-3 * 125) << aside;
    }
}

/// A rounded box in a corner of a floor and a fixed block, struck from above and the side: nothing moves it, so that
/// either takes what comes its way, to rounding.
TEST(HitOnWhatLeans, EachThatHoldsTakesItsOwn) {
    World world({.solver = Events{}});
    world.add(HalfPlane{.side = {.restitution = 0}});
    world.add(Body{.kind = Kind::fixed, .position = {1, 0.5}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0});
    world.add(Body{.position = {0, 0.25},
                   .mass = 1,
                   .shapes = {{.geometry = Box{.width = 1, .height = 0.5, .rounding = 0.2}}},
                   .restitution = 0});
    world.add(Body{.position = {-1.5, 1.4}, .velocity = {3, -3}, .mass = 1, .radius = 0.1, .restitution = 0});
    run(world, 1, 1.0 / 60);
    const MomentumBalance m = momentum_balance(world);
    EXPECT_NEAR(m.held.linear.y, 0, 1e-12);
    EXPECT_NEAR(m.walls.linear.x, 0, 1e-12);
    EXPECT_NEAR(m.walls.linear.y, 3, 1e-11) << "all that came down, and trembling as of a gas on a floor";
    EXPECT_NEAR(length(m.residual.linear), 0, 1e-12);
}

}  // namespace
}  // namespace carom
