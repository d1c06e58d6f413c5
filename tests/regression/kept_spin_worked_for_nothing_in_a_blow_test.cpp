// What keeps the spin of a body of fixed rotation works in a blow on what is jointed to it. In a substep that was
// booked as work of whoever drives bodies, and in a blow as an error of the method: 6.4 J of 4.7.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

TEST(KeptSpin, WorksInABlowForWhoeverKeepsIt) {
    for (const JointType& type : {JointType{WeldJoint{}}, JointType{PrismaticJoint{.limits = JointLimits{0.0, 0.0}}}}) {
        World world({.solver = SoftStep{}});
        const BodyId hub = world.add(Body{.angular_velocity = 3, .mass = 1, .fixed_rotation = true, .radius = 0.2});
        const BodyId club = world.add(Body{.position = {1, 0},
                                           .velocity = {0, 3},
                                           .angular_velocity = 3,
                                           .mass = 1,
                                           .shapes = {{.geometry = Box{.width = 0.6, .height = 0.2}}}});
        world.add(Joint{.a = hub, .b = club, .at = Vec2{0.5, 0}, .type = type});
        world.add(Body{.position = {1, 0.45}, .mass = 1, .radius = 0.3});
        const double before = energy(world).total();
        run(world, 0.1, 1.0 / 60);
        const Energy e = energy(world);
        EXPECT_EQ(world.collisions(), 1U);
        EXPECT_EQ(world.angular_velocity(hub), 3);
        // The blow without a loss is an impulse of so much: the work is exact but for what the method adds to a turn.
        EXPECT_GT(e.total() - before, 1);
        EXPECT_NEAR(e.work.driven, e.total() - before, 1e-3 * before);
        EXPECT_LT(std::abs(e.residual), 1e-3 * before);
        EXPECT_LT(std::abs(e.unaccounted()), 1e-12 * before);
    }
}

}  // namespace
}  // namespace carom
