// Friction: what holds, what slides and how far, what begins to roll, and what friction alone keeps standing.

#include <numbers>

#include "physics/contacts.hpp"
#include "reference/truth.hpp"

namespace carom::test {
namespace {

using std::numbers::pi;
const SoftStep precise{.precise = Precise::all};

// ---- Sliding --------------------------------------------------------------------------------------------------------

// A milliradian below the angle of friction; a micrometre in a minute is what the issue allows.
TEST(Ramp, ABlockBelowTheAngleOfFrictionDoesNotCreep) {
    World world = ramp_world(std::atan(0.5) - 1e-3, 0.5, precise);
    const BodyId block = world.add(box({0, 0.15}, 0.6, 0.3, 0.5));
    pass(world, 60);
    EXPECT_LE(std::abs(world.position(block).x), 1e-6);
    EXPECT_LE(world.velocity(block).x, 1e-12);
}

TEST(Ramp, ABlockAboveItSlidesAsFarAsTheTextbookSays) {
    constexpr double mu = 0.2;
    World world = ramp_world(pi / 6, mu, precise);
    const BodyId block = world.add(box({0, 0.15}, 0.6, 0.3, mu));
    pass(world, 2);
    EXPECT_NEAR(world.velocity(block).x, 2 * truth("mech.block")[0].get<double>(), 1e-10);
    EXPECT_NEAR(world.position(block).x, truth("mech.block")[1].get<double>(), 1e-10);
}

TEST(Floor, ABoxThrownAlongItStopsAfterItsWay) {
    World world = floor_world(0.2, precise);
    const BodyId block = world.add(box({0, 0.1}, 1, 0.2, 0.2));
    world.set_velocity(block, {5, 0}, 0);
    pass(world, 3);
    EXPECT_NEAR(world.position(block).x, truth("mech.block")[3].get<double>(), 1e-10);
    EXPECT_NEAR(world.velocity(block).x, 0, 1e-12);
    EXPECT_NEAR(energy(world).heat.friction, 12.5, 1e-10);
}

// ---- Rolling --------------------------------------------------------------------------------------------------------

TEST(Ramp, DiscAndHoopRollAtTheirAccelerations) {
    World world = ramp_world(pi / 6, 0.5, precise);
    const BodyId solid = world.add(disc({0, 0.2}, 0.2, 0.5));
    Body rim = disc({-1, 0.2}, 0.2, 0.5);
    rim.moment_of_inertia = 0.04;
    const BodyId hoop = world.add(rim);
    pass(world, 2);
    EXPECT_NEAR(world.velocity(solid).x / 2, truth("mech.roll")[0].get<double>(), 1e-10);
    EXPECT_NEAR(world.velocity(hoop).x / 2, truth("mech.roll")[1].get<double>(), 1e-10);
    EXPECT_NEAR(world.velocity(solid).x + 0.2 * world.angular_velocity(solid), 0, 1e-10);
    EXPECT_NEAR(energy(world).heat.friction, 0, 1e-10);
}

// Angular momentum about the point of contact is kept, whatever the friction does meanwhile.
TEST(Floor, ADiscThrownAlongItRollsAtTwoThirdsOfItsSpeed) {
    World world = floor_world(0.2, precise);
    const BodyId ball = world.add(disc({0, 0.3}, 0.3, 0.2));
    world.set_velocity(ball, {6, 0}, 0);
    pass(world, 3);
    EXPECT_NEAR(world.velocity(ball).x, 4, 1e-10);
    EXPECT_NEAR(world.angular_velocity(ball), -4 / 0.3, 1e-10);
    EXPECT_NEAR(energy(world).heat.friction, 6.0 * 6 / 6, 1e-10);
}

// ---- Balance --------------------------------------------------------------------------------------------------------

/// How far the top of five blocks has dropped in two seconds, each overhanging the next by a share of the harmonic way.
double drop_of_books(double share) {
    World world({.gravity = {0, -g}, .solver = precise});
    Body table = box({-2, -0.5}, 4, 1, 0.5);
    table.kind = Kind::fixed;
    world.add(table);
    double edge = 0, top = 0;
    for (int above = 5; above >= 1; --above) {
        edge += share * 0.5 / above;
        world.add(box({edge - 0.5, top + 0.1}, 1, 0.2, 0.5));
        top += 0.2;
    }
    EXPECT_NEAR(edge / share, truth("mech.bookstack")[4].get<double>(), 1e-12);
    pass(world, 2);
    return top - 0.1 - world.positions().back().y;
}

TEST(Books, StandUpToTheHarmonicOverhangAndFallBeyond) {
    EXPECT_NEAR(drop_of_books(0.999), 0, 1e-9);
    EXPECT_GT(drop_of_books(1.001), 0.01);
}

/// How far the keystone of a semicircular arch of wedges has sunk in two seconds, in units of its radius.
double sink_of_arch(double thickness) {
    World world = floor_world(1, precise);
    constexpr int stones = 17;
    constexpr double part = pi / stones;
    for (int k = 0; k < stones; ++k) {
        Polygon wedge;
        for (const auto& [r, side] :
             {std::pair{1 - thickness / 2, 0}, {1 + thickness / 2, 0}, {1 + thickness / 2, 1}, {1 - thickness / 2, 1}})
            wedge.points.push_back(r * Vec2{std::cos((k + side) * part), std::sin((k + side) * part)});
        world.add(Body{.shapes = {{.geometry = wedge}}, .restitution = 0, .friction = 1});
    }
    const double before = world.positions()[stones / 2].y;
    pass(world, 2);
    return before - world.positions()[stones / 2].y;
}

// Heyman, The Stone Skeleton (1995): 0.1075 for a continuous arch; joints only at the wedges let it be a little
// thinner.
TEST(Arch, StandsIfItIsThickerThanATenthOfItsRadius) {
    EXPECT_LT(sink_of_arch(0.125), 1e-6);
    EXPECT_GT(sink_of_arch(0.08), 0.1);
}

// ---- Dominoes -------------------------------------------------------------------------------------------------------

/// Speed of the wave from the fifth to the last of fifteen dominoes: from when each has turned by half a radian.
double speed_of_wave(double height) {
    World world = floor_world(0.6);
    for (int i = 0; i < 15; ++i) world.add(box({0.6 * height * i, height / 2}, height / 5, height, 0.6));
    const double push = 3 / std::sqrt(height);  // about its lower right corner
    world.set_velocity(world.ids()[0], push * height * Vec2{0.5, 0.1}, -push);
    const auto falls = [&](std::size_t i) {
        double before = 0, now = 0;
        while (now < 0.5 && world.time() < 20) {
            before = now;
            world.step(1e-3);
            now = -world.angles()[i];
        }
        return world.time() - 1e-3 * (now - 0.5) / (now - before);
    };
    const double fifth = falls(4);
    return 0.6 * height * 10 / (falls(14) - fifth);
}

TEST(Dominoes, FallFasterByTheRootOfTheirSize) {
    const double ratio = truth("mech.domino.scaling"), tolerance = truth_entry("mech.domino.scaling")["tolerance"];
    EXPECT_NEAR(speed_of_wave(1) / speed_of_wave(0.5), ratio, tolerance * ratio);
}

}  // namespace
}  // namespace carom::test
