// Elastic discs that strike one another more often in a substep than some thousand times: the rest of these strikes
// were left to sweeps, for which nothing bounces, and all energy became heat.
#include <cmath>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

// truth.json ed.galperin: 3141 impacts for a mass of 1e6, most of them while the heavy one turns back, in one substep.
TEST(ALightDisc, StrikesAWallAndAHeavyOneAsOftenAsItShould) {
    World world({.solver = SoftStep{}});
    world.add(HalfPlane{{0, 0}, {1, 0}});
    world.add(Body{.position = {1, 0}, .mass = 1, .radius = 0.05});
    const BodyId heavy = world.add(Body{.position = {2, 0}, .velocity = {-1, 0}, .mass = 1e6, .radius = 0.05});
    const double before = energy(world).total();
    for (int step = 0; step < 300; ++step) world.step(1.0 / 60);
    EXPECT_EQ(world.collisions(), 3141u);
    EXPECT_GT(world.velocity(heavy).x, 0.999);
    EXPECT_NEAR(energy(world).total() / before, 1, 1e-10);  // rounding in each of the impacts at the worst: 3e-13
}

// Gaps of 1 % of a diameter: some 40 impacts of each disc in a substep, and three thousand of all.
TEST(ADenseGas, KeepsItsEnergy) {
    constexpr int side = 9;
    constexpr double radius = 0.05, pitch = 2 * radius * 1.01, speed = 20;
    World world({.solver = SoftStep{}});
    const double end = side * pitch;
    for (const HalfPlane& wall : {HalfPlane{{0, 0}, {0, 1}}, HalfPlane{{0, 0}, {1, 0}}, HalfPlane{{end, end}, {0, -1}},
                                  HalfPlane{{end, end}, {-1, 0}}})
        world.add(wall);
    Random random(1);
    for (int k = 0; k < side * side; ++k)
        world.add(Body{.position = {pitch * (k % side + 0.5), pitch * (k / side + 0.5)},
                       .velocity = {random.uniform(-speed, speed), random.uniform(-speed, speed)},
                       .radius = radius});
    const double before = energy(world).total();
    for (int step = 0; step < 3; ++step) world.step(1.0 / 60);
    EXPECT_GT(world.collisions(), 12 * 3000u);
    EXPECT_NEAR(energy(world).total() / before, 1, 1e-10);  // rounding in each of the impacts at the worst: 1e-11
}

}  // namespace
}  // namespace carom::test
