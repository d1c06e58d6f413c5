// A disc of an exact gas that struck a box so that its slip turned around within the blow was rubbed by no more than
// μ times the whole impulse, as if it had slipped one way: of 1185 blows 39 were off Routh's hodograph by more than
// 0.01. Gas and SoftStep follow the slip by one text now (solvers/hodograph.hpp).

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

struct After {
    double box, disc, rubbed;
};

After strike(const Solver& solver) {
    World world({.solver = solver});
    const double e = 0.83, friction = 0.080554423;
    const BodyId box = world.add(Body{.angle = -2.66174,
                                      .velocity = {-0.02053, 0.05825},
                                      .angular_velocity = -1.07945,
                                      .mass = 1.5,
                                      .shapes = {{.geometry = Box{.width = 1.2, .height = 0.7, .rounding = 0.03}}},
                                      .restitution = e,
                                      .friction = friction});
    const BodyId disc = world.add(Body{.position = {3 - 0.14344, 0.1588},
                                       .velocity = {-3, 0},
                                       .angular_velocity = -4.62361,
                                       .mass = 0.8,
                                       .radius = 0.3,
                                       .restitution = e,
                                       .friction = friction});
    run(world, 1.2, 0.01);
    return {world.angular_velocity(box), world.angular_velocity(disc), energy(world).heat.friction};
}

TEST(SlipThatTurnsAround, IsFollowedInAHitOfTheGas) {
    const After gas = strike(Events{}), soft = strike(SoftStep{});
    // By hand; the start is given to five digits, and a lever turns with them.
    EXPECT_NEAR(gas.box, 2.1506, 2e-3);
    EXPECT_NEAR(gas.disc, -4.8741, 2e-3);
    // SoftStep finds the instant by steps, and the corner with it to 1e-4.
    EXPECT_NEAR(gas.box, soft.box, 1e-3);
    EXPECT_NEAR(gas.disc, soft.disc, 1e-3);
    EXPECT_NEAR(gas.rubbed, soft.rubbed, 1e-3 * soft.rubbed);
}

}  // namespace
}  // namespace carom
