// A net of rods that hangs from two corners is at a dead end: forces without bound would hold its upper edge straight.
// Guesses of the next half that were begun with such forces, on rows that had turned, left no digit of the velocities:
// the books of 18 × 18 discs did not close by 2e-4 J, and 20 × 20 flew apart with 6e5 J.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <vector>

namespace carom {
namespace {

TEST(TautNet, StaysCalmAndClosesItsBooks) {
    constexpr int side = 18;
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    std::vector<BodyId> discs;
    const auto tie = [&](std::size_t back) {
        world.add(Joint{.a = discs[discs.size() - 1 - back], .b = discs.back(), .type = DistanceJoint{}});
    };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            discs.push_back(world.add(Body{.position = {0.5 * x, 20 - 0.5 * y}, .mass = 0.1, .radius = 0.1}));
            if (x > 0) tie(1);
            if (y > 0) tie(side);
        }
    for (const std::size_t corner : {0, side - 1})
        world.add(Joint{.b = discs[corner], .at = world.position(discs[corner]), .type = RevoluteJoint{}});
    for (int step = 0; step < 25; ++step) world.step(1.0 / 60);
    const Energy now = energy(world);
    EXPECT_LE(now.kinetic, 0.1);              // 0.008 J, of the 5 kJ that it holds
    EXPECT_NEAR(now.unaccounted(), 0, 1e-6);  // 1.4e-8 J, from forces of 1e16 N
}

}  // namespace
}  // namespace carom
