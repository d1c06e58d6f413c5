// A crane: a trolley on a prismatic joint with a motor, and a load on its rope.

#include "joints.hpp"

namespace carom {
namespace {

using namespace test;

constexpr double length_of_rope = 5;
const double omega = std::sqrt(gravity / length_of_rope), period = 2 * pi / omega;

/// Sets the speed of a joint's motor.
void drive(World& world, JointId id, double speed) {
    Joint joint = world.joint(id);
    std::get<PrismaticJoint>(joint.type).motor->speed = speed;
    world.set(id, joint);
}

struct Crane {
    World world = mechanism_world();
    BodyId trolley = world.add(Body{.mass = 200, .moment_of_inertia = 50});
    JointId rail = world.add(Joint{.b = trolley, .at = Vec2{}, .type = PrismaticJoint{.motor = JointMotor{}}});
    BodyId load = world.add(Body{.position = {0, -length_of_rope}, .mass = 1000, .moment_of_inertia = 100});

    /// How far the load swings, from where it is and how fast [m].
    double swing() const {
        return std::hypot(world.position(load).x - world.position(trolley).x, world.velocity(load).x / omega);
    }
};

/// A trolley speeds up to v in a time r, runs, and brakes for as long, T after it began to speed up: then its load
/// swings by 4 v/(r ω²) sin(ω r/2) sin(ω T/2), not at all if r is the period. A swing of θ is off by θ²/16, and motors
/// follow a ramp in steps, of which r has 100.
TEST(Crane, SwingsAsMuchAsItsDriveMakesIt) {
    constexpr double v = 0.2;
    for (const double part : {0.5, 1.5, 1.0}) {
        const double ramp = part * period, until = 3.3 * period;
        Crane crane;
        crane.world.add(Joint{.a = crane.trolley, .b = crane.load, .type = DistanceJoint{}});
        double now = 0;
        watch(crane.world, std::ceil((until + ramp) / frame) * frame, [&] {
            now += frame;
            const auto rising = [&](double t) { return std::clamp(t / ramp, 0.0, 1.0); };
            const double middle = now + 0.5 * frame;  // of the step to come
            drive(crane.world, crane.rail, v * (rising(middle) - rising(middle - until)));
        });
        const double expected =
            4 * v / (ramp * omega * omega) * std::sin(omega * ramp / 2) * std::sin(omega * until / 2);
        EXPECT_NEAR(crane.swing(), std::abs(expected), 0.01 * v / omega) << part << " periods";
        EXPECT_NEAR(crane.world.position(crane.trolley).x, v * until, 0.01 * v);
    }
}

/// What hangs on a driven body is held where that is when a substep ends, and not where it was: moved on evenly, it
/// hangs still under it. With a hinge and with a rod.
TEST(Crane, HangsStillUnderWhatIsDrivenEvenly) {
    constexpr double speed = 3;
    for (const bool hinged : {false, true}) {
        World world = mechanism_world();
        const BodyId trolley = world.add(Body{.kind = Kind::driven, .velocity = {speed, 0}});
        const BodyId load = world.add(
            Body{.position = {0, -length_of_rope}, .velocity = {speed, 0}, .mass = 1000, .moment_of_inertia = 100});
        world.add(Joint{.a = trolley,
                        .b = load,
                        .at = hinged ? std::optional(Vec2{}) : std::nullopt,
                        .type = hinged ? decltype(Joint::type)(RevoluteJoint{}) : DistanceJoint{}});
        watch(world, 1, [&] {
            EXPECT_LE(gaps(world), 1e-10);
            EXPECT_NEAR(world.position(load).x, world.position(trolley).x, 1e-10);
        });
    }
}

/// A load that is hoisted slowly keeps E/ω: its swing, an angle, grows with the rope's length to the power −3/4. What
/// is hoisted is on a slide in a light arm that swings.
TEST(Crane, HoistsASwingingLoadAdiabatically) {
    World world = mechanism_world();
    constexpr double start = 8, end = 4, speed = 0.05, angle = 0.02;
    const Vec2 down{std::sin(angle), -std::cos(angle)};
    const BodyId arm = world.add(Body{.angle = angle, .mass = 1e-3, .moment_of_inertia = 1e-3});
    world.add(Joint{.b = arm, .at = Vec2{}, .type = RevoluteJoint{}});
    const BodyId load =
        world.add(Body{.position = start * down, .angle = angle, .mass = 1000, .moment_of_inertia = 1e-3});
    PrismaticJoint slide;
    slide.axis = {0, -1}, slide.motor = JointMotor{.speed = -speed};
    const JointId hoist = world.add(Joint{.a = arm, .b = load, .type = slide});
    run(world, (start - end) / speed, frame);
    drive(world, hoist, 0);
    double swing = 0;
    run(world, 5, frame, [&](const World&) { swing = std::max(swing, std::abs(world.angle(arm))); });
    EXPECT_NEAR(world.reaction(hoist).coordinate, end, 1e-3);
    // The speed's change at the two ends leaves a part of speed/(ω L) of it.
    EXPECT_NEAR(swing, angle * std::pow(start / end, 0.75), 0.01 * angle);
}

}  // namespace
}  // namespace carom
