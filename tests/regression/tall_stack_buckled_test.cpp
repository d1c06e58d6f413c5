// Soft contacts give a column of boxes the stiffness of a soft beam: one of fifty buckled under its own weight and fell
// within 20 s.
#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(TallStack, OfFiftyStandsUpright) {
    World world = floor_world(0.6, {}, {0, -10});
    add_stack(world, 50);
    run(world, 20, 1.0 / 60);
    for (int i = 0; i < 50; ++i) {
        EXPECT_NEAR(world.positions()[i].x, 0, 1e-3);
        EXPECT_NEAR(world.positions()[i].y, 0.5 + i, 1e-3);
    }
}

}  // namespace
}  // namespace carom::test
