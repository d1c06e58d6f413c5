// A handle that is as strong as it has to be booked none of what its damping took: all of it was residual.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

namespace carom {
namespace {

TEST(Handle, BooksWhatItDamps) {
    for (const std::optional<double> most : {std::optional<double>(), std::optional(1e5), std::optional(200.0)}) {
        World world({.solver = SoftStep{}});
        const BodyId b = world.add(Body{.position = {0.6, 0.8}, .mass = 1, .radius = 0.1});
        world.add(Joint{.b = b, .type = DragHandle{.maximum = most}});
        const double stored = energy(world).spring;
        run(world, 2, 1.0 / 60);
        const Energy e = energy(world);
        EXPECT_NEAR(e.heat.joint_damping, stored, 1e-3 * stored) << most.value_or(0);
        EXPECT_LE(std::abs(e.residual), 1e-3 * stored) << most.value_or(0);
        EXPECT_LE(std::abs(e.unaccounted()), 1e-10 * stored) << most.value_or(0);
    }
}

TEST(Handle, PullsByItsLargestForceAllTheSameWhicheverWay) {
    World world({.solver = SoftStep{}});
    const BodyId b = world.add(Body{.velocity = {0, 30}, .mass = 1, .radius = 0.1});
    const JointId hand = world.add(Joint{.b = b, .anchor_a = {3, 0}, .type = DragHandle{.maximum = 5}});
    double most = 0;
    run(world, 0.2, 1.0 / 60, [&](const World& w) { most = std::max(most, length(w.reaction(hand).force)); });
    EXPECT_NEAR(most, 5, 1e-6);
}

}  // namespace
}  // namespace carom
