// When friction has stopped a slip it is another friction: where bodies come to rest, begin to roll or turn back,
// against closed forms, and what that made of heat.

#include "physics/contacts.hpp"
#include "throughput.hpp"

namespace carom::test {
namespace {

// Forces are constant until then: nothing is left but rounding, of some thousand substeps.
constexpr double exact = 1e-10;
constexpr double steps[] = {frame, frame / 2, frame / 4, frame / 8, 0.013};

/// Moves the world on, whose books are to close after every step.
void pass_closed(World& world, double duration, double step) {
    Throughput through(world);
    run(world, duration, step, [&](const World& now) {
        through.add(now);
        expect_closed(now, through);
    });
}

/// A way with constant acceleration from this velocity to that one.
double way(double from, double to, double acceleration) { return (to * to - from * from) / (2 * acceleration); }

class EveryStep : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Slip, EveryStep, testing::ValuesIn(steps));

// ---- To a stop ------------------------------------------------------------------------------------------------------

TEST_P(EveryStep, ABoxThrownAlongTheFloorStopsAtItsPlace) {
    constexpr double mu = 0.2, speed = 5;
    for (const double fall : {0.0, 0.002, 1.0}) {
        World world = floor_world(mu);
        const BodyId id = world.add(box({0, 0.5 + fall}, 1, 1, mu));
        world.set_velocity(id, {speed, 0}, 0);
        pass_closed(world, 4, GetParam());
        // The floor's blow takes µ of itself.
        const double lands = std::sqrt(2 * fall / g), slides = speed - mu * g * lands;
        EXPECT_NEAR(world.position(id).x, speed * lands + way(slides, 0, -mu * g), exact) << fall;
        EXPECT_NEAR(world.velocity(id).x, 0, 1e-12) << fall;
    }
}

// A blow ends when little approaches; what slip is left over is stopped in the rest of the substep, h: half of it late
// at most.
TEST_P(EveryStep, ABoxThatABlowStopsStaysWhereItFell) {
    constexpr double mu = 0.5, speed = 2;
    World world = floor_world(mu);
    const BodyId id = world.add(box({0, 1.5}, 1, 1, mu));
    world.set_velocity(id, {speed, 0}, 0);
    pass_closed(world, 2, GetParam());
    const double h = GetParam() / 4;
    EXPECT_NEAR(world.position(id).x, speed * std::sqrt(2 / g), 0.5 * mu * g * h * h);
}

TEST_P(EveryStep, ABoxThrownUpARampStaysWhereItStops) {
    constexpr double slope = 0.3, mu = 0.5, speed = 4;
    World world = ramp_world(slope, mu);
    const BodyId id = world.add(box({0, 0.5}, 1, 1, mu));
    world.set_velocity(id, {-speed, 0}, 0);
    pass_closed(world, 2, GetParam());
    const double distance = way(speed, 0, -g * (std::sin(slope) + mu * std::cos(slope)));
    EXPECT_NEAR(world.position(id).x, -distance, exact);
    EXPECT_NEAR(energy(world).heat.friction, mu * g * std::cos(slope) * distance, exact);
}

TEST_P(EveryStep, ADiscWithRollingResistanceRollsToItsStop) {
    constexpr double radius = 0.3, speed = 1, resistance = 0.02;
    World world = floor_world(0.5);
    const BodyId id = world.add(Body{.position = {0, radius},
                                     .moment_of_inertia = 0.5 * radius * radius,
                                     .shapes = {{.geometry = Disc{.radius = radius},
                                                 .restitution = 0,
                                                 .friction = 0.5,
                                                 .rolling_resistance = resistance}}});
    world.set_velocity(id, {speed, 0}, -speed / radius);
    pass_closed(world, 9, GetParam());
    EXPECT_NEAR(world.position(id).x, way(speed, 0, -resistance * g / 1.5), exact);
    EXPECT_NEAR(energy(world).heat.friction, 0.75, exact);
}

// ---- To another motion ----------------------------------------------------------------------------------------------

/// A disc that slips and then rolls, for 1.7037 s.
void expect_rolls(double speed, double spin, double step) {
    constexpr double mu = 0.2, radius = 0.3, duration = 1.7037;
    World world = floor_world(mu);
    const BodyId id = world.add(disc({0, radius}, radius, mu));
    world.set_velocity(id, {speed, 0}, spin);
    pass_closed(world, duration, step);
    const double slip = speed + radius * spin, pull = slip > 0 ? -mu * g : mu * g;
    const double slips = std::abs(slip) / (3 * mu * g), left = duration - slips, rolls = speed + pull * slips;
    ASSERT_GT(left, 0);
    const double turned = radius * spin * slips + pull * slips * slips - rolls * left;
    EXPECT_NEAR(world.position(id).x, speed * slips + 0.5 * pull * slips * slips + rolls * left, exact);
    EXPECT_NEAR(radius * world.angle(id), turned, exact);
    EXPECT_NEAR(world.velocity(id).x, rolls, exact);
    EXPECT_NEAR(radius * world.angular_velocity(id), -rolls, exact);
    EXPECT_NEAR(energy(world).heat.friction, slip * slip / 6, exact);
}

TEST_P(EveryStep, ADiscSlipsAndThenRolls) {
    expect_rolls(6, 0, GetParam());
    expect_rolls(2, 20, GetParam());   // with backspin: it comes back
    expect_rolls(0, -30, GetParam());  // spun, and let go
}

// Friction pulls down the ramp, and then up.
TEST_P(EveryStep, ABoxThrownUpASteepRampComesBack) {
    constexpr double slope = 0.6, mu = 0.3, speed = 4, duration = 2;
    World world = ramp_world(slope, mu);
    const BodyId id = world.add(box({0, 0.1}, 1, 0.2, mu));
    world.set_velocity(id, {-speed, 0}, 0);
    pass_closed(world, duration, GetParam());
    const double up = g * (std::sin(slope) + mu * std::cos(slope)), down = g * (std::sin(slope) - mu * std::cos(slope));
    const double falls = duration - speed / up;
    EXPECT_NEAR(world.position(id).x, -way(speed, 0, -up) + 0.5 * down * falls * falls, exact);
    EXPECT_NEAR(world.velocity(id).x, down * falls, exact);
}

TEST_P(EveryStep, ABeltTakesABoxAlong) {
    constexpr double mu = 0.4, speed = 2, duration = 2;
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    world.add(Body{.kind = Kind::fixed,
                   .position = {0, -0.5},
                   .shapes = {{.geometry = Box{40, 1}, .restitution = 0, .friction = mu, .surface_speed = -speed}}});
    const BodyId id = world.add(box({0, 0.1}, 1, 0.2, mu));
    pass_closed(world, 0.05, GetParam());  // it is set down, and presses
    world.set_position(id, {0, 0.1}, 0), world.set_velocity(id, {}, 0);
    pass_closed(world, duration, GetParam());
    const double slips = speed / (mu * g);
    EXPECT_NEAR(world.velocity(id).x, speed, exact);
    EXPECT_NEAR(world.position(id).x, way(0, speed, mu * g) + speed * (duration - slips), exact);
}

// The plank is on ice, and in the end both have a third of the box's momentum.
TEST_P(EveryStep, ABoxSlidesOnAPlankAndTakesItAlong) {
    constexpr double mu = 0.3, speed = 3, duration = 3;
    World world = floor_world(0, {.precise = Precise::all});
    const BodyId plank = world.add(box({0, 0.1}, 6, 0.2, mu, 2)), id = world.add(box({-1, 0.3}, 0.4, 0.2, mu, 1));
    world.set_velocity(id, {speed, 0}, 0);
    pass_closed(world, duration, GetParam());
    const double slips = speed / (1.5 * mu * g);
    EXPECT_NEAR(world.position(id).x + 1, speed * slips - 0.5 * mu * g * slips * slips + speed / 3 * (duration - slips),
                exact);
    EXPECT_NEAR(world.position(plank).x, 0.25 * mu * g * slips * slips + speed / 3 * (duration - slips), exact);
    EXPECT_NEAR(energy(world).heat.friction, 3, exact);
}

// ---- Under a force that changes -------------------------------------------------------------------------------------

/// How far from the closed form a box on a spring is that rubs, after two turns and a bit.
double error_of_oscillator(double step) {
    constexpr double mu = 0.1, stiffness = 50, duration = 1.2, pi = 3.14159265358979324;
    World world = floor_world(mu);
    const BodyId id = world.add(box({1, 0.1}, 1, 0.2, mu));
    const BodyId fixed = world.add(Body{.kind = Kind::fixed, .position = {-10, 0.1}});
    world.add(Spring{.a = fixed, .b = id, .stiffness = stiffness, .rest_length = 10});
    run(world, duration, step);
    // Half a swing about where spring and friction balance, again and again.
    const double omega = std::sqrt(stiffness), shift = mu * g / stiffness, left = duration - 2 * pi / omega;
    return world.position(id).x - (shift + (1 - 5 * shift) * std::cos(omega * left));
}

// That of the method itself, as without friction: before, friction acted against the motion until the end of a substep.
TEST(Slip, ThatTurnsRoundUnderASpringLeavesTheOrderOfTheMethod) {
    const double coarse = error_of_oscillator(frame);
    EXPECT_LT(std::abs(coarse), 1e-3);
    EXPECT_NEAR(coarse / error_of_oscillator(frame / 2), 4, 0.2);
    EXPECT_NEAR(coarse / error_of_oscillator(frame / 4), 16, 0.8);
}

}  // namespace
}  // namespace carom::test
