// Dominoes that lie on one another like tiles made 12 J of their 69 J in a step. A substep that was cut short a
// microsecond before a slip ended let who was near come as fast as the gap by that microsecond, 1e5 m/s, and the
// interior point took that for the measure of all speeds: it began there, and ended with velocities that were right to
// a part of it.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <vector>

namespace carom {
namespace {

// Nothing drives them and nothing bounces: only to part what overlaps may give them energy. In the worst of 40 random
// rows that is 0.0175 J more in a step than is lost in it; of this row it was 12.3, 2.9, 0.24, 0.06 and 0.06 J.
TEST(FallenDominoes, MakeNoEnergy) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 2}});
    std::vector<BodyId> row;
    for (int i = 0; i < 25; ++i)
        row.push_back(world.add(Body{
            .position = {0.4 * i, 0.5}, .shapes = {{.geometry = Box{0.1, 1}}}, .restitution = 0, .friction = 0.6}));
    world.set_velocity(row[0], {0.5, 0}, -1);
    double before = energy(world).total();
    while (world.time() < 4.5) {
        world.step(1.0 / 240);
        const double now = energy(world).total();
        EXPECT_LT(now, before + 0.03) << world.time();
        before = now;
    }
    EXPECT_NEAR(world.angle(row.back()), -3.14159265358979323846 / 2, 0.01);  // the last one has fallen flat
}

}  // namespace
}  // namespace carom
