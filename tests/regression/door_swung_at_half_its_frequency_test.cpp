// The frequency of a joint's spring was that of bodies that the joint itself does not hold: a door that is hinged at
// its edge swung at half of it, and with a damping ratio of 1 passed where it is to rest.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

namespace carom {
namespace {

using std::numbers::pi;

Body bar(Vec2 at, double mass) { return {.position = at, .mass = mass, .shapes = {{.geometry = Box{2, 0.2}}}}; }

TEST(Door, SwingsAtItsFrequency) {
    World world({.solver = SoftStep{}});
    const BodyId door = world.add(Body{.position = {0.45, 0}, .mass = 20, .shapes = {{.geometry = Box{0.9, 0.04}}}});
    world.add(Joint{
        .b = door, .at = Vec2{}, .type = RevoluteJoint{.spring = JointSpring{.frequency = 1, .damping_ratio = 0.2}}});
    world.set_velocity(door, {0, 0.45}, 1);
    const double own = 2 * pi, damped = own * std::sqrt(1 - 0.04);
    double worst = 0;
    run(world, 3, 1.0 / 960, [&](const World& w) {
        const double t = w.time(), right = std::exp(-0.2 * own * t) * std::sin(damped * t) / damped;
        worst = std::max(worst, std::abs(w.angle(door) - right));
    });
    EXPECT_LE(worst, 1e-4 / damped);
}

/// What a spring of 1 Hz has for a stiffness.
template <class T>
double stiffness(World& world, Joint joint, T type) {
    type.spring = JointSpring{.frequency = 1};
    joint.type = type;
    return std::get<T>(world.joint(world.add(joint)).type).spring->stiffness / (4 * pi * pi);
}

TEST(Slide, HasTheMassThatGoesAlongIt) {
    World world({.solver = SoftStep{}});
    const BodyId b = world.add(Body{.mass = 2, .shapes = {{.geometry = Box{0.4, 0.4}}}});
    EXPECT_NEAR(stiffness(world, {.b = b, .at = Vec2{0, 0.5}}, PrismaticJoint{.axis = {1, 0}}), 2, 1e-12);
}

TEST(Weld, HasTheMomentOfBothAboutItsPoint) {
    World world({.solver = SoftStep{}});
    const BodyId a = world.add(bar({-1, 0}, 2)), b = world.add(bar({1, 0}, 3));
    // Two bars that bend about their common end turn with rates of (I_b + 2 µ) and (I_a + 2 µ), each its own way: then
    // they have no spin together, with 2 m between the centres and µ the reduced mass of these.
    const double of_a = 2 * 4.04 / 12, of_b = 3 * 4.04 / 12, reduced = 2.0 * 3 / 5;
    const double p = of_b + 2 * reduced, q = of_a + 2 * reduced;
    const double moment = (of_a * p * p + of_b * q * q + reduced * (p - q) * (p - q)) / ((p + q) * (p + q));
    EXPECT_NEAR(stiffness(world, {.a = a, .b = b, .at = Vec2{}}, WeldJoint{}), moment, 1e-9 * moment);
}

}  // namespace
}  // namespace carom
