// The option keep_energy: what the method makes or loses is taken from the motion, or given to it.

#include <array>

#include "error_of.hpp"
#include "joints.hpp"
#include "reference/truth.hpp"

namespace carom {
namespace {

using namespace test;

World keeping(Vec2 g = {0, -gravity}) { return mechanism_world({.keep_energy = true}, g); }

/// The issue asks for 1e-5 of m g L at 1/60 s and four substeps; what is left is the rounding of 14400 of these.
TEST(KeepsEnergy, OfAPinnedPendulumForAMinute) {
    World world = keeping();
    const BodyId bob = world.add(Body{.position = {1, 0}, .mass = 1, .moment_of_inertia = 0.01});
    world.add(Joint{.b = bob, .at = Vec2{}, .type = RevoluteJoint{}});
    double worst = 0;
    watch(world, 60, [&] { worst = std::max(worst, std::abs(energy(world).total()) / gravity); });
    EXPECT_LE(worst, 1e-11);
}

/// truth.json, mech.double.pendulum: of second order still.
TEST(KeepsEnergy, OfADoublePendulumAndConvergesAtOrderTwo) {
    const double first = truth("mech.double.pendulum")[2][0], second = truth("mech.double.pendulum")[2][1];
    const auto error = [&](double step) {
        World world = keeping();
        const BodyId a = world.add(Body{.position = {1, 0}, .mass = 1}),
                     b = world.add(Body{.position = {2, 0}, .mass = 1});
        world.add(Joint{.b = a, .type = DistanceJoint{}});
        world.add(Joint{.a = a, .b = b, .type = DistanceJoint{}});
        run(world, 5, step);
        EXPECT_NEAR(energy(world).total(), 0, 1e-10);  // of 30 J; rods are kept to 1e-11 m
        const Vec2 p = world.position(a), q = world.position(b) - p;
        return std::array{std::atan2(p.x, -p.y) - first, std::atan2(q.x, -q.y) - second};
    };
    const auto fine = error(1.0 / 960), coarse = error(1.0 / 480);
    EXPECT_NEAR(fine[0], 0, 1e-5);
    EXPECT_NEAR(fine[1], 0, 1e-5);
    EXPECT_NEAR(std::log2(coarse[0] / fine[0]), 2, 0.02);
    EXPECT_NEAR(std::log2(coarse[1] / fine[1]), 2, 0.02);
}

/// What springs damp and brakes rub off is heat, and the method's own account stays empty.
TEST(KeepsEnergy, AndLosesWhatIsHeat) {
    World world = keeping();
    RevoluteJoint hinge;
    hinge.spring = JointSpring{.stiffness = 20, .damping = 0.1};
    hinge.motor = JointMotor{.speed = 0, .maximum = 0.05};
    std::optional<BodyId> last;
    for (int i = 0; i < 3; ++i) {
        const BodyId next = world.add(rod({0.5 + i, 0}, 1));
        world.add(Joint{.a = last, .b = next, .at = Vec2{1.0 * i, 0}, .type = hinge});
        last = next;
    }
    double worst = 0;
    watch(world, 10, [&] { worst = std::max(worst, std::abs(energy(world).residual)); });
    const Energy end = energy(world);
    EXPECT_GT(end.heat.joint_damping, 1);
    EXPECT_GT(end.heat.joint_friction, 0.1);
    // Where a brake takes hold in the midst of a substep more than a thousandth is missing, and stays so.
    EXPECT_LE(worst, 1e-3 * (end.heat.joint_damping + end.heat.joint_friction));
}

/// What flies freely keeps its momentum and its spin as well: only the motion of its bodies in one another is changed.
TEST(KeepsEnergy, OfWhatIsThrownAndItsMomentum) {
    World world = keeping({});
    std::optional<BodyId> last;
    for (int i = 0; i < 5; ++i) {
        const BodyId next =
            world.add(Body{.position = {0.5 * i, 0}, .velocity = {1, 2.0 * i}, .mass = 1, .moment_of_inertia = 0.02});
        if (last) world.add(Joint{.a = last, .b = next, .at = Vec2{0.5 * i - 0.25, 0}, .type = RevoluteJoint{}});
        last = next;
    }
    run(world, frame, frame);  // joints take what they can not have
    const double before = energy(world).total();
    const Momentum was = momentum_balance(world).total;
    watch(world, 20, [] {});
    const Momentum is = momentum_balance(world).total;
    EXPECT_NEAR(energy(world).total(), before, 1e-11 * before);
    EXPECT_LE(length(is.linear - was.linear), 1e-11 * length(was.linear));
    EXPECT_NEAR(is.angular, was.angular, 1e-9 * std::abs(was.angular));
}

/// A bob under symplectic Euler could hang anywhere: its energy was the same there.
TEST(KeepsEnergy, WithMethodsOfSecondOrderAlone) {
    for (const Integrator& method : {Integrator(Euler{}), Integrator(SymplecticEuler{})}) {
        World world({.gravity = {0, -gravity}, .integrator = method, .solver = SoftStep{.keep_energy = true}});
        const BodyId bob = world.add(Body{.position = {0, -1}});
        world.add(Joint{.b = bob, .type = DistanceJoint{}});
        EXPECT_EQ(error_of([&] { world.step(frame); }),
                  std::string("SoftStep.keep_energy needs a method of second order: what '") +
                      (std::holds_alternative<Euler>(method) ? "euler" : "symplectic-euler") +
                      "' keeps is another energy; use 'verlet'");
    }
}

}  // namespace
}  // namespace carom
