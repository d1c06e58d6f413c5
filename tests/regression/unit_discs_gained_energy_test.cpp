// Discs of diameter 1 gained 2e-17 of their energy at every collision, 2e-12 of all after 1e9 collisions of 1e4 discs:
// the square of a distance that is 1 but for rounding lies on a grid that is twice as coarse above 1 as below, and
// quotients by it were rounded up more often than down.
#include <gtest/gtest.h>

#include "reference/exact_gas.hpp"

using namespace carom;

TEST(Regression, UnitDiscsGainedEnergy) {
    World world = lattice_gas(10, 10, 0.5);
    const double before = energy(world).kinetic;
    run(world, 6000, 1000);
    const auto hits = static_cast<double>(world.collisions());
    EXPECT_GT(hits, 1e6);
    const double gained = energy(world).kinetic - before;
    std::printf("%.3g J after %.3g collisions\n", gained, hits);
    // A collision rounds by 4.4e-16 J (rms), one way as often as the other: four standard deviations of the sum of
    // these.
    EXPECT_NEAR(gained, 0, 4 * 4.4e-16 * std::sqrt(hits));
}
