// A motor that winds up the spring of its own joint starts with a jerk. What the spring seemed to make of energy in
// that was taken from the bodies, so that the motor had to start again in every substep: it did no work, and what the
// spring took up was the method's.

#include "physics/joints.hpp"

namespace carom::test {
namespace {

TEST(MotorAgainstASpring, DoesTheWorkThatTheSpringTakesUp) {
    constexpr double speed = 2, duration = 2;
    for (const double stiffness : {1e2, 1e3, 1e4}) {
        for (const bool turns : {true, false}) {
            const JointSpring spring{.stiffness = stiffness};
            const JointMotor motor{.speed = speed};
            World world = mechanism_world({}, {});
            const BodyId a = world.add(rod({0, 0}, 1)), b = world.add(rod({1, 0}, 0.8));
            const JointType type = turns ? JointType(RevoluteJoint{.spring = spring, .motor = motor})
                                         : JointType(PrismaticJoint{.spring = spring, .motor = motor});
            const JointId joint = world.add(Joint{.a = a, .b = b, .at = Vec2{0.5, 0}, .type = type});
            run(world, frame, frame);  // the jerk
            const Energy first = energy(world);
            run(world, duration, frame);
            const Energy last = energy(world);
            const double way = speed * (duration + frame), stored = 0.5 * stiffness * way * way;
            EXPECT_NEAR(world.reaction(joint).coordinate, way, 1e-9 * way);
            EXPECT_NEAR(last.spring, stored, 1e-9 * stored);
            const double gain = last.total() - first.total();
            EXPECT_NEAR(last.work.motor - first.work.motor, gain, 1e-6 * stored) << stiffness << ", turns " << turns;
            EXPECT_NEAR(last.residual, first.residual, 1e-6 * stored) << stiffness << ", turns " << turns;
        }
    }
}

}  // namespace
}  // namespace carom::test
