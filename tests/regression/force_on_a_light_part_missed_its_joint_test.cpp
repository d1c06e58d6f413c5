// Forces on a light part of a heavy mechanism saw it where it would fly without its joint. A spring on a bracket of a
// hundredth of its block's mass lost half of its energy in a second, and nearly all of it at three thousandths; of a
// rocket whose engine was as light the drag made twice the heat that it should, and then took a step of 1e9 parts. What
// the joints had given before was added to the flight for forces that look at velocities alone, as a velocity from its
// start on, and came a substep late: too late where the part alone is as fast as its spring lets it be.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

constexpr double block = 10, hull = 10, step = 1.0 / 60, substep = step / 4;

/// What of a bracket that is welded to a block a damped spring pulls, stretched by half a metre at first.
struct Pulled {
    double far;        ///< the largest distance from where the oscillator of both masses is in a second [m]
    Energy energy;     ///< then
    double quickness;  ///< its ω in a substep [rad]
};
Pulled pulled(double bracket, double damping, const Integrator& integrator = Verlet{}) {
    constexpr double stiffness = 5000;
    World world({.integrator = integrator, .solver = SoftStep{}});
    const BodyId nail = world.add(Body{.kind = Kind::fixed, .position = {3, 0}});
    const BodyId heavy = world.add(Body{.mass = block, .radius = 0.3});
    const BodyId light = world.add(Body{.position = {0.5, 0}, .mass = bracket, .radius = 0.1});
    world.add(Joint{.a = heavy, .b = light, .at = Vec2{0.5, 0}, .type = WeldJoint{}});
    world.add(Spring{.a = nail, .b = light, .stiffness = stiffness, .rest_length = 2, .damping = damping});
    const double mass = block + bracket, decay = damping / (2 * mass);
    const double frequency = std::sqrt(stiffness / mass - decay * decay);
    Pulled all{};
    run(world, 1, step, [&](const World& w) {
        const double phase = frequency * w.time();
        const double stretch =
            0.5 * std::exp(-decay * w.time()) * (std::cos(phase) + decay / frequency * std::sin(phase));
        all.far = std::max(all.far, std::abs(w.position(light).x - (1 - stretch)));
    });
    all.energy = energy(world), all.quickness = frequency * substep;
    return all;
}

/// Verlet's method is late by a part (ωh)²/24 of the phase, and the midpoint rule twice that: in a second, of 0.5 m.
double late(const Pulled& p, double part) { return part * p.quickness * p.quickness * p.quickness / substep * 0.5; }

TEST(LightPart, SwingsWithWhatItIsWeldedTo) {
    for (const double bracket : {1.0, 0.3, 0.1, 0.03, 0.01}) {
        const Pulled p = pulled(bracket, 0);
        EXPECT_LT(p.far, 1.1 * late(p, 1.0 / 24)) << bracket;
        // The energy of Verlet's method comes and goes with (ωh)²/4.
        EXPECT_NEAR(p.energy.total(), 625, 625 * p.quickness * p.quickness / 4) << bracket;
        EXPECT_LT(std::abs(p.energy.unaccounted()), 1e-9) << bracket;
    }
}

TEST(LightPart, DoesSoUnderEveryMethodOfSecondOrderAndMore) {
    for (const Integrator& integrator : {Integrator{Pefrl{}}, Integrator{Rk4{}}, Integrator{GaussRadau{}},
                                         Integrator{Adaptive{}}, Integrator{Implicit{}}}) {
        const Pulled p = pulled(0.1, 0, integrator);
        EXPECT_LT(p.far, 1.1 * late(p, 1.0 / 12)) << integrator.index();
        EXPECT_NEAR(p.energy.total(), 625, 625 * p.quickness * p.quickness / 2) << integrator.index();
        EXPECT_LT(std::abs(p.energy.unaccounted()), 1e-9) << integrator.index();
    }
}

TEST(LightPart, IsDampedWithWhatItIsWeldedTo) {
    for (const double bracket : {1.0, 0.1, 0.01, 0.001}) {
        const Pulled p = pulled(bracket, 10);
        EXPECT_LT(p.far, 1.1 * late(p, 1.0 / 24)) << bracket;
        const double left = p.energy.kinetic + p.energy.spring;
        EXPECT_NEAR(p.energy.heat.damping, 625 - left, 625 * p.quickness * p.quickness / 4) << bracket;
    }
}

TEST(LightPart, IsDraggedWithWhatItIsWeldedTo) {
    constexpr double thrust = 500, drag = 0.1;
    for (const double engine : {1.0, 0.1, 0.03, 0.01, 0.003}) {
        World world({.solver = SoftStep{}});
        const BodyId front = world.add(Body{.mass = hull, .radius = 0.3});
        const BodyId back = world.add(Body{.position = {-0.5, 0}, .mass = engine, .radius = 0.1});
        world.add(Joint{.a = front, .b = back, .at = Vec2{-0.5, 0}, .type = WeldJoint{}});
        world.add(ConstantForce{.body = back, .force = {thrust, 0}});
        world.add(Drag{.quadratic = drag});
        run(world, 1, step);
        // M v' = F − 2 c v²
        const double mass = hull + engine, last = std::sqrt(thrust / (2 * drag)), rate = thrust / (mass * last);
        const double speed = last * std::tanh(rate), way = last / rate * std::log(std::cosh(rate));
        const Energy e = energy(world);
        // Of second order: the drag's rate is 2/s at most, a hundredth in a substep.
        EXPECT_NEAR(world.velocity(front).x, speed, 1e-4 * speed) << engine;
        EXPECT_NEAR(e.heat.drag, thrust * way - 0.5 * mass * speed * speed, 1e-3 * thrust * way) << engine;
        EXPECT_LT(std::abs(e.residual), 1e-4 * thrust * way) << engine;
    }
}

/// The heavy end of six light links falls and swings through the air: the links' own rates of drag are 1000 times those
/// of all together.
TEST(LightPart, IsDraggedInAChain) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    std::optional<BodyId> last;
    for (int i = 0; i < 6; ++i) {
        const BodyId link = world.add(
            Body{.position = {0.5 + i, 0}, .mass = 0.01, .shapes = {{.geometry = Box{.width = 1, .height = 0.02}}}});
        world.add(Joint{.a = last, .b = link, .at = Vec2{double(i), 0}, .type = RevoluteJoint{}});
        last = link;
    }
    const BodyId bob = world.add(Body{.position = {6, 0}, .mass = 100, .radius = 0.3});
    world.add(Joint{.a = last, .b = bob, .at = Vec2{6, 0}, .type = RevoluteJoint{}});
    world.add(Drag{.quadratic = 0.1});
    double fastest = 0;
    run(world, 6, step, [&](const World& w) { fastest = std::max(fastest, length(w.velocity(bob))); });
    EXPECT_LT(fastest, std::sqrt(2 * 9.81 * 6));  // from there it cannot be faster
    const Energy e = energy(world);
    EXPECT_LT(std::abs(e.residual), 1e-4 * 100 * 9.81 * 6);  // as of a pendulum without drag
    EXPECT_GT(e.heat.drag, 0);
}

}  // namespace
}  // namespace carom
