// Two boxes on one another whose centres a rod joins cannot rock: the rod pulls as hard as both corners push, and any
// such push fits. The precise solve let it grow from substep to substep to 80 kN where 40 N are borne, undid overlaps
// of some micrometres with 10 kJ, and once a corner came free the boxes had 10 J more than before, of 41.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

World stack_with_a_rod() {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {0, 0.6, {}}});
    const auto box = [&](double y, double height) {
        return world.add(
            Body{.position = {0, y}, .shapes = {{.geometry = Box{1.2, height}}}, .restitution = 0, .friction = 0.6});
    };
    const BodyId lower = box(0.35, 0.7), upper = box(1.25, 1.1);
    box(2.3, 1);
    world.add(Joint{.a = lower, .b = upper, .type = DistanceJoint{}, .collide = true});
    for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
    return world;
}

TEST(Rod, AcrossTwoCornersMakesNoEnergy) {
    for (const double push : {1.0, 2.0, 3.0, 4.0}) {  // N s
        World world = stack_with_a_rod();
        const BodyId upper = world.ids()[1];
        world.apply_impulse(upper, {push, 0}, world.position(upper) + Vec2{0, 0.2});
        const double before = energy(world).total();
        double most = before;
        for (int i = 0; i < 240; ++i) {
            world.step(1.0 / 60);
            most = std::max(most, energy(world).total());
        }
        // All that happens is that boxes of 1 kg slide and tip over: it takes energy, and none is less than rounding.
        EXPECT_LE(most - before, 1e-3) << push;
        // To undo an overlap is work, too: no more than there is energy to make overlaps.
        EXPECT_LE(energy(world).work.overlap, before) << push;
    }
}

}  // namespace
}  // namespace carom
