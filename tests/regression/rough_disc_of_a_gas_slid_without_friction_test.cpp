// Under 'events' a disc that lay on something felt no friction: its bounces, all too small, were made elastic and
// smooth. On a slope on which it had to roll at 2/3 g sin it slid at g sin, and on a floor it slid on for ever.
// On a plate that is moved in steps its run never ended: bounces made elastic were lost in rounding there.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <vector>

#include "trials.hpp"

namespace carom {
namespace {

constexpr double r = 0.3, down = 3.820224, onto = 9.035788, duration = 1.37, start = 1;

enum class Slope { wall, fixed, driven, stepped };

/// A slope along x, and a disc on it that may start above it.
World slope(Slope kind, double restitution, double friction, double height) {
    World world({.gravity = {down, -onto}, .solver = Events{}});
    const Vec2 lift = kind == Slope::driven ? Vec2{0.4, 0.7} : Vec2{};
    world.add(Body{.position = {0, r + height},
                   .velocity = Vec2{start, 0} + lift,
                   .mass = 2,
                   .radius = r,
                   .restitution = restitution,
                   .friction = friction});
    if (kind == Slope::wall) {
        world.add(HalfPlane{.side = {.restitution = restitution, .friction = friction}});
        return world;
    }
    Body plate{
        .velocity = lift, .shapes = {{.geometry = Box{40, 1}}}, .restitution = restitution, .friction = friction};
    plate.position = {0, -0.5};
    if (kind != Slope::stepped) plate.kind = kind == Slope::fixed ? Kind::fixed : Kind::driven;
    const BodyId id = world.add(plate);
    if (kind == Slope::stepped) world.add(Joint{.b = id, .at = plate.position, .type = WeldJoint{}});
    return world;
}

/// How far a disc on the slope can be from one that never leaves it: by what gravity gives in a bounce. One that comes
/// to lie there does so in bounces that are shorter and shorter; they are made elastic when (speed) × (time) is 1e-4 of
/// its radius. What lies there from the start bounces by 1e-4 of that.
double in_a_bounce(double height) { return std::sqrt(0.5 * (height > 0 ? 1e-4 : 1e-8) * r * onto) * 2 / onto * down; }

/// Each blow rounds a few numbers no larger than the energy, by 1.1e-16.
void expect_closed(const World& world) {
    const double rounding = 4 * 1.1e-16 * static_cast<double>(world.collisions());
    EXPECT_NEAR(energy(world).unaccounted(), 0, rounding * energy(world).kinetic);
}

class RoughDiscOnASlope : public testing::TestWithParam<Slope> {};

TEST_P(RoughDiscOnASlope, Rolls) {
    for (const double height : {0.0, 0.02})
        for (const double restitution : {0.0, 0.5, 0.8}) {
            World world = slope(GetParam(), restitution, 1, height);
            const BodyId disc = world.ids()[0];
            const double along = world.velocity(disc).x - start;
            run(world, duration, 0.01);
            // Of its angular momentum about the line of contact, 3/2 m r v where it rolls, gravity alone gives.
            const double rolls = 2.0 / 3 * (start + duration * down);
            EXPECT_NEAR(world.velocity(disc).x - along, rolls, in_a_bounce(height)) << restitution << ' ' << height;
            EXPECT_NEAR(-r * world.angular_velocity(disc), rolls, in_a_bounce(height)) << restitution << ' ' << height;
            expect_closed(world);
        }
}

TEST_P(RoughDiscOnASlope, Slides) {
    for (const double height : {0.0, 0.02})
        for (const double restitution : {0.0, 0.5, 0.8})
            for (const double friction : {0.0, 0.1}) {
                World world = slope(GetParam(), restitution, friction, height);
                const BodyId disc = world.ids()[0];
                const double along = world.velocity(disc).x - start;
                run(world, duration, 0.01);
                // The impulses of all bounces are its weight × time, of those from a height as well.
                const double slides = start + duration * (down - friction * onto);
                const double spins = 2 * friction * onto * duration;
                EXPECT_NEAR(world.velocity(disc).x - along, slides, in_a_bounce(height)) << restitution << friction;
                EXPECT_NEAR(-r * world.angular_velocity(disc), spins, in_a_bounce(height)) << restitution << friction;
                expect_closed(world);
            }
}

INSTANTIATE_TEST_SUITE_P(All, RoughDiscOnASlope,
                         testing::Values(Slope::wall, Slope::fixed, Slope::driven, Slope::stepped));

TEST(RoughDiscOnAFloor, SlidesUntilItRolls) {
    for (const double restitution : {0.0, 0.5, 0.8}) {
        World world({.gravity = {0, -9.81}, .solver = Events{}});
        world.add(HalfPlane{.side = {.restitution = restitution, .friction = 0.3}});
        const BodyId disc = world.add(
            Body{.position = {0, 0.5}, .velocity = {3, 0}, .radius = 0.2, .restitution = restitution, .friction = 0.3});
        run(world, 3, 0.01);
        // Nothing but rounding, of 1e5 blows, each of speeds of 3 m/s at the most.
        EXPECT_NEAR(world.velocity(disc).x, 2, 1e-11) << restitution;
        EXPECT_NEAR(-0.2 * world.angular_velocity(disc), 2, 1e-11) << restitution;
        EXPECT_NEAR(energy(world).heat.friction, 0.5 * 9 - 0.75 * 4, 1e-10) << restitution;
    }
}

// Friction of the weight alone takes nothing in no time: what a heavy disc presses into a corner goes on.
TEST(RoughDiscUnderAHeavyOne, GoesOnInACorner) {
    constexpr double side = 2.34, radius = 0.49;
    for (const double mass : {1e3, 1e6})
        for (std::uint64_t seed = 0; seed < test::trials(20); ++seed) {
            Random random(seed);
            World world({.gravity = {-3, -6}, .solver = Events{}});
            const Side wall{.friction = 0.3};
            world.add(Rectangle{{0, 0}, {side, side}, wall, wall, wall, wall});
            for (const double m : {1.0, mass}) {
                const double at = m == 1 ? radius + 0.1 * random.uniform() : side - radius - 0.1 * random.uniform();
                world.add(Body{.position = {at, at},
                               .velocity = {random.uniform() - 0.5, random.uniform() - 0.5},
                               .mass = m,
                               .radius = radius,
                               .friction = 0.3});
            }
            EXPECT_NO_THROW(run(world, 5, 0.2)) << mass << ' ' << seed << ' ' << world.time();
        }
}

}  // namespace
}  // namespace carom
