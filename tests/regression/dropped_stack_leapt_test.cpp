// Contacts that saw the floor coming braked the lowest box of a falling stack as a force, and the force went on: four
// boxes without restitution that were dropped by a metre leapt up again by 17 cm.
#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(DroppedStack, StaysWhereItLands) {
    World world = floor_world(0.6);
    add_stack(world, 4, 1);
    const double landing = std::sqrt(2 / 9.81);
    while (world.time() < landing) world.step(1.0 / 60);
    // What a blow leaves is slower than what gravity gives in two substeps, 8 cm/s: 0.3 mm high.
    for (int step = 0; step < 60; ++step) {
        world.step(1.0 / 60);
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(world.positions()[i].y, 0.5 + i, 2e-3) << "at " << world.time();
    }
}

// Nor is it braked before it is there.
TEST(DroppedStack, FallsFreelyUntilItLands) {
    World world = floor_world(0.6);
    add_stack(world, 1, 1.007);
    while (world.time() < 0.445) world.step(1.0 / 60);  // then it is 1.6 cm above the floor
    EXPECT_NEAR(world.velocities()[0].y, -9.81 * world.time(), 1e-12);
}

}  // namespace
}  // namespace carom::test
