// An exact gas and bodies that are moved in steps, in one scene: every hit against the algebra of impacts, the books of
// both, and closed forms of what a gas does to a piston.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <string>

#include "error_of.hpp"
#include "restored.hpp"
#include "throughput.hpp"

namespace carom {
namespace {

using test::error_of;
using test::restore_from;
using test::Throughput;

Shape box(double width, double height, double restitution = 1, double friction = 0) {
    return {.geometry = Box{.width = width, .height = height}, .restitution = restitution, .friction = friction};
}

/// What an impact may not change.
struct Kept {
    Vec2 momentum;
    double angular, energy;

    explicit Kept(const World& world) {
        const Momentum m = momentum_balance(world).total;
        momentum = m.linear, angular = m.angular, energy = carom::energy(world).total();
    }
};

/// A disc on its way to a free box that turns.
World disc_and_box(double restitution, double friction) {
    World world({.solver = Events{}});
    world.add(Body{.angle = 0.3,
                   .velocity = {0.1, 0.05},
                   .angular_velocity = 0.7,
                   .mass = 3,
                   .shapes = {box(1, 0.6, restitution, friction)},
                   .name = "box"});
    world.add(Body{.position = {-3, 0.2},
                   .velocity = {2, 0},
                   .radius = 0.2,
                   .restitution = restitution,
                   .friction = friction,
                   .name = "disc"});
    return world;
}

/// In free flight the way of a body is a straight line and its turning even, so that a step adds nothing to an impact
/// but rounding: some hundred roundings of 1e-16 in a run.
TEST(Together, AFreeBoxAndADiscKeepWhatAnImpactKeeps) {
    for (const double friction : {0.0, 0.4}) {
        World world = disc_and_box(1, friction);
        const Kept before(world);
        run(world, 3, 0.05);
        const Kept after(world);
        EXPECT_EQ(world.gas().wall_collisions, 1u);
        EXPECT_NEAR(length(after.momentum - before.momentum), 0, 1e-14);
        EXPECT_NEAR(after.angular, before.angular, 1e-13);
        EXPECT_NEAR(after.energy + energy(world).heat.total(), before.energy, 1e-13);
        EXPECT_NEAR(energy(world).residual, 0, 1e-13);
        if (friction == 0)
            EXPECT_NEAR(energy(world).heat.total(), 0, 1e-14);
        else
            EXPECT_GT(energy(world).heat.friction, 1e-3);
    }
}

/// The step is only how often somebody looks, where no force acts: an instant that is found to 1e-14 s.
TEST(Together, FreeBodiesDoNotFeelTheStep) {
    World coarse = disc_and_box(0.6, 0.3), fine = disc_and_box(0.6, 0.3);
    run(coarse, 3, 0.5), run(fine, 3, 0.01);
    for (const char* name : {"box", "disc"}) {
        const BodyId id = coarse.find(name);
        EXPECT_NEAR(length(coarse.position(id) - fine.position(id)), 0, 1e-12);
        EXPECT_NEAR(coarse.angle(id), fine.angle(id), 1e-12);
    }
}

/// Under gravity alone forces are constant, and the parabola on which the gas sees a body is the body's.
TEST(Together, FallingBodiesDoNotFeelTheStepEither) {
    const auto make = [] {
        World world({.gravity = {0, -1}, .solver = Events{}});
        world.add(Rectangle{.low = {0, 0}, .high = {4, 1e3}});
        world.add(Body{.position = {2, 5},
                       .mass = 10,
                       .shapes = {{.geometry = Segment{.a = {-2, 0}, .b = {2, 0}}}},
                       .name = "lid"});
        Random random(3);
        for (int k = 0; k < 30; ++k)
            world.add(Body{.position = {0.4 + 0.6 * (k % 6), 0.4 + 0.7 * (k / 6)},
                           .velocity = {random.normal(), random.normal()},
                           .radius = 0.1});
        return world;
    };
    World world = make();
    const double start = energy(world).total();
    run(world, 20, 0.05);
    EXPECT_GT(world.gas().wall_collisions, 300u);
    EXPECT_NEAR(energy(world).total(), start, 1e-12 * start);
    EXPECT_NEAR(energy(world).residual, 0, 1e-12 * start);
    EXPECT_EQ(world.angle(world.find("lid")), 0);
}

/// Bodies of all sorts that a gas strikes: a piston on a slide and a spring with damping, a pendulum, a vane on a pin,
/// a free box, and a weight that falls on a floor.
World everything(double restitution, double friction) {
    World world({.gravity = {0, -2}, .solver = Events{}});
    world.add(Rectangle{.low = {0, 0}, .high = {12, 8}});
    const BodyId piston = world.add(Body{.position = {10, 4}, .mass = 20, .shapes = {box(0.2, 7.9)}, .name = "piston"});
    const BodyId hook = world.add(Body{.kind = Kind::fixed, .position = {12, 4}});
    world.add(Spring{.a = hook, .b = piston, .stiffness = 30, .rest_length = 2.5, .damping = 0.5});
    world.add(Joint{.b = piston, .at = Vec2{10, 4}, .type = PrismaticJoint{.axis = {1, 0}}});
    const BodyId bob = world.add(
        Body{.position = {3.2, 5}, .mass = 8, .radius = 0.4, .restitution = restitution, .friction = friction});
    world.add(Joint{.b = bob, .anchor_a = {2, 7.5}, .type = DistanceJoint{}});
    const BodyId vane = world.add(Body{.position = {6, 5.5}, .mass = 6, .shapes = {box(2.6, 0.2, 1, friction)}});
    world.add(Joint{.b = vane, .at = Vec2{6, 5.5}, .type = RevoluteJoint{}});
    world.add(Body{.position = {8, 3}, .angle = 0.4, .mass = 5, .shapes = {box(0.9, 0.6, restitution, friction)}});
    world.add(Body{.position = {4, 1}, .mass = 9, .shapes = {box(0.8, 0.8, 0.2, 0.5)}});
    Random random(9);
    for (int k = 0; k < 40; ++k)
        world.add(Body{.position = {0.3 + 0.45 * (k % 20), 1.9 + 0.4 * (k / 20)},
                       .velocity = {random.normal(), random.normal()},
                       .mass = 0.5,
                       .radius = 0.08,
                       .restitution = restitution,
                       .friction = friction});
    return world;
}

/// The sum of all accounts is the change of energy and momentum, with the residual as one of them: of what flowed, to
/// some ten thousand roundings.
TEST(Together, TheLedgerClosesOverBoth) {
    for (const double restitution : {1.0, 0.8})
        for (const double friction : {0.0, 0.3}) {
            World world = everything(restitution, friction);
            Throughput through(world);
            for (int k = 0; k < 300; ++k) world.step(0.02), through.add(world);
            EXPECT_GT(world.gas().wall_collisions, 100u);
            const MomentumBalance m = momentum_balance(world);
            EXPECT_LE(std::abs(energy(world).unaccounted()), 1e-12 * through.energy);
            EXPECT_LE(length(m.unaccounted().linear), 1e-12 * through.momentum);
            EXPECT_LE(std::abs(m.unaccounted().angular), 1e-12 * through.angular);
        }
}

/// Small discs that fly along x in lanes of their own between a wall and a piston: a gas of one dimension, in a room
/// that is narrower by a diameter. The piston hangs on a spring.
World points_and_piston(int points, double mass, double stiffness, double from) {
    World world({.solver = Events{}});
    constexpr double r = 5e-4;
    world.add(Rectangle{.low = {-r, 0}, .high = {20, 1}});
    const BodyId piston = world.add(Body{.position = {from + r, 0.5},
                                         .mass = mass,
                                         .shapes = {{.geometry = Segment{.a = {0, -0.5}, .b = {0, 0.5}}}},
                                         .name = "piston"});
    const BodyId wall = world.add(Body{.kind = Kind::fixed, .position = {20 + r, 0.5}});
    world.add(Spring{.a = wall, .b = piston, .stiffness = stiffness, .rest_length = 19});
    for (int k = 0; k < points; ++k) {  // with speed 1 where the room is 1 m long
        const double phase = std::fmod(k * 0.6180339887498949, 1.0) * 2, x = phase < 1 ? phase : 2 - phase;
        world.add(Body{.position = {x * from, 0.02 + 0.96 * (k + 0.5) / points},
                       .velocity = {(phase < 1 ? 1 : -1) / from, 0},
                       .mass = 4.0 / points,
                       .radius = r});
    }
    return world;
}

/// A gas of N points with speed u in one dimension presses with N m u²/L and is compressed as u ∝ 1/L, so that it is a
/// spring of stiffness 3 N m u²/L², here 12 N/m. That is of points much faster than the piston: it swings once in 70 of
/// their ways. The fluctuations of the blows are some 1e-3 of the swing.
TEST(Together, AGasIsASpring) {
    for (const double stiffness : {4.0, 100.0}) {
        const double mass = 2000 * (12 + stiffness) / 16;
        World world = points_and_piston(200, mass, stiffness, 1.02);
        const BodyId piston = world.find("piston");
        world.add(ConstantForce{.body = piston, .force = {-4, 0}});
        const double dt = 0.05;
        double last = 0, first = -1, latest = 0;
        int swings = 0;
        while (swings < 3 && world.time() < 400) {
            world.step(dt);
            const double x = world.position(piston).x - 1 - 5e-4;
            if (last < 0 && x >= 0) {
                latest = world.time() - dt * x / (x - last);
                if (first < 0)
                    first = latest;
                else
                    ++swings;
            }
            last = x;
        }
        const double omega = 2 * 0x1.921fb54442d18p1 * swings / (latest - first);
        EXPECT_NEAR(omega, std::sqrt((stiffness + 12) / mass), 5e-3 * omega);
    }
}

/// That the spring's force does not know of the blows within a step is an error of second order, in the energy and in
/// the place. The sizes of both are measured over steps from 0.1 s to 0.1/16 s: 256 times as small but for chance.
TEST(Together, TheErrorIsOfSecondOrder) {
    double residual[2];
    for (int k = 0; k < 2; ++k) {
        World world = points_and_piston(400, 1, 4, 1.05);
        run(world, 3, k == 0 ? 0.1 : 0.1 / 16);
        residual[k] = std::abs(energy(world).residual);
    }
    EXPECT_GT(residual[0] / residual[1], 128);
    EXPECT_LT(residual[0] / residual[1], 512);
    EXPECT_LT(residual[1], 1e-4);
}

/// A bob that swings in a gas at rest gives it its energy; the rod does no work. The hits act through the rod: a free
/// bob that is held afterwards would lose some of each. What is left is of second order in the step: 1e-5 of the swing,
/// and a 64th of it, but for chance.
TEST(Together, APendulumGivesItsSwingToTheGas) {
    const auto lost = [](double dt) {
        World world({.gravity = {0, -1}, .solver = Events{}});
        world.add(Rectangle{.low = {-6, -6}, .high = {6, 6}});
        const BodyId bob = world.add(Body{.position = {4, 1}, .mass = 30, .radius = 0.8});
        world.add(Joint{.b = bob, .anchor_a = {0, 1}, .type = DistanceJoint{}});
        Random random(2);
        for (int k = 0; k < 120; ++k)
            world.add(Body{.position = {-5.5 + 0.9 * (k % 12), -5.5 + 0.45 * (k / 12)},
                           .velocity = 0.7 * Vec2{random.normal(), random.normal()},
                           .radius = 0.15});
        const double start = energy(world).total(), swing = 30 * 4;
        run(world, 30, dt);
        const Vec2 v = world.velocity(bob);
        EXPECT_LT(15 * squared_length(v) + 30 * (world.position(bob).y + 3), 0.8 * swing) << "the swing is less";
        EXPECT_NEAR(length(world.position(bob) - Vec2{0, 1}), 4, 1e-8);
        EXPECT_NEAR(energy(world).heat.total(), 0, 1e-12 * swing);
        return std::abs(energy(world).total() - start) / swing;
    };
    EXPECT_LT(lost(0.02), 1e-4);
    EXPECT_LT(lost(0.0025), 2e-6);
}

/// What is right of the middle is what is left of it, seen in a mirror, until chaos has made much of the last bit.
TEST(Together, AMirrorChangesNothing) {
    const auto make = [](double side) {
        World world({.gravity = {0, -1}, .solver = Events{}});
        world.add(Rectangle{.low = {-4, 0}, .high = {4, 6}});
        const BodyId vane = world.add(
            Body{.position = {side * 1, 3}, .angle = side * 0.3, .mass = 5, .shapes = {box(2, 0.2)}, .name = "vane"});
        world.add(Joint{.b = vane, .at = Vec2{side * 1, 3}, .type = RevoluteJoint{}});
        Random random(4);
        for (int k = 0; k < 10; ++k)
            world.add(Body{.position = {side * (-3 + 0.5 * k), 1 + 0.05 * k},
                           .velocity = {side * random.normal(), random.normal()},
                           .radius = 0.1});
        return world;
    };
    World left = make(-1), right = make(1);
    run(left, 2, 0.02), run(right, 2, 0.02);
    EXPECT_GT(right.gas().wall_collisions, 5u);
    EXPECT_EQ(right.collisions(), left.collisions());
    for (std::size_t k = 0; k < left.size(); ++k) {
        EXPECT_NEAR(left.positions()[k].x, -right.positions()[k].x, 1e-9);
        EXPECT_NEAR(left.positions()[k].y, right.positions()[k].y, 1e-9);
    }
    EXPECT_NEAR(left.angles()[0], -right.angles()[0], 1e-9);
}

/// A world that was saved in the middle goes on with the same bits, by one thread and by four.
TEST(Together, GoesOnWithTheSameBits) {
    World world = everything(0.8, 0.3);
    Settings settings = world.settings();
    settings.threads = 4;
    World threaded = everything(0.8, 0.3);
    threaded.configure(settings);
    for (int k = 0; k < 100; ++k) world.step(0.02), threaded.step(0.02);
    World again = everything(0.8, 0.3);
    restore_from(world, again);
    for (int k = 0; k < 100; ++k) world.step(0.02), threaded.step(0.02), again.step(0.02);
    EXPECT_EQ(state_hash(again), state_hash(world));
    EXPECT_EQ(state_hash(threaded), state_hash(world));
    EXPECT_EQ(again.collisions(), world.collisions());
}

/// A box falls on discs that lie on a floor: elastic ones throw it up again and again, and with inelastic ones it comes
/// to rest on what they tremble, less than 1e-4 of a radius.
TEST(Together, ABoxComesToRestOnDiscs) {
    World world({.gravity = {0, -9.81}, .solver = Events{}});
    world.add(Rectangle{.low = {0, 0}, .high = {4, 100}});
    const BodyId lid = world.add(Body{.position = {2, 2}, .mass = 10, .shapes = {box(3, 0.5, 0.5, 0.3)}});
    Random random(3);
    for (int k = 0; k < 6; ++k)
        world.add(Body{.position = {0.5 + 0.6 * k, 0.5},
                       .velocity = {0.1 * random.normal(), 0},
                       .radius = 0.2,
                       .restitution = 0.5});
    Throughput through(world);
    for (int k = 0; k < 100; ++k) world.step(0.01), through.add(world);
    EXPECT_NEAR(world.position(lid).y, 0.65, 1e-4 * 0.2);
    EXPECT_NEAR(world.angle(lid), 0, 1e-4);
    EXPECT_GT(world.gas().made_elastic, 1000u);
    EXPECT_LE(std::abs(energy(world).unaccounted()), 1e-12 * through.energy);
}

TEST(Together, SaysWhatItCannotDo) {
    const auto refusal = [](auto spoil) {
        World world({.solver = Events{}});
        world.add(Body{.position = {3, 0}, .velocity = {1, 0}, .radius = 0.5, .name = "disc"});
        const BodyId id = world.add(Body{.shapes = {box(1, 1)}, .name = "box"});
        spoil(world, id);
        return error_of([&] { world.check(); });
    };
    const auto expect = [&](const char* words, auto spoil) {
        EXPECT_NE(refusal(spoil).find(words), std::string::npos) << refusal(spoil);
    };
    EXPECT_EQ(refusal([](World&, BodyId) {}), "no error");
    expect("body 'box' in steps, which knows no periodic box", [](World& w, BodyId) {
        w.add(Periodic{{-5, -5}, {5, 5}});
    });
    expect("body 'point' has no radius and body 'box'", [](World& w, BodyId) {
        w.add(Body{.position = {9, 9}, .velocity = {1, 0}, .name = "point"});
    });
    expect("drag on all bodies", [](World& w, BodyId) { w.add(Drag{.linear = 1}); });
    expect("no disc here is free", [](World& w, BodyId id) { w.add(Spring{.a = id, .b = w.find("disc")}); });
    expect("'disc' and 'box' by 0.2 m", [](World& w, BodyId) { w.set_position(w.find("disc"), {0.8, 0}, 0); });
    EXPECT_EQ(refusal([](World& w, BodyId id) { w.add(Drag{.body = id, .linear = 1}); }), "no error");
}

}  // namespace
}  // namespace carom
