// Bodies that turn on what they lean on: friction holds the edge, and nothing is lost. Closed forms from the
// conservation of energy and momentum; the solver is to be of second order in the step, as its levers are.

#include <array>
#include <cmath>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

constexpr double rough = 5;
constexpr double far_over = -1.2;  // rad

Vec2 turned(Vec2 a, double angle) {
    return {a.x * std::cos(angle) - a.y * std::sin(angle), a.x * std::sin(angle) + a.y * std::cos(angle)};
}

double mechanical_energy(const World& world) {
    const Energy e = energy(world);
    return e.kinetic + e.rotational + e.gravity;
}

/// A block of 0.25 m × 1 m, or a capsule as long, that stands askew on its right edge at the origin and turns over.
Body tipping(Geometry geometry, Vec2 from_edge) {
    constexpr double lean = -0.3, speed = -0.5;
    const Vec2 at = turned(from_edge, lean);
    return {.position = at,
            .angle = lean,
            .velocity = cross(speed, at),
            .angular_velocity = speed,
            .shapes = {{.geometry = std::move(geometry)}},
            .restitution = 0,
            .friction = rough};
}

/// Steps until the body has fallen over, but for its landing.
void fall(World& world, BodyId id, double dt) {
    while (world.angle(id) > far_over) world.step(dt);
}

/// At dt, a half and a quarter of a frame.
std::array<double, 3> errors(double (*error)(double dt)) { return {error(frame), error(frame / 2), error(frame / 4)}; }

/// Errors that fall with the square of the step: by 4 each time, and as nothing else is small beside that by no less
/// than 3.7.
void expect_second_order(const std::array<double, 3>& error, double most) {
    EXPECT_LE(error[0], most);
    EXPECT_GE(error[0], 3.7 * error[1]);
    EXPECT_GE(error[1], 3.7 * error[2]);
}

// ½ I ω² = ½ I ω₀² + m g (h₀ − h) about the edge. The worst error was 2.5e-2 when levers stayed for a step.
TEST(Pivot, ABlockTipsOverItsEdge) {
    const auto error = [](double dt) {
        World world = floor_world(rough);
        const Vec2 from_edge{-0.125, 0.5};
        const BodyId id = world.add(tipping(Box{0.25, 1}, from_edge));
        const double before = world.position(id).y, mass = world.masses()[0];
        fall(world, id, dt);
        const Vec2 now = turned(from_edge, world.angle(id));
        EXPECT_LE(length(world.position(id) - now), 2e-5) << "the edge stays";
        const double inertia = world.moments_of_inertia()[0] + mass * dot(from_edge, from_edge);
        const double speed = std::sqrt(0.25 + 2 * mass * g * (before - now.y) / inertia);
        return std::abs(world.angular_velocity(id) / -speed - 1);
    };
    expect_second_order(errors(error), 1e-4);
}

// Its end is round and rolls: it goes on by the angle times its radius.
TEST(Pivot, ACapsuleRollsOverItsEnd) {
    const auto error = [](double dt) {
        World world = floor_world(rough);
        constexpr double radius = 0.1, speed = -0.5, lean = -0.3;
        Body body = tipping(Capsule{{0, -0.4}, {0, 0.4}, radius}, {0, 0.4});
        body.position.y += radius;
        body.velocity = cross(speed, Vec2{0, radius} + turned({0, 0.4}, lean));
        const BodyId id = world.add(body);
        const double before = mechanical_energy(world), start = world.position(id).x - turned({0, 0.4}, lean).x;
        fall(world, id, dt);
        const double end = world.position(id).x - turned({0, 0.4}, world.angle(id)).x;
        EXPECT_NEAR(end - start, -radius * (world.angle(id) - lean), 2e-5);
        return std::abs(mechanical_energy(world) - before) / energy(world).kinetic;
    };
    expect_second_order(errors(error), 1e-4);
}

// What it stands on slides without friction: the momentum along the floor stays too.
TEST(Pivot, ABlockTipsOverOnASled) {
    const auto error = [](double dt) {
        World world = floor_world(0, {.precise = Precise::all});
        constexpr double thick = 0.2;
        Body block = tipping(Box{0.25, 1}, {-0.125, 0.5});
        block.position.y += thick;
        const BodyId id = world.add(block), sled = world.add(box({0, thick / 2}, 3, thick, rough, 2));
        const double before = mechanical_energy(world), along = world.masses()[0] * block.velocity.x;
        fall(world, id, dt);
        const double block_has = world.masses()[0] * world.velocity(id).x;
        EXPECT_NEAR(block_has + world.masses()[1] * world.velocity(sled).x, along, 1e-12);
        return std::abs(mechanical_energy(world) - before) / energy(world).kinetic;
    };
    expect_second_order(errors(error), 2e-4);
}

}  // namespace
}  // namespace carom::test
