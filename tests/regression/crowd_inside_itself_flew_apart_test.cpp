// Discs put into one another by half flew apart at 9 m/s with 36 kJ: what pushed each pair apart softly added up
// through the crowd, for sweeps can only take back what neighbours do to one another. They are shifted apart now.
#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(Crowd, PutIntoItselfIsPartedWithoutVelocity) {
    constexpr int side = 50;
    World world({.solver = SoftStep{}});
    for (int i = 0; i < side * side; ++i) world.add(disc({0.6 * (i % side), 0.6 * (i / side)}, 0.5, 0.3));
    pass(world, 2);
    double fastest = 0;
    for (const Vec2 v : world.velocities()) fastest = std::max(fastest, length(v));
    EXPECT_GT(length(world.positions()[0]), 1.5);  // the corner is on its way
    // An overlap of a hundredth is left to springs, which have ½ m ω² (0.01 m)² = 1.5 J each at 240 substeps a second.
    EXPECT_LT(motion(world), 0.5 * side * side);
    EXPECT_LT(fastest, 3);
}

}  // namespace
}  // namespace carom::test
