// Forces that look at velocities, beside joints: what they see is what the joints leave of these.

#include <array>

#include "joints.hpp"

namespace carom {
namespace {

using namespace test;

constexpr double linear = 1.5, quadratic = 0.3, odd_time = 1.37;

Vec2 drag_on(Vec2 v) { return -(linear + quadratic * length(v)) * v; }

/// Of x'' = a(x, x') from rest, by the classical Runge-Kutta method in steps too short to count.
template <class Acceleration>
Vec2 flown(Vec2 x, Acceleration a) {
    constexpr int steps = 20000;
    constexpr double h = odd_time / steps;
    Vec2 v{};
    for (int i = 0; i < steps; ++i) {
        const Vec2 k1 = v, l1 = a(x, k1), k2 = v + h / 2 * l1, l2 = a(x + h / 2 * k1, k2);
        const Vec2 k3 = v + h / 2 * l2, l3 = a(x + h / 2 * k2, k3), k4 = v + h * l3, l4 = a(x + h * k3, k4);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    }
    return x;
}

/// Where a mass of 1 kg is that a joint holds to the origin, 1 m away at first, after so many steps.
Vec2 hung(const JointType& joint, Integrator integrator, int steps) {
    World world({.gravity = {0, -gravity}, .integrator = integrator, .solver = SoftStep{}});
    const BodyId bob = world.add(Body{.position = {1, 0}, .mass = 1});
    world.add(Joint{.b = bob, .type = joint});
    world.add(Drag{.linear = linear, .quadratic = quadratic});
    run(world, odd_time, odd_time / steps);
    return world.position(bob);
}

/// Of the errors of 82 steps and of twice as many.
double order(const std::array<Vec2, 2>& errors) { return std::log2(length(errors[0]) / length(errors[1])); }

class DragBesideJoints : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, DragBesideJoints, testing::Values(Verlet{}, Pefrl{}, Rk4{}, Implicit{}));

TEST_P(DragBesideJoints, IsOfSecondOrderOnARod) {
    const Vec2 there = flown({1, 0}, [](Vec2 x, Vec2 v) {
        const Vec2 free = drag_on(v) - Vec2{0, gravity};
        return free - (dot(free, x) + dot(v, v)) / dot(x, x) * x;
    });
    const auto error = [&](int steps) { return hung(DistanceJoint{}, GetParam(), steps) - there; };
    EXPECT_NEAR(order({error(82), error(164)}), 2, 0.05);
}

/// Along a spring the drag is not the joint's to bear: here its error was of first order, 2e-4 m.
TEST_P(DragBesideJoints, IsOfSecondOrderOnASpring) {
    constexpr double stiffness = 100;
    const Vec2 there = flown({1, 0}, [](Vec2 x, Vec2 v) {
        return drag_on(v) - Vec2{0, gravity} - stiffness * (1 - 1 / length(x)) * x;
    });
    const DistanceJoint strut{.spring = JointSpring{.stiffness = stiffness}};
    const auto error = [&](int steps) { return hung(strut, GetParam(), steps) - there; };
    EXPECT_NEAR(order({error(82), error(164)}), 2, 0.05);
    EXPECT_LE(length(error(164)), 1e-5);
}

/// Where the drag is on one of two bodies only, joints pass it on.
TEST_P(DragBesideJoints, IsOfSecondOrderOnAChain) {
    const auto end = [](int steps) {
        World world({.gravity = {0, -gravity}, .integrator = GetParam(), .solver = SoftStep{}});
        const BodyId a = world.add(Body{.position = {1, 0}, .mass = 1});
        const BodyId b = world.add(Body{.position = {2, 0}, .mass = 3});
        world.add(Joint{.b = a, .type = DistanceJoint{}});
        world.add(Joint{.a = a, .b = b, .type = DistanceJoint{}});
        world.add(Drag{.body = a, .linear = linear, .quadratic = quadratic});
        run(world, odd_time, odd_time / steps);
        return world.position(b);
    };
    const Vec2 coarse = end(82), middle = end(164), fine = end(328);
    EXPECT_NEAR(order({coarse - middle, middle - fine}), 2, 0.05);
}

/// What hangs at rest pulls with its weight: off by (γ h / 2)², the square of what joints give in half a substep.
TEST(DragBesideJointsAtRest, IsNone) {
    constexpr double rate = 5, half = rate * frame / 8;
    World world = mechanism_world({.sleep = false, .statics = false});
    const BodyId still = world.add(Body{.position = {0, -1}, .mass = 1});
    const JointId rod = world.add(Joint{.b = still, .type = DistanceJoint{}});
    const BodyId sagging = world.add(Body{.position = {1, -1}, .mass = 1});
    world.add(Joint{.b = sagging,
                    .anchor_a = {1, 0},
                    .type = DistanceJoint{.spring = JointSpring{.stiffness = 100, .damping = 20}}});
    world.add(Drag{.linear = rate});
    watch(world, 10, [] {});
    EXPECT_NEAR(world.reaction(rod).force.y, gravity, 1.2 * half * half * gravity);
    EXPECT_NEAR(-1 - world.position(sagging).y, gravity / 100, 1.2 * half * half * gravity / 100);
}

}  // namespace
}  // namespace carom
