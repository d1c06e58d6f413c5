// Fast bodies: at 1000 m/s, 17 m a step and 4 m a substep, nothing passes through a centimetre, however it spins.

#include <algorithm>
#include <array>

#include "physics/contacts.hpp"
#include "throughput.hpp"

namespace carom::test {
namespace {

constexpr double thickness = 0.01, face = -thickness / 2, speed = 1000;

/// A body that flies to the right, and so far does it stretch to its right when it is turned by an angle.
struct Missile {
    Body body;
    double (*stretch)(double angle);
};

Missile shot() {
    return {disc({}, 0.05), [](double) { return 0.05; }};
}
Missile spinning_box() {
    Missile missile{box({}, 0.4, 0.1, 0),
                    [](double a) { return 0.2 * std::abs(std::cos(a)) + 0.05 * std::abs(std::sin(a)); }};
    missile.body.angular_velocity = 500;
    return missile;
}
Missile spinning_capsule() {
    Missile missile{{.shapes = {{.geometry = Capsule{{-0.3, 0}, {0.3, 0}, 0.02}}}},
                    [](double a) { return 0.3 * std::abs(std::cos(a)) + 0.02; }};
    missile.body.angular_velocity = -3000;
    return missile;
}

/// So many bodies at rest where nobody comes: in a large world who may touch whom is foreseen in another way.
void add_bystanders(World& world, int count) {
    for (int i = 0; i < count; ++i) world.add(disc({100.0 + i, 500}, 0.4));
}

/// Fires it at a fixed wall from a distance and follows it for ten steps.
void fire_at_wall(Missile missile, double distance, double restitution, double friction, int bystanders) {
    World world({.solver = SoftStep{}});
    Body wall = box({0, 0}, thickness, 40, friction);
    wall.kind = Kind::fixed, wall.restitution = 1;
    world.add(wall);
    add_bystanders(world, bystanders);
    missile.body.position = {-distance, 0}, missile.body.velocity = {speed, 0}, missile.body.angle = 0.1 * distance;
    missile.body.restitution = restitution, missile.body.friction = friction;
    const BodyId id = world.add(missile.body);
    const double before = motion(world);
    Throughput through(world);
    double nearest = -distance;
    for (int step = 0; step < 10; ++step) {
        world.step(frame);
        through.add(world);
        expect_closed(world, through);
        nearest = std::max(nearest, world.position(id).x + missile.stretch(world.angle(id)));
    }
    EXPECT_LE(nearest, face + 1e-3);  // a tenth of the wall
    EXPECT_GT(world.collisions(), 0u);
    EXPECT_LE(motion(world), (1 + 1e-12) * before);
    if (restitution == 1 && friction == 0) {
        EXPECT_NEAR(motion(world) / before, 1, 1e-12);
    }
}

/// From fourteen places: the wall is anywhere in the way of a substep, and the body turned in any way as it comes.
void expect_stopped(const Missile& missile) {
    for (int k = 0; k < 14; ++k)
        for (const double e : {0.0, 0.5, 1.0})
            for (const double mu : {0.0, 0.5})
                for (const int bystanders : {0, 60}) {
                    SCOPED_TRACE(testing::Message()
                                 << "from " << k << ", e " << e << ", mu " << mu << ", beside " << bystanders);
                    fire_at_wall(missile, 3 + 1.37 * k, e, mu, bystanders);
                }
}

TEST(FastBody, ADiscStopsAtAThinWall) { expect_stopped(shot()); }
TEST(FastBody, ASpinningBoxStopsAtAThinWall) { expect_stopped(spinning_box()); }
TEST(FastBody, ASpinningCapsuleStopsAtAThinWall) { expect_stopped(spinning_capsule()); }

/// A bullet of 20 g at a plate of 1 kg that is free and comes towards it with a speed of its own, in the middle of it:
/// their speeds afterwards are Newton's.
void fire_at_plate(double distance, double plate_speed, double e, int bystanders) {
    constexpr double m = 0.02, M = 1;
    World world({.solver = SoftStep{}});
    Body plate = box({0, 0}, thickness, 1, 0, M);
    plate.restitution = e, plate.velocity = {plate_speed, 0};
    const BodyId struck = world.add(plate);
    add_bystanders(world, bystanders);
    Body bullet = disc({-distance, 0}, 0.004, 0, e);
    bullet.mass = m, bullet.velocity = {speed, 0};
    const BodyId striker = world.add(bullet);
    Throughput through(world);
    for (int step = 0; step < 4; ++step) {
        world.step(frame);
        through.add(world);
        expect_closed(world, through);
    }
    const double both = (m * speed + M * plate_speed) / (m + M), apart = e * (speed - plate_speed);
    EXPECT_NEAR(world.velocity(striker).x, both - M / (m + M) * apart, 1e-9);
    EXPECT_NEAR(world.velocity(struck).x, both + m / (m + M) * apart, 1e-9);
    EXPECT_LE(world.position(striker).x + 0.004, world.position(struck).x + face + 1e-3);
}

TEST(FastBody, ABulletStopsAtAThinPlateThatIsFree) {
    for (int k = 0; k < 14; ++k)
        for (const double plate_speed : {0.0, -10.0, -1000.0})
            for (const double e : {0.0, 0.3, 1.0})
                for (const int bystanders : {0, 60}) {
                    SCOPED_TRACE(testing::Message() << "from " << k << ", against " << plate_speed << ", e " << e
                                                    << ", beside " << bystanders);
                    fire_at_plate(3 + 1.37 * k, plate_speed, e, bystanders);
                }
}

// Off its middle it makes the plate turn, and both spin already: no closed form, but momentum and energy.
TEST(FastBody, ABulletStopsAtAThinPlateThatTurns) {
    for (int k = 0; k < 14; ++k) {
        SCOPED_TRACE(testing::Message() << "from " << k);
        World world({.solver = SoftStep{}});
        Body plate = box({0, 0}, thickness, 1, 0.3);
        plate.restitution = 1, plate.velocity = {-20, 0}, plate.angular_velocity = 30;
        world.add(plate);
        Body bullet = box({-3 - 1.37 * k, 0.05}, 0.02, 0.01, 0.3, 0.02);
        bullet.restitution = 1, bullet.velocity = {speed, 0}, bullet.angular_velocity = -500;
        world.add(bullet);
        Throughput through(world);
        for (int step = 0; step < 4; ++step) {
            world.step(frame);
            through.add(world);
            expect_closed(world, through);
        }
        const Energy e = energy(world);
        EXPECT_NEAR(momentum_balance(world).total.linear.x, 0.02 * speed - 20, 1e-11);
        EXPECT_NEAR((motion(world) + e.heat.friction + e.heat.impact) / e.initial_total, 1, 1e-12);
        EXPECT_EQ(world.collisions() > 0, true);
    }
}

}  // namespace
}  // namespace carom::test
