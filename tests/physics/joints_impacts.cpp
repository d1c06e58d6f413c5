// Impacts on mechanisms: an impulse goes through their joints at its instant.

#include "joints.hpp"

namespace carom {
namespace {

using namespace test;

/// A step so short that nothing turns by more than 1e-6 rad in it; the ball is there after a tenth of it.
constexpr double instant = 1e-5;
constexpr double speed = 1, ball_mass = 0.3, ball_radius = 0.05;

BodyId add_ball(World& world, Vec2 touching, double restitution) {
    return world.add(Body{.position = touching - Vec2{ball_radius + 0.1 * instant * speed, 0},
                          .velocity = {speed, 0},
                          .mass = ball_mass,
                          .radius = ball_radius,
                          .restitution = restitution});
}

/// A pole of 2 kg and 1 m hangs on a pin, and a ball strikes it so far below that.
struct Pole {
    static constexpr double length = 1, mass = 2, inertia = mass * length * length / 3;  // about the pin
    World world = mechanism_world({}, {});
    BodyId ball{};

    Pole(double depth, double restitution) {
        const BodyId pole = world.add(Body{.position = {0, -length / 2},
                                           .mass = mass,
                                           .moment_of_inertia = inertia / 4,
                                           .shapes = {{.geometry = Box{0.1, length}}},
                                           .restitution = restitution});
        world.add(Joint{.b = pole, .at = Vec2{}, .type = RevoluteJoint{}});
        ball = add_ball(world, {-0.05, -depth}, restitution);
    }
    static double impulse(double depth, double restitution) {
        return (1 + restitution) * speed / (1 / ball_mass + depth * depth / inertia);
    }
};

/// The ball's impulse turns the pole about its pin, J (1/m + d²/I) = (1 + e) v.
TEST(PhysicalPendulum, TakesAnImpulseAboutItsPin) {
    for (const double e : {1.0, 0.5, 0.0})
        for (const double depth : {0.2, 2.0 / 3, 0.9}) {
            Pole pole(depth, e);
            watch(
                pole.world, instant, [] {}, instant);
            const double given = ball_mass * (speed - pole.world.velocity(pole.ball).x);
            EXPECT_NEAR(given, Pole::impulse(depth, e), 1e-5 * given) << "e = " << e << " at " << depth << " m";
            const double heat = 0.5 * (1 - e) * speed * given;  // J (1 − e)/2 of the approach
            EXPECT_NEAR(energy(pole.world).heat.impact, heat, 1e-5 * speed * given) << "e = " << e;
        }
}

/// The pin bears J (3 d / 2 L − 1): nothing if the blow is at the centre of percussion.
TEST(PhysicalPendulum, BearsABlowAtItsCentreOfPercussion) {
    for (const double depth : {0.2, 0.5, 2.0 / 3, 0.9}) {
        Pole pole(depth, 1);
        pole.world.step(instant);
        const double given = Pole::impulse(depth, 1), borne = given * (1.5 * depth / Pole::length - 1);
        EXPECT_NEAR(momentum_balance(pole.world).held.linear.x, borne, 1e-5 * given) << depth;
    }
}

/// Of the ball's speed a block on two rods that do not let it turn takes what it would take if it were free; on one rod
/// that is welded to it the rod's inertia counts.
TEST(BallisticPendulum, OnRods) {
    constexpr double block = 5, height = 2, rod_mass = 1.5;
    for (const double e : {1.0, 0.5, 0.0}) {
        World world = mechanism_world({}, {});
        const Body box{
            .position = {0, -height}, .mass = block, .shapes = {{.geometry = Box{0.4, 0.4}}}, .restitution = e};
        const BodyId hung = world.add(box);
        for (const double x : {-0.15, 0.15})
            world.add(Joint{.b = hung, .anchor_a = {x, 0.2}, .anchor_b = {x, 0.2}, .type = DistanceJoint{}});
        const BodyId first = add_ball(world, {-0.2, -height + 0.13}, e);

        Body away = box;
        away.position.x = 10;
        const BodyId bob = world.add(away);
        const BodyId arm = world.add(Body{
            .position = {10, -height / 2}, .mass = rod_mass, .moment_of_inertia = rod_mass * height * height / 12});
        world.add(Joint{.b = arm, .at = Vec2{10, 0}, .type = RevoluteJoint{}});
        world.add(Joint{.a = arm, .b = bob, .at = Vec2{10, -height}, .type = WeldJoint{}});
        const BodyId second = add_ball(world, {10 - 0.2, -height}, e);
        const double own = block * 0.4 * 0.4 / 6,
                     inertia = rod_mass * height * height / 3 + own + block * height * height;

        watch(
            world, instant, [] {}, instant);
        const auto slower = [&](double ease) { return (1 + e) * speed / (1 + ball_mass * ease); };
        EXPECT_NEAR(speed - world.velocity(first).x, slower(1 / block), 1e-5) << "e = " << e;
        EXPECT_NEAR(speed - world.velocity(second).x, slower(height * height / inertia), 1e-5) << "e = " << e;
    }
}

/// An elastic blow in the middle of a chain keeps the energy, and what hangs together moves off at once.
TEST(HangingChain, KeepsTheEnergyOfAnElasticBlow) {
    World world = mechanism_world({}, {});
    std::optional<BodyId> last;
    for (int i = 0; i < 5; ++i) {
        const BodyId next =
            world.add(Body{.position = {0, -0.5 - i}, .mass = 1, .shapes = {{.geometry = Box{0.1, 0.9}}}});
        world.add(Joint{.a = last, .b = next, .at = Vec2{0, -1.0 * i}, .type = RevoluteJoint{}});
        last = next;
    }
    add_ball(world, {-0.05, -2.7}, 1);
    const double before = energy(world).total();
    watch(
        world, instant, [] {}, instant);
    EXPECT_NEAR(energy(world).total(), before, 1e-10 * before);  // rods turn by 1e-5 rad, of which it is the square
    EXPECT_NEAR(energy(world).heat.impact, 0, 1e-15 * before);
    EXPECT_GT(std::abs(world.velocity(*last).x), 1e-3 * speed);
}

/// Friction of the blow goes through joints as well, and makes no energy.
TEST(HangingChain, RubbedByABlowLosesEnergy) {
    World world = mechanism_world({}, {});
    const BodyId pole = world.add(Body{
        .position = {0, -0.5}, .mass = 1, .shapes = {{.geometry = Box{0.1, 1}}}, .restitution = 1, .friction = 0.5});
    world.add(Joint{.b = pole, .at = Vec2{}, .type = RevoluteJoint{}});
    const BodyId ball = add_ball(world, {-0.05, -0.7}, 1);
    Body rough = world.body(ball);
    rough.friction = 0.5, rough.velocity.y = -3;
    world.remove(ball);
    const BodyId rubbing = world.add(rough);
    const double before = energy(world).total();
    watch(
        world, instant, [] {}, instant);
    EXPECT_LT(energy(world).total(), before);
    EXPECT_NEAR(energy(world).heat.friction, before - energy(world).total(), 1e-5 * before);
    // It slides all along, so the tangential impulse is µ times the normal one, and turns the pole's pin none.
    const Vec2 given = ball_mass * (world.velocity(rubbing) - rough.velocity);
    EXPECT_NEAR(given.y, -0.5 * given.x, 1e-5 * length(given));
}

// A block that is welded to the ground touches the floor, and a box that is hinged to it falls on the floor. What the
// weld leaves the block is rounding, which 1e24 N s were to make up for; of so much the books lost 2 N s.
TEST(Blows, WhatIsHeldFastOnTheFloorTakesNone) {
    constexpr double side = 0.48418149553989881;
    World world = mechanism_world({.statics = false});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    const auto box = [&](Vec2 at, double width, double density) {
        return world.add(Body{.position = at,
                              .shapes = {{.geometry = Box{width, width}, .density = density}},
                              .restitution = 0,
                              .friction = 0.5});
    };
    const BodyId block = box({0, side / 2}, side, 382.65772787447662);
    world.add(Joint{.b = block, .at = Vec2{-0.19121681478073715, -0.21518766270954937}, .type = WeldJoint{}});
    const BodyId falls = box({1.440138191478979, 1.9399257604258291}, 0.4, 1);
    world.add(Joint{.a = block,
                    .b = falls,
                    .at = Vec2{-0.0027761625410616386, side / 2 + 0.016240203419158161},
                    .type = RevoluteJoint{}});
    watch(world, 1.5, [] {});
    EXPECT_LE(std::abs(momentum_balance(world).walls.linear.y), 1e3);  // of the box, 10 N s a blow
}

}  // namespace
}  // namespace carom
