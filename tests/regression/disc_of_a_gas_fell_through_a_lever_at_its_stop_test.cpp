// An inelastic disc of an exact gas that landed on a lever at its stop drove that through the stop: it fell on for
// ever, or, without gravity, ended the run with "the gas is jammed", for the stop that turned the lever back struck it
// again and again.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(DiscOfAGasOnALeverAtItsStop, StaysThere) {
    for (const double gravity : {0.0, -10.0})
        for (const double friction : {0.0, 0.3}) {
            World world({.gravity = {0, gravity}, .solver = Events{}});
            const BodyId lever = world.add(Body{.position = {0.4, 0},
                                                .mass = 0.2,
                                                .shapes = {{.geometry = Capsule{{-0.4, 0}, {0.4, 0}, 0.08}}},
                                                .restitution = 0,
                                                .friction = friction});
            world.add(Joint{.b = lever, .at = Vec2{0, 0}, .type = RevoluteJoint{.limits = {0, 1}}});
            const BodyId disc = world.add(Body{.position = {0.5, 0.6},
                                               .velocity = {0, -5},
                                               .mass = 0.08,
                                               .radius = 0.135,
                                               .restitution = 0,
                                               .friction = friction});
            run(world, 2, 1.0 / 60);
            // What lies on something trembles by millionths of its size under the rule against collapse.
            EXPECT_NEAR(world.position(disc).y, 0.08 + 0.135, 1e-5) << gravity << ' ' << friction;
            EXPECT_NEAR(world.velocity(disc).y, 0, 1e-3) << gravity << ' ' << friction;
            EXPECT_NEAR(world.angle(lever), 0, 1e-6) << gravity << ' ' << friction;
            EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-12) << gravity << ' ' << friction;
        }
}

}  // namespace
}  // namespace carom
