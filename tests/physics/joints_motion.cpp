// Pendula, ropes and linkages against what mechanics says of them.

#include <array>

#include "joints.hpp"
#include "reference/truth.hpp"

namespace carom {
namespace {

using namespace test;

/// E measured from the lowest point.
TEST(Pendulum, OfAPinKeepsItsEnergyForAMinute) {
    World world = mechanism_world();
    const BodyId bob = world.add(Body{.position = {1, 0}, .mass = 1, .moment_of_inertia = 0.01});
    world.add(Joint{.b = bob, .at = Vec2{}, .type = RevoluteJoint{}});
    double worst = 0;
    watch(world, 60, [&] { worst = std::max(worst, std::abs(total(world)) / gravity); });
    EXPECT_LE(worst, 1e-4);  // Box2D's defaults lose 0.017
}

TEST(Pendulum, OfARodKeepsItsEnergyAndItsLength) {
    World world = mechanism_world();
    const BodyId bob = world.add(Body{.position = {1, 0}, .mass = 1});
    world.add(Joint{.b = bob, .type = DistanceJoint{}});
    double worst = 0, stretch = 0;
    watch(world, 60, [&] {
        worst = std::max(worst, std::abs(total(world)) / gravity);
        stretch = std::max(stretch, std::abs(length(world.position(bob)) - 1));
    });
    EXPECT_LE(worst, 1e-4);
    EXPECT_LE(stretch, 1e-11);
}

std::array<double, 2> double_pendulum(double step, double until) {
    World world = mechanism_world();
    const BodyId a = world.add(Body{.position = {1, 0}, .mass = 1}), b = world.add(Body{.position = {2, 0}, .mass = 1});
    world.add(Joint{.b = a, .type = DistanceJoint{}});
    world.add(Joint{.a = a, .b = b, .type = DistanceJoint{}});
    run(world, until, step);
    const Vec2 p = world.position(a), q = world.position(b) - p;
    return {std::atan2(p.x, -p.y), std::atan2(q.x, -q.y)};
}

/// truth.json, mech.double.pendulum.
TEST(DoublePendulum, FollowsTheReferenceAndConvergesAtOrderTwo) {
    const double first = truth("mech.double.pendulum")[2][0], second = truth("mech.double.pendulum")[2][1];
    const auto fine = double_pendulum(1.0 / 960, 5), coarse = double_pendulum(1.0 / 480, 5);
    EXPECT_NEAR(fine[0], first, 1e-5);  // the issue asks for 1e-4
    EXPECT_NEAR(fine[1], second, 1e-5);
    EXPECT_NEAR((coarse[0] - first) / (fine[0] - first), 4, 0.05);
    EXPECT_NEAR((coarse[1] - second) / (fine[1] - second), 4, 0.05);
}

/// Of the ropes in reference/solvers.md, 1.4: a rope that falls from the horizontal with a load of so many rods.
class FallingRope : public testing::TestWithParam<double> {};
TEST_P(FallingRope, DoesNotStretch) {
    World world = mechanism_world();
    add_chain(world, 50, 0.5, GetParam());
    double worst = 0;
    watch(world, 10, [&] { worst = std::max(worst, gaps(world) / 25); });
    EXPECT_LE(worst, 1e-10);  // the issue asks for 1e-5; Box2D stretches by 5.46 with a load of 1000
}
INSTANTIATE_TEST_SUITE_P(Loads, FallingRope, testing::Values(1, 100, 1000));

/// Two discs on a rod or a rope, or welded together, that turn freely by up to four radians a substep. They lost 38 %
/// of their energy in two seconds at 200 rad/s, and 90 % or more at 1000. Joints are kept to 1e-11 of their size in
/// each of 3840 parts of substeps, in which the discs go a tenth of it or more; 7e-8 was measured, of ropes.
TEST(Dumbbell, ThatTurnsFasterThanASubstepSeesKeepsItsEnergy) {
    const DistanceJoint rope{.limits = {.upper = 0.5}};
    for (Joint joint : {Joint{.type = DistanceJoint{}}, Joint{.type = rope}, Joint{.at = Vec2{}, .type = WeldJoint{}}})
        for (const double w : {200.0, 1000.0}) {
            World world = mechanism_world({}, {});
            std::array<BodyId, 2> discs;
            for (const double side : {-1.0, 1.0})
                discs[side > 0] = world.add(Body{.position = {0.25 * side, 0},
                                                 .velocity = {0, 0.25 * side * w},
                                                 .angular_velocity = w,
                                                 .radius = 0.1});
            joint.a = discs[0], joint.b = discs[1];
            world.add(joint);
            const double before = total(world);
            run(world, 2, 1.0 / 60);
            EXPECT_NEAR(total(world) / before, 1, 3840 * 1e-11 * 10) << w;
        }
}

/// A disc that whirls about the point over which its rope goes lost 41 % of its energy in half a second. The other end,
/// of 1000 tons, moves all the same, so that the rope gets shorter by turns. A method of second order is off by 0.28²/8
/// at most at 0.28 rad a part, and 7e-4 was measured.
TEST(Pulley, WhoseLegTurnsFasterThanASubstepSeesKeepsItsEnergy) {
    World world = mechanism_world({}, {});
    const BodyId heavy = world.add(Body{.position = {0, -1}, .mass = 1e6, .radius = 0.1}),
                 light = world.add(Body{.position = {1.25, 0}, .velocity = {0, 50}, .radius = 0.1});
    world.add(Joint{.a = heavy, .b = light, .type = PulleyJoint{.ground_a = {0, 0}, .ground_b = {1, 0}}});
    const double before = total(world);
    run(world, 0.5, 1.0 / 60);
    EXPECT_NEAR(total(world) / before, 1, 1e-3);
}

/// A flywheel that drives a piston with 5700 turns a minute, 2.5 rad a substep: it lost 2 % in five seconds and made 5
/// % at two thirds of that. A method of second order is off by 0.3²/8 at 0.3 rad a part, and 0.0054 was measured.
TEST(SliderCrank, ThatTurnsFasterThanASubstepSeesKeepsItsEnergy) {
    constexpr double r = 0.05, l = 0.15, w = 600;
    World world = mechanism_world({}, {});
    const BodyId wheel = world.add(Body{.angular_velocity = w, .mass = 25, .moment_of_inertia = 0.5}),
                 rods = world.add(Body{.position = {r + l / 2, 0},
                                       .velocity = {0, w * r / 2},
                                       .angular_velocity = -w * r / l,
                                       .mass = 0.3,
                                       .moment_of_inertia = 5.6e-4}),
                 piston = world.add(Body{.position = {r + l, 0}, .mass = 0.36, .moment_of_inertia = 2e-4});
    add_engine_joints(world, wheel, rods, piston, r, l);
    const double before = total(world);
    double worst = 0;
    watch(world, 5, [&] { worst = std::max(worst, std::abs(total(world) / before - 1)); });
    EXPECT_LE(worst, 0.3 * 0.3 / 8);
}

TEST(HangingRope, DoesNotSag) {
    World world = mechanism_world({.statics = false}, {gravity, 0});  // along the rope
    const auto links = add_chain(world, 100, 0.2);
    watch(world, 20, [] {});
    EXPECT_NEAR(world.position(links.back()).x, 19.9, 1e-9);
    EXPECT_LE(gaps(world), 1e-10);
}

/// The pull of a hanging chain is the weight below.
TEST(HangingRope, BearsTheWeightBelow) {
    World world = mechanism_world({.sleep = false, .statics = false}, {gravity, 0});
    add_chain(world, 10, 0.2, 5);
    run(world, 0.5, frame);
    for (std::size_t k = 0; k <= 10; ++k)
        EXPECT_NEAR(world.reaction(world.joint_ids()[k]).force.x, -(15.0 - static_cast<double>(k)) * gravity, 1e-8);
}

}  // namespace
}  // namespace carom
