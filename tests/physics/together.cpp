// An exact gas and bodies that are moved in steps, in one scene: every hit against the algebra of impacts, the books of
// both, and closed forms of what a gas does to a piston.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <string>

#include "error_of.hpp"
#include "throughput.hpp"

namespace carom {
namespace {

using test::error_of;

constexpr double pi = 0x1.921fb54442d18p1;

Shape box(double width, double height, double restitution = 1, double friction = 0) {
    return {.geometry = Box{.width = width, .height = height}, .restitution = restitution, .friction = friction};
}

/// What an impact may not change: a disc, and a free box that turns.
struct Kept {
    Vec2 momentum;
    double angular, energy;

    explicit Kept(const World& world) {
        const Momentum m = momentum_balance(world).total;
        momentum = m.linear, angular = m.angular, energy = carom::energy(world).total();
    }
};

World disc_and_box(double restitution, double friction) {
    World world({.solver = Events{}});
    world.add(Body{.angle = 0.3,
                   .velocity = {0.1, 0.05},
                   .angular_velocity = 0.7,
                   .mass = 3,
                   .shapes = {box(1, 0.6, restitution, friction)},
                   .name = "box"});
    world.add(Body{.position = {-3, 0.2},
                   .velocity = {2, 0},
                   .radius = 0.2,
                   .restitution = restitution,
                   .friction = friction,
                   .name = "disc"});
    return world;
}

/// In free flight the way of a body is a straight line and its turning even, so that a step adds nothing to an impact but
/// rounding: some hundred roundings of 1e-16 in a run.
TEST(Together, AFreeBoxAndADiscKeepWhatAnImpactKeeps) {
    for (const double friction : {0.0, 0.4}) {
        World world = disc_and_box(1, friction);
        const Kept before(world);
        run(world, 3, 0.05);
        const Kept after(world);
        EXPECT_EQ(world.gas().wall_collisions, 1u);
        EXPECT_NEAR(length(after.momentum - before.momentum), 0, 1e-14);
        EXPECT_NEAR(after.angular, before.angular, 1e-13);
        EXPECT_NEAR(after.energy + energy(world).heat.total(), before.energy, 1e-13);
        EXPECT_NEAR(energy(world).residual, 0, 1e-13);
        if (friction == 0)
            EXPECT_EQ(energy(world).heat.total(), 0);
        else
            EXPECT_GT(energy(world).heat.friction, 1e-3);
    }
}

/// The steps are only how often somebody looks, where no force acts.
TEST(Together, FreeBodiesDoNotFeelTheStep) {
    World coarse = disc_and_box(0.6, 0.3), fine = disc_and_box(0.6, 0.3);
    run(coarse, 3, 0.5), run(fine, 3, 0.01);
    for (const char* name : {"box", "disc"}) {
        const BodyId id = coarse.find(name);
        EXPECT_NEAR(length(coarse.position(id) - fine.position(id)), 0, 1e-12);
        EXPECT_NEAR(coarse.angle(id), fine.angle(id), 1e-12);
    }
}

}  // namespace
}  // namespace carom
