// Two boxes strike face to face, over a small part of their sides: 200 sweeps over two points that lie close together
// came to no end, and restitution made 5e-4 of the energy out of the rest.
#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(FlatBlow, KeepsItsEnergyHoweverNarrowTheFace) {
    for (const double shared : {0.3, 0.1, 0.05, 0.03, 0.02, 0.01}) {
        World world({.solver = SoftStep{}});
        const Shape box{.geometry = Box{.width = 1, .height = 1}};
        world.add(Body{.velocity = {5, 0}, .shapes = {box}});
        world.add(Body{.position = {1.5, 1 - shared}, .shapes = {box}});
        const double before = energy(world).total();
        run(world, 0.5, 1.0 / 60);
        EXPECT_GE(world.collisions(), 1u);
        // Rounding, times the condition of two points so close: (width / shared)², some 1e4.
        EXPECT_NEAR(energy(world).total(), before, 1e-11 * before) << shared;
    }
}

}  // namespace
}  // namespace carom::test
