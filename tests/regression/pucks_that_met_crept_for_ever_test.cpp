// Two pucks on a table, seen from above: dry friction stops them, a joint each, and one met the other. They went on at
// up to 2.4e-9 m/s for ever, and never slept. What touches something begins with the forces of the substep before and
// was let be where no row missed more than what is taken for no gap; but friction has no place to go back to. And
// without gravity nothing says what is slow: what was left of the forces of the two, rounding, kept them awake.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>

namespace carom {
namespace {

constexpr double puck_mass = 0.17, puck_radius = 0.0286, held_by = 0.033;  // kg, m, N

World two_pucks(int number, double restitution, bool sleep) {
    World world({.solver = SoftStep{.sleep = sleep}});
    const Vec2 place[2] = {{0, 0}, {0.0572 + 0.0001 * (number % 20), 0.001 * (number / 20)}};
    for (int n = 0; n < 2; ++n) {
        const BodyId id = world.add(Body{.position = place[n],
                                         .velocity = {n == 0 ? 0.02 + 0.001 * number : 0, 0},
                                         .mass = puck_mass,
                                         .radius = puck_radius,
                                         .restitution = restitution,
                                         .friction = 0.05});
        world.add(Joint{
            .b = id, .anchor_a = place[n], .type = FrictionJoint{.maximum_force = held_by, .maximum_torque = 4.7e-4}});
    }
    run(world, 6, 1.0 / 60);  // the fastest, of 0.4 m/s, would stop in 2.1 s alone
    return world;
}

TEST(PucksThatMet, StopAndFallAsleep) {
    for (const double restitution : {0.0, 0.5, 0.95})
        for (int number = 0; number < 400; number += 9) {
            const World world = two_pucks(number, restitution, true);
            for (const BodyId id : world.ids()) EXPECT_TRUE(world.asleep(id)) << restitution << ", pair " << number;
        }
}

TEST(PucksThatMet, StopToRoundingWhereNobodySleeps) {
    constexpr double rounding = 2.2e-16, substep = 1.0 / 240;
    constexpr double stopped_at_most = held_by / puck_mass * substep;  // in a substep: 8e-4 m/s
    for (int number = 0; number < 400; number += 9) {
        const World world = two_pucks(number, 0, false);
        for (const Vec2 v : world.velocities()) EXPECT_LE(length(v), rounding * stopped_at_most) << "pair " << number;
    }
}

}  // namespace
}  // namespace carom
