// Bounces at the instant of impact: what mechanics says, at steps of 1/60 s.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

using namespace carom;

namespace {

constexpr double dt = 1.0 / 60, g = 9.81;
using std::numbers::pi;

/// How high a body would rise above the floor from here.
double apex(const World& world, BodyId id, double radius) {
    const Vec2 v = world.velocity(id);
    return world.position(id).y - radius + v.y * v.y / (2 * g);
}

World on_a_floor(double friction, double restitution = 1, double slope = 0) {
    World world({.gravity = {0, -g}});
    world.add(HalfPlane{.normal = {-std::sin(slope), std::cos(slope)}, .side = {restitution, friction}});
    return world;
}

}  // namespace

TEST(TimeOfImpact, KeepsAnElasticBouncesApex) {
    for (const double radius : {0.0, 0.1}) {
        World world = on_a_floor(0);
        const BodyId ball = world.add(Body{.position = {0, 5 + radius}, .radius = radius});
        for (int n = 0; n < 3600; ++n) {
            world.step(dt);
            ASSERT_GE(world.position(ball).y, radius - 1e-12) << "sank into the floor";
        }
        EXPECT_NEAR(apex(world, ball, radius), 5, 5e-9);  // scenes/honesty/bounce.json: 1e-9 of the first
        EXPECT_EQ(world.collisions(), 30u);               // one each 2 √(2h/g) = 2.019 s, the first after half that
        EXPECT_NEAR(energy(world).residual, 0, 1e-9 * 5 * g);
    }
}

TEST(TimeOfImpact, BouncesByTheCoefficientOfRestitution) {
    // truth.json ed.bounce: from 1 m, e = 0.8, the tenth bounce is at 3.578892951020438 s.
    World world = on_a_floor(0, 0.8);
    const BodyId ball = world.add(Body{.position = {0, 1}});
    world.step(3.578892951020438 - 1e-9);
    EXPECT_EQ(world.collisions(), 9u);
    world.step(2e-9);
    EXPECT_EQ(world.collisions(), 10u);
    EXPECT_NEAR(apex(world, ball, 0), std::pow(0.8, 20), 1e-9);
    run(world, 1, dt);
    // After the Zeno point, 4.06 s, all energy is heat and the ball rests.
    EXPECT_NEAR(world.position(ball).y, 0, 1e-12);
    EXPECT_EQ(world.velocity(ball), (Vec2{}));
    EXPECT_NEAR(energy(world).heat.impact, g, 1e-9);
    EXPECT_NEAR(energy(world).residual, 0, 1e-9);
}

TEST(TimeOfImpact, LeavesARestingDiscAlone) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        World world = on_a_floor(0.3, restitution);
        const BodyId disc = world.add(Body{.position = {1, 0.3}, .radius = 0.3, .friction = 0.3});
        run(world, 60, dt);
        EXPECT_EQ(world.position(disc), (Vec2{1, 0.3}));
        EXPECT_EQ(world.velocity(disc), (Vec2{}));
        EXPECT_EQ(energy(world).residual, 0);
    }
}

TEST(TimeOfImpact, TurnsSlippingIntoRolling) {
    // v = v0 − µ g t until 3 µ g t = v0, then v = 2/3 v0 and ω r = −v: the impulse of friction about the contact.
    const double mu = 0.21, v0 = 3, r = 0.4, roll = v0 / (3 * mu * g);
    World world = on_a_floor(mu, 0);
    const BodyId disc = world.add(Body{.position = {0, r}, .velocity = {v0, 0}, .radius = r, .friction = mu});
    for (int n = 1; n <= 120; ++n) {
        world.step(dt);
        const double t = n * dt, slid = std::min(t, roll);
        EXPECT_NEAR(world.velocity(disc).x, v0 - mu * g * slid, 1e-12) << t;
        EXPECT_NEAR(world.angular_velocity(disc), -2 * mu * g * slid / r, 1e-11) << t;
        EXPECT_NEAR(world.position(disc).x, v0 * t - mu * g * slid * (t - slid / 2), 1e-11) << t;
    }
    EXPECT_NEAR(energy(world).heat.friction, v0 * v0 / 6, 1e-11);  // ½ m v0² − ¾ m (2/3 v0)²
    EXPECT_NEAR(energy(world).residual, 0, 1e-11);
}

TEST(TimeOfImpact, SlidesABlockDownAnIncline) {
    // truth.json mech.block: 30°, µ = 0.2: a = 3.2058581577749314 m/s², 6.411716315549863 m in 2 s.
    World world = on_a_floor(0.2, 0, pi / 6);
    const BodyId block = world.add(Body{.friction = 0.2});
    run(world, 2, dt);
    EXPECT_NEAR(length(world.position(block)), 6.411716315549863, 1e-10);
    EXPECT_NEAR(length(world.velocity(block)), 2 * 3.2058581577749314, 1e-10);
    EXPECT_NEAR(energy(world).residual, 0, 1e-10);
}

TEST(TimeOfImpact, HoldsABlockBelowTheCriticalAngle) {
    for (const double times : {0.99, 1.01}) {
        const double mu = 0.3;
        World world = on_a_floor(mu, 0, std::atan(mu) * times);
        const BodyId block = world.add(Body{.friction = mu});
        run(world, 10, dt);
        if (times < 1)
            EXPECT_NEAR(length(world.position(block)), 0, 1e-12);
        else
            EXPECT_GT(length(world.position(block)), 0.1);
    }
}

TEST(TimeOfImpact, StopsABlockOnAFloor) {
    // truth.json mech.block: v0 = 5 m/s, µ = 0.2: at rest after 2.548 s and 6.3710499490316 m.
    World world = on_a_floor(0.2, 0);
    const BodyId block = world.add(Body{.velocity = {5, 0}, .friction = 0.2});
    run(world, 3, dt);
    EXPECT_NEAR(world.position(block).x, 6.3710499490316, 1e-10);
    EXPECT_NEAR(world.velocity(block).x, 0, 1e-12);
    EXPECT_NEAR(energy(world).heat.friction, 12.5, 1e-10);
}

TEST(TimeOfImpact, RollsADiscDownAnIncline) {
    // truth.json mech.roll: 30°, 2/3 g sin α = 3.27 m/s² for µ ≥ tan(30°)/3; a little less friction and it slips.
    for (const double mu : {0.2, 0.19}) {
        const double slope = pi / 6, r = 0.5;
        World world = on_a_floor(mu, 0, slope);
        const Vec2 normal{-std::sin(slope), std::cos(slope)};
        const BodyId disc = world.add(Body{.position = r * normal, .radius = r, .friction = mu});
        run(world, 2, dt);
        const double a = mu > std::tan(slope) / 3 ? 3.27 : g * (std::sin(slope) - mu * std::cos(slope));
        EXPECT_NEAR(length(world.velocity(disc)), 2 * a, 1e-9) << mu;
        EXPECT_NEAR(length(world.position(disc) - r * normal), 2 * a, 1e-9) << mu;
        EXPECT_NEAR(energy(world).residual, 0, 1e-9) << mu;
    }
}

TEST(TimeOfImpact, PassesNewtonsCradleOn) {
    for (int incoming = 1; incoming <= 4; ++incoming) {
        World world;
        std::vector<BodyId> discs;
        for (int i = 0; i < 5; ++i)
            discs.push_back(world.add(Body{.position = {i < incoming ? i - 0.75 : double(i), 0},
                                           .velocity = {i < incoming ? 1. : 0., 0},
                                           .radius = 0.5}));
        run(world, 2, dt);
        for (int i = 0; i < 5; ++i)
            EXPECT_NEAR(world.velocity(discs[i]).x, i >= 5 - incoming ? 1 : 0, 1e-12) << incoming << " in, disc " << i;
        EXPECT_NEAR(energy(world).residual, 0, 1e-12);
    }
}

TEST(TimeOfImpact, CountsPiInCollisions) {
    // truth.json ed.galperin: a wall, a disc of 1 kg at rest, a disc of 100^n kg that comes: 3, 31, 314, ...
    const int counts[] = {3, 31, 314, 3141, 31415};
    for (int n = 0; n < 5; ++n) {
        World world;
        world.add(HalfPlane{.normal = {1, 0}});
        world.add(Body{.position = {1, 0}, .mass = 1, .radius = 0.1});
        const BodyId heavy =
            world.add(Body{.position = {2, 0}, .velocity = {-1, 0}, .mass = std::pow(100, n), .radius = 0.1});
        run(world, 100, dt);
        EXPECT_EQ(world.collisions(), counts[n]);
        EXPECT_GT(world.velocity(heavy).x, 0);
        EXPECT_NEAR(energy(world).residual / energy(world).total(), 0, 1e-12);
    }
}

TEST(TimeOfImpact, ReversesEqualMassesOnALine) {
    // truth.json ed.gas1d: N (N − 1)/2 collisions, final velocities are the initial ones in reverse.
    World world;
    for (int i = 0; i < 10; ++i)
        world.add(Body{.position = {double(i), 0}, .velocity = {-double(i), 0}, .radius = 0.1});
    run(world, 20, dt);
    EXPECT_EQ(world.collisions(), 45u);
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(world.velocities()[i].x, -(9 - i), 1e-12);
}

TEST(TimeOfImpact, EndsAnInelasticCollapse) {
    // truth.json ed.collapse3: below e = 0.0718 three discs on a line collide infinitely often and stay together.
    World world;
    for (int i = 0; i < 3; ++i)
        world.add(Body{.position = {1.5 * i, 0}, .velocity = {1. - i, 0}, .radius = 0.5, .restitution = 0.05});
    run(world, 5, dt);
    EXPECT_NEAR(energy(world).heat.impact, 1, 1e-12);
    EXPECT_NEAR(energy(world).residual, 0, 1e-12);
    for (const Vec2 v : world.velocities()) EXPECT_NEAR(v.x, 0, 1e-9);
    EXPECT_NEAR(world.positions()[1].x - world.positions()[0].x, 1, 1e-9);
}

TEST(TimeOfImpact, LetsNothingTunnel) {
    for (const double radius : {1e-4, 0.0}) {
        World world;
        const BodyId target = world.add(Body{.position = {20, 0}, .radius = 1e-4});
        const BodyId bullet = world.add(Body{.position = {0, 0}, .velocity = {1000, 0}, .radius = radius});
        world.add(HalfPlane{.point = {50, 0}, .normal = {-1, 0}});
        world.step(1.0 /
                   40);  // the bullet flies to the target, and that to the wall, after 5 m more than a step's half
        EXPECT_NEAR(world.velocity(bullet).x, 0, 1e-9);
        EXPECT_NEAR(world.velocity(target).x, 1000, 1e-9);
        for (int n = 0; n < 4; ++n) world.step(dt);  // to the wall at 50 m, and back to the bullet at 20 m
        EXPECT_NEAR(world.velocity(bullet).x, -1000, 1e-9);
        EXPECT_NEAR(energy(world).kinetic, 5e5, 1e-7);
    }
}

TEST(TimeOfImpact, CrossesAPeriodicBox) {
    // The discs fly apart, meet across the border and exchange their velocities: gap 10 − 2 − 1 = 7 at 2 m/s is 3.5 s.
    World world;
    world.add(Periodic{{0, 0}, {10, 10}});
    const BodyId a = world.add(Body{.position = {4, 5}, .velocity = {-1, 0}, .radius = 0.5});
    const BodyId b = world.add(Body{.position = {6, 5}, .velocity = {1, 0}, .radius = 0.5});
    run(world, 5, dt);
    EXPECT_EQ(world.collisions(), 1u);
    EXPECT_NEAR(world.velocity(a).x, 1, 1e-14);
    EXPECT_NEAR(world.position(a).x, 4 - 3.5 + 1.5, 1e-12);
    EXPECT_NEAR(world.position(b).x, 6 + 3.5 - 1.5, 1e-12);
    EXPECT_NEAR(world.wrapped({-0.25, 12}).x, 9.75, 1e-15);
    EXPECT_NEAR(world.wrapped({-0.25, 12}).y, 2, 1e-15);
}

TEST(TimeOfImpact, KeepsAGasIsolated) {
    for (const bool periodic : {false, true}) {
        World world;
        if (periodic)
            world.add(Periodic{{0, 0}, {10, 10}});
        else
            world.add(Rectangle{{0, 0}, {10, 10}});
        build(world, Gas{.fill = {.high = {10, 10}, .count = 100, .smallest_radius = 0.2, .largest_radius = 0.2}});
        const double before = energy(world).kinetic;
        run(world, 20, dt);
        EXPECT_GT(world.collisions(), 1000u);
        EXPECT_NEAR(energy(world).kinetic / before, 1, 1e-12);  // as scenes/honesty/gas.json
        EXPECT_TRUE(!periodic || length(momentum(world)) < 1e-11);
        for (std::size_t i = 0; i < world.size(); ++i)
            for (std::size_t j = i + 1; j < world.size(); ++j) {
                Vec2 d = world.positions()[j] - world.positions()[i];
                if (periodic) d = {std::remainder(d.x, 10), std::remainder(d.y, 10)};
                ASSERT_GT(length(d), 0.4 - 1e-12);
            }
    }
}

TEST(TimeOfImpact, FliesBackTheWayItCame) {
    // truth.json gas.time.reversal: with so few discs the way back ends where it began.
    World world;
    world.add(Rectangle{{0, 0}, {4, 3}});
    world.add(Body{.position = {1, 1}, .velocity = {1.3, 0.7}, .radius = 0.3});
    world.add(Body{.position = {3, 2}, .velocity = {-0.4, 1.1}, .mass = 2, .radius = 0.4});
    const World start = world;
    run(world, 4, dt);
    const auto collisions = world.collisions();
    EXPECT_GT(collisions, 5u);
    for (const BodyId id : world.ids()) world.set_velocity(id, -world.velocity(id), 0);
    run(world, 4, dt);
    EXPECT_EQ(world.collisions(), 2 * collisions);
    for (const BodyId id : world.ids()) EXPECT_NEAR(length(world.position(id) - start.position(id)), 0, 1e-10);
}

// Under any force but gravity the integrator flies to the impact: its order is what is left of the error.
namespace {

World bouncing_on_a_spring(double restitution, double drag) {
    World world({.gravity = {0, -g}});
    world.add(HalfPlane{.side = {.restitution = restitution}});
    const BodyId ceiling = world.add(Body{.kind = Kind::fixed, .position = {0, 3}});
    const BodyId ball =
        world.add(Body{.position = {0.5, 1}, .velocity = {1, 0}, .radius = 0.2, .restitution = restitution});
    world.add(Spring{.a = ceiling, .b = ball, .stiffness = 5, .rest_length = 1});
    if (drag > 0) world.add(Drag{.linear = drag});
    return world;
}

}  // namespace

TEST(TimeOfImpactUnderForces, ConvergesAsTheIntegratorDoes) {
    for (const double drag : {0.0, 0.3}) {
        const auto end = [drag](double step) {
            World world = bouncing_on_a_spring(0.9, drag);
            run(world, 2, step);
            EXPECT_GE(world.collisions(), 1u);
            return world.position(world.ids()[1]);
        };
        const Vec2 finest = end(1.0 / 7680);
        const double coarse = length(end(1.0 / 240) - finest), fine = length(end(1.0 / 480) - finest);
        EXPECT_GT(coarse / fine, 3.3) << drag;  // order 2: a factor of 4
        EXPECT_LT(coarse, 1e-3) << drag;
    }
}

TEST(TimeOfImpactUnderForces, ClosesItsAccounts) {
    const auto residual = [](double step) {
        World world = bouncing_on_a_spring(0.8, 0.2);
        run(world, 5, step);
        const Energy e = energy(world);
        EXPECT_GT(e.heat.impact, 0.1);
        EXPECT_GT(e.heat.drag, 0.1);
        return std::abs(e.residual);
    };
    EXPECT_LT(residual(1.0 / 240), 2e-3);  // of some 20 J
    EXPECT_LT(residual(1.0 / 960), 2e-4);  // a sixteenth
}

TEST(TimeOfImpactUnderForces, KeepsAnElasticBounce) {
    World world = bouncing_on_a_spring(1, 0);
    const double before = energy(world).total();
    run(world, 20, dt);
    EXPECT_GT(world.collisions(), 5u);
    EXPECT_NEAR(energy(world).total(), before, 0.02 * std::abs(before));  // Verlet at ω h = 0.04 swings by 1e-3 or so
}

TEST(TimeOfImpactUnderForces, LetsNothingTunnel) {
    World world;
    const BodyId bullet = world.add(Body{.position = {0, 0}, .velocity = {1000, 0}, .radius = 1e-3});
    const BodyId target = world.add(Body{.position = {7.3, 0}, .radius = 1e-3});
    world.add(Drag{.linear = 1e-6});
    world.step(dt);
    EXPECT_NEAR(world.velocity(bullet).x, 0, 1e-3);
    EXPECT_NEAR(world.velocity(target).x, 1000, 1e-3);
}

TEST(TimeOfImpactUnderForces, RestsOnAFloor) {
    World world = on_a_floor(0.5, 0.5);
    const BodyId disc = world.add(Body{.position = {0, 1}, .radius = 0.2, .restitution = 0.5, .friction = 0.5});
    world.add(Drag{.linear = 0.1});
    run(world, 10, dt);
    EXPECT_NEAR(world.position(disc).y, 0.2, 1e-9);
    EXPECT_NEAR(length(world.velocity(disc)), 0, 1e-9);
    EXPECT_NEAR(energy(world).residual, 0, 0.01 * g);
}

// It took four million blows of nobody knows what speed, for every disc.
TEST(TimeOfImpactUnderForces, AForceThatIsNoNumberIsToldAtOnce) {
    World world({.gravity = {0, -g}});
    world.add(HalfPlane{});
    world.add(Body{.position = {0, 1}, .radius = 0.5});
    world.add(Body{.position = {3, 1}, .radius = 0.5});
    world.add(ForceField{.force = [](Vec2, Vec2, double, double t) { return t > 0.1 ? Vec2{NAN, 0} : Vec2{}; }});
    EXPECT_THROW(run(world, 1, dt), Error);
    EXPECT_LT(world.collisions(), 1000u);
}
