// What a joint remembers of its rows, such as that it slips or is at a limit, was taken for that of the rows of
// whatever it was changed to: a friction joint that became a hinge flung its body away at 1e32 m/s.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

/// Of every type, with and without springs, motors and limits.
std::vector<JointType> all_types() {
    std::vector<JointType> all{GearJoint{.ratio = -3, .sum = -7},
                               PulleyJoint{{0, 3}, {1, 4}},
                               FrictionJoint{0.1, 0.1},
                               FrictionJoint{50, 50},
                               DragHandle{},
                               DragHandle{.maximum = 1},
                               MotorJoint{{1, 0}, 1},
                               MotorJoint{{1, 0}, 1, 0.1, 0.1},
                               FilterJoint{}};
    for (int k = 0; k < 8; ++k) {
        std::optional<JointSpring> spring;
        std::optional<JointMotor> motor;
        if (k & 1) spring = JointSpring{.stiffness = 40, .damping = 0.3};
        if (k & 2) motor = JointMotor{.speed = 2, .maximum = 1};
        const JointLimits limits = k & 4 ? JointLimits{-0.1, 0.1} : JointLimits{};
        all.push_back(RevoluteJoint{.spring = spring, .motor = motor, .limits = limits});
        all.push_back(PrismaticJoint{.spring = spring, .motor = motor, .limits = limits});
        all.push_back(WheelJoint{.spring = spring, .motor = motor, .limits = limits});
        if (!motor) all.push_back(WeldJoint{.spring = spring});
        if (!motor) all.push_back(DistanceJoint{.length = 1.5, .spring = spring});
    }
    return all;
}

TEST(JointOfAnotherType, DoesNotGoOnAsTheOneItWas) {
    const std::vector<JointType> all = all_types();
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = 0; k < all.size(); ++k) {
            World world({.gravity = {0, -5}, .solver = SoftStep{}});
            const BodyId body =
                world.add(Body{.velocity = {1, 2}, .angular_velocity = 3, .shapes = {{.geometry = Box{0.2, 0.15}}}});
            const JointId id =
                world.add(Joint{.b = body, .anchor_a = {-1, -1}, .anchor_b = {-0.1, 0.5}, .type = all[i]});
            for (int step = 0; step < 2; ++step) world.step(0.01);
            Joint changed = world.joint(id);
            changed.type = all[k];
            world.set(id, changed);
            for (int step = 0; step < 20; ++step) world.step(0.05);
            // It falls for a second, and a motor without a bound turns it on an arm of half a metre.
            EXPECT_LE(length(world.velocity(body)), 50) << i << " to " << k;
            EXPECT_LE(std::abs(world.angular_velocity(body)), 100) << i << " to " << k;
        }
}

}  // namespace
}  // namespace carom
