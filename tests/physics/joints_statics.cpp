// What hangs on joints, or leans on them, and stands as it was put down: by forces in balance, to the bit.

#include <algorithm>

#include "joints.hpp"

namespace carom {
namespace {

using namespace test;

/// Joints that stand have forces balanced to 1e-12 of those on a body; those of many bodies add up.
constexpr double balanced = 1e-11;

std::vector<Vec2> places_of(const World& world) { return {world.positions().begin(), world.positions().end()}; }
bool stands(World& world, double seconds = 0.5) {
    const std::vector<Vec2> before = places_of(world);
    run(world, seconds, frame);
    return std::ranges::equal(world.positions(), before);
}
double weight_of(const World& world) {
    double sum = 0;
    for (const BodyId id : world.ids())
        if (world.body(id).kind == Kind::dynamic) sum += gravity * world.body(id).mass;
    return sum;
}
/// What the ground and fixed bodies give to the others.
Vec2 held_by(const World& world) {
    Vec2 sum{};
    for (std::size_t k = 0; k < world.joints().size(); ++k) {
        const Joint& joint = world.joints()[k];
        const Vec2 force = world.reaction(world.joint_ids()[k]).force;
        if (!joint.a || world.body(*joint.a).kind == Kind::fixed) sum += force;
        if (world.body(joint.b).kind == Kind::fixed) sum -= force;
    }
    return sum;
}

/// A sheet that is asked.
template <class IsHeld>
World hanging_sheet(int n, IsHeld is_held) {
    World world = hinged_sheet(n, is_held);
    Settings settings = world.settings();
    std::get<SoftStep>(settings.solver).statics = true;
    world.configure(settings);
    return world;
}

TEST(JointStatics, ASheetHangsByForcesInBalance) {
    World world = hanging_sheet(20, [](int column) { return column == 0 || column == 19; });
    const std::vector<Vec2> before = places_of(world);
    watch(world, 1, [&] {
        EXPECT_EQ(energy(world).kinetic + energy(world).rotational, 0);
        const Vec2 held = held_by(world);
        EXPECT_NEAR(held.y, weight_of(world), balanced * weight_of(world));
        EXPECT_NEAR(held.x, 0, balanced * weight_of(world));
    });
    EXPECT_EQ(places_of(world), before);
}

TEST(JointStatics, TwoRodsShareALoadByTheirSlope) {
    World world = mechanism_world();
    const BodyId load = world.add(Body{.position = {1, -1}, .mass = 3});
    const JointId left = world.add(Joint{.b = load, .anchor_a = {0, 0}, .type = DistanceJoint{}});
    const JointId right = world.add(Joint{.b = load, .anchor_a = {2, 0}, .type = DistanceJoint{}});
    EXPECT_TRUE(stands(world));
    for (const JointId rod : {left, right})
        EXPECT_NEAR(length(world.reaction(rod).force), 3 * gravity / std::sqrt(2.0), 1e-12 * 3 * gravity);
}

TEST(JointStatics, ACantileverBendsItsWallByHalfItsWeightTimesItsLength) {
    World world = mechanism_world();
    std::optional<BodyId> last;
    JointId wall{};
    for (int i = 0; i < 20; ++i) {
        const BodyId next = world.add(rod({i + 0.5, 0}, 1));
        const JointId weld = world.add(Joint{.a = last, .b = next, .at = Vec2{double(i), 0}, .type = WeldJoint{}});
        if (!last) wall = weld;
        last = next;
    }
    EXPECT_TRUE(stands(world));
    EXPECT_NEAR(world.reaction(wall).force.y, 20 * gravity, balanced * 20 * gravity);
    EXPECT_NEAR(world.reaction(wall).torque, 200 * gravity, balanced * 200 * gravity);
}

/// An arm of 1 kg and 1 m that is held by its end and lies in x.
struct Arm {
    World world = mechanism_world();
    JointId hinge;
    explicit Arm(const RevoluteJoint& type) {
        const BodyId arm = world.add(rod({0.5, 0}, 1));
        hinge = world.add(Joint{.b = arm, .at = Vec2{}, .type = type});
    }
};

TEST(JointStatics, DryFrictionHoldsWhatItCan) {
    constexpr double needed = gravity / 2, hair = 1e-9;
    Arm strong({.motor = JointMotor{.speed = 0, .maximum = needed * (1 + hair)}});
    EXPECT_TRUE(stands(strong.world));
    EXPECT_NEAR(strong.world.reaction(strong.hinge).torque, needed, 1e-12 * needed);
    Arm weak({.motor = JointMotor{.speed = 0, .maximum = needed * (1 - hair)}});
    EXPECT_FALSE(stands(weak.world));
    Arm brake({.motor = JointMotor{.speed = 0}});
    EXPECT_TRUE(stands(brake.world));
}

TEST(JointStatics, AStopHoldsOneWay) {
    Arm held({.limits = {.lower = 0}});
    EXPECT_TRUE(stands(held.world));
    EXPECT_NEAR(held.world.reaction(held.hinge).torque, gravity / 2, 1e-12 * gravity);
    Arm falls({.limits = {.upper = 0}});
    EXPECT_FALSE(stands(falls.world));
    Arm near({.limits = {.lower = -1e-6}});
    EXPECT_FALSE(stands(near.world));
    // A stop and dry friction that would not do alone.
    Arm both({.motor = JointMotor{.speed = 0, .maximum = 1}, .limits = {.lower = 0}});
    EXPECT_TRUE(stands(both.world));
    EXPECT_NEAR(both.world.reaction(both.hinge).torque, gravity / 2, 1e-12 * gravity);
}

TEST(JointStatics, ARopeHangsAndDoesNotPush) {
    World world = mechanism_world();
    const BodyId load = world.add(Body{.position = {0, -1}, .mass = 2});
    const JointId rope = world.add(Joint{.b = load, .type = DistanceJoint{.limits = {.upper = 1}}});
    EXPECT_TRUE(stands(world));
    EXPECT_NEAR(world.reaction(rope).force.y, 2 * gravity, 1e-12 * 2 * gravity);
    World upright = mechanism_world();
    const BodyId above = upright.add(Body{.position = {0, 1}, .mass = 2});
    upright.add(Joint{.b = above, .type = DistanceJoint{.limits = {.upper = 1}}});
    EXPECT_FALSE(stands(upright));
}

// To the bit it is in balance; it falls from a hair beside.
TEST(JointStatics, APendulumStandsOnItsHead) {
    for (const double aside : {0.0, 1e-9}) {
        World world = mechanism_world();
        const BodyId bob = world.add(Body{.position = {aside, 1}, .mass = 1});
        world.add(Joint{.b = bob, .type = DistanceJoint{}});
        EXPECT_EQ(stands(world), aside == 0) << aside;
    }
}

TEST(JointStatics, APendulumAtItsTurningPointDoesNot) {
    World world = mechanism_world();
    add_chain(world, 1, 1);
    EXPECT_FALSE(stands(world));
}

TEST(JointStatics, ASpringHoldsWhatItIsStretchedFor) {
    constexpr double stiffness = 1024, load = 2;
    for (const double aside : {0.0, 1e-6}) {
        World world = mechanism_world();
        const double stretched = load * gravity / stiffness;
        const BodyId bob = world.add(Body{.position = {0, -1 - stretched - aside}, .mass = load});
        const JointId spring = world.add(
            Joint{.b = bob, .type = DistanceJoint{.length = 1, .spring = JointSpring{.stiffness = stiffness}}});
        EXPECT_EQ(stands(world), aside == 0) << aside;
        if (aside == 0) {
            EXPECT_NEAR(world.reaction(spring).force.y, load * gravity, 1e-12 * load * gravity);
        }
    }
}

TEST(JointStatics, EqualLoadsOnAPulleyStand) {
    for (const double more : {0.0, 1e-9}) {
        World world = mechanism_world();
        const BodyId a = world.add(Body{.position = {-1, -2}, .mass = 3});
        const BodyId b = world.add(Body{.position = {1, -3}, .mass = 3 + more});
        world.add(Joint{.a = a, .b = b, .type = PulleyJoint{.ground_a = {-1, 0}, .ground_b = {1, 0}}});
        EXPECT_EQ(stands(world), more == 0) << more;
    }
}

/// A plank on a hinge in its middle, with a box on one end and one of twice the mass half as far out.
TEST(JointStatics, ASeesawStandsInBalance) {
    for (const double aside : {0.0, 1e-6}) {
        World world = mechanism_world();
        const auto box = [&](Vec2 at, double width, double height, double mass) {
            return world.add(Body{.position = at,
                                  .shapes = {{.geometry = Box{width, height}, .density = mass / (width * height)}},
                                  .restitution = 0,
                                  .friction = 0.6});
        };
        const BodyId plank = box({0, 0}, 8, 0.25, 4);
        const JointId hinge = world.add(Joint{.b = plank, .at = Vec2{}, .type = RevoluteJoint{}});
        box({-3, 0.375}, 0.5, 0.5, 1), box({1.5 + aside, 0.375}, 0.5, 0.5, 2);
        EXPECT_EQ(stands(world), aside == 0) << aside;
        if (aside == 0) {
            EXPECT_NEAR(world.reaction(hinge).force.y, 7 * gravity, balanced * 7 * gravity);
        }
    }
}

// It is in balance, but the joint does not bear it.
TEST(JointStatics, WhatIsTooHeavyBreaksItsJoint) {
    for (const double hair : {-1e-9, 1e-9}) {
        World world = mechanism_world();
        const BodyId load = world.add(Body{.position = {0, -1}, .mass = 2});
        world.add(Joint{.b = load, .type = DistanceJoint{}, .break_force = 2 * gravity * (1 + hair)});
        EXPECT_EQ(stands(world), hair > 0);
        EXPECT_EQ(world.joints().empty(), hair < 0);
    }
}

TEST(JointStatics, AMotorThatTurnsIsNotAsked) {
    World world = mechanism_world();
    const BodyId wheel = world.add(Body{.mass = 1, .radius = 0.5});
    world.add(Joint{.b = wheel, .at = Vec2{}, .type = RevoluteJoint{.motor = JointMotor{.speed = 1, .maximum = 1}}});
    run(world, 1, frame);
    EXPECT_NEAR(world.body(wheel).angular_velocity, 1, 1e-9);
}

// A chain of hinges has a long way to hand a load on, and a ring of welds more rows than ways to move.
TEST(JointStatics, LongChainsAndRingsAreFoundToStand) {
    World chain = mechanism_world();
    std::optional<BodyId> last;
    for (int i = 0; i < 1000; ++i) {
        const BodyId next = chain.add(rod({0, -0.1 * (i + 0.5)}, 0.1));
        chain.add(Joint{.a = last, .b = next, .at = Vec2{0, -0.1 * i}, .type = RevoluteJoint{}});
        last = next;
    }
    EXPECT_TRUE(stands(chain));
    EXPECT_NEAR(held_by(chain).y, weight_of(chain), balanced * weight_of(chain));
    World ring = mechanism_world();
    std::vector<BodyId> of_ring;
    const auto at = [](double i) { return Vec2{std::cos(pi * i / 6), std::sin(pi * i / 6)}; };
    for (int i = 0; i < 12; ++i) of_ring.push_back(ring.add(Body{.position = at(i), .mass = 1, .radius = 0.2}));
    for (std::size_t i = 0; i < 12; ++i)
        ring.add(Joint{
            .a = of_ring[i], .b = of_ring[(i + 1) % 12], .at = at(static_cast<double>(i) + 0.5), .type = WeldJoint{}});
    ring.add(Joint{.b = of_ring[3], .at = Vec2{0, 1}, .type = RevoluteJoint{}});
    EXPECT_TRUE(stands(ring));
    EXPECT_NEAR(held_by(ring).y, weight_of(ring), balanced * weight_of(ring));
}

TEST(JointStatics, WhoIsWokenKeepsItsPlace) {
    World world = hanging_sheet(12, [](int column) { return column % 11 == 0; });
    run(world, 0.1, frame);
    const std::vector<Vec2> before = places_of(world);
    world.wake(world.ids().back());
    double moved = 0;
    watch(world, 1, [&] {
        for (std::size_t i = 0; i < before.size(); ++i)
            moved = std::max(moved, length(world.positions()[i] - before[i]));
    });
    EXPECT_LE(moved, 1e-11);  // gaps that are closed, of a metre
}

// What is pulled down by a hundredth of its weight begins with the forces that it stood by.
TEST(JointStatics, WhoIsTouchedGoesOnAsEver) {
    World world = mechanism_world();
    world.add(HalfPlane{.side = {.restitution = 0}});
    const BodyId plank =
        world.add(Body{.position = {0, 1}, .shapes = {{.geometry = Box{4, 0.2}}}, .restitution = 0, .friction = 0.6});
    world.add(Joint{.b = plank, .at = Vec2{-2, 1}, .type = WeldJoint{}});
    EXPECT_TRUE(stands(world));
    world.add(Body{.position = {1, 2}, .shapes = {{.geometry = Box{0.2, 0.2}}}, .restitution = 0, .friction = 0.6});
    watch(world, 3, [&] { EXPECT_LE(largest_gap(world), 1e-10); });
    EXPECT_NEAR(held_by(world).y, weight_of(world), balanced * weight_of(world));  // it stands again
}

// It swings by a tenth of a millimetre, slower than what is asked, and all but in balance at every passage.
TEST(JointStatics, ASlowPendulumIsNotStopped) {
    constexpr double swing = 1e-4;
    World world = mechanism_world({.keep_energy = true});
    const BodyId bob = world.add(Body{.position = {swing, -std::sqrt(1 - swing * swing)}, .mass = 1});
    world.add(Joint{.b = bob, .type = DistanceJoint{}});
    double most = 0;
    watch(world, 33, [&] {
        if (world.time() > 30) most = std::max(most, std::abs(world.position(bob).x));
    });
    EXPECT_NEAR(most, swing, 0.01 * swing);  // the largest of some ninety samples a swing
    EXPECT_FALSE(world.asleep(bob));
}

// Slower than what comes to rest, and its forces in balance to rounding: it is free, and not stopped for being slow.
TEST(JointStatics, APendulumThatHardlySwingsGoesOnWhereNobodySleeps) {
    constexpr double swing = 1e-13;
    const double speed = std::sqrt(gravity) * swing;
    World world = mechanism_world({.sleep = false});
    const BodyId bob = world.add(Body{.position = {0, -1}, .velocity = {speed, 0}, .mass = 1});
    world.add(Joint{.b = bob, .type = DistanceJoint{}});
    double most = 0;
    watch(world, 10, [&] {
        if (world.time() > 7) most = std::max(most, std::abs(world.velocity(bob).x));
    });
    EXPECT_NEAR(most, speed, 0.01 * speed);  // the largest of some ninety samples a swing
}

// Friction takes in a step what it can, and not all that is slow.
TEST(JointStatics, SlowMotionAgainstLittleFrictionGoesOn) {
    constexpr double torque = 1e-7, force = 1e-5, inertia = 0.005, w = 0.01, v = 1e-3;
    World world = mechanism_world();
    const BodyId wheel = world.add(Body{.angular_velocity = w, .mass = 1, .moment_of_inertia = inertia, .radius = 0.1});
    world.add(Joint{.b = wheel, .type = RevoluteJoint{.motor = JointMotor{.maximum = torque}}});
    const BodyId slide = world.add(Body{.position = {3, 0}, .velocity = {v, 0}, .mass = 1, .radius = 0.1});
    world.add(Joint{.b = slide, .at = Vec2{3, 0}, .type = PrismaticJoint{.motor = JointMotor{.maximum = force}}});
    run(world, 10, frame);
    EXPECT_NEAR(world.body(wheel).angular_velocity, w - 10 * torque / inertia, 1e-9);
    EXPECT_NEAR(world.velocity(slide).x, v - 10 * force, 1e-9);
}

// A weld, a slide and a brake that a body without moment of inertia hangs on.
TEST(JointStatics, WhatCannotBeTurnedStandsAsOthers) {
    World world = mechanism_world();
    const auto hang = [&](double x, const JointType& type) {
        const BodyId point = world.add(Body{.position = {x, 0}, .mass = 1});
        world.add(Joint{.b = point, .at = Vec2{x, 0}, .type = type});
    };
    hang(0, WeldJoint{}), hang(1, PrismaticJoint{.axis = {0, 1}, .limits = {.lower = 0}});
    hang(2, RevoluteJoint{.motor = JointMotor{}});
    EXPECT_TRUE(stands(world));
    for (const BodyId id : world.ids()) EXPECT_TRUE(world.asleep(id));
}

/// A car on its wheels, whose suspensions are at their stops or cannot give way; what its rows know of that is not
/// only what its joints remember.
World car_on_its_stops(const JointLimits& limits) {
    World world = mechanism_world();
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 1}});
    const auto add = [&](Vec2 at, const Geometry& shape) {
        return world.add(Body{.position = at, .shapes = {{.geometry = shape}}, .restitution = 0, .friction = 1});
    };
    const BodyId car = add({0, 0.8}, Box{3, 0.5});
    for (const double x : {-1.0, 1.0})
        world.add(Joint{.a = car,
                        .b = add({x, 0.3}, Disc{.radius = 0.3}),
                        .at = Vec2{x, 0.3},
                        .type = WheelJoint{.limits = limits}});
    return world;
}
TEST(JointStatics, ACarOnItsStopsIsWokenWithoutAJump) {
    for (const JointLimits& limits : {JointLimits{-0.1, 0}, JointLimits{{}, 0}, JointLimits{0, 0}}) {
        World world = car_on_its_stops(limits);
        run(world, 0.5, frame);
        const std::vector<Vec2> before = places_of(world);
        for (const BodyId id : world.ids()) {
            EXPECT_TRUE(world.asleep(id));
            world.wake(id);
        }
        watch(world, 0.5, [&] {
            for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LE(length(world.positions()[i] - before[i]), 1e-12);
        });
        EXPECT_LE(energy(world).heat.impact, 1e-12);
    }
}

// At which of their steps rows are is part of what a restored run begins with, too.
TEST(JointStatics, ARestoredRunIsWokenAsTheOther) {
    World world = car_on_its_stops({-0.1, 0}), other = car_on_its_stops({-0.1, 0});
    run(world, 0.5, frame);
    restore_from(world, other);
    for (World* each : {&world, &other}) {
        each->apply_impulse(each->ids().front(), {0, -1}, {1, 0.8});
        run(*each, 1, frame);
    }
    EXPECT_EQ(state_hash(other), state_hash(world));
}

// A snapshot holds no rows: what sleeps by joints is looked at again where it is.
TEST(JointStatics, ARestoredRunBooksWhatHoldsItAsTheOther) {
    const auto sheet = [] { return hanging_sheet(5, [](int column) { return column % 4 == 0; }); };
    World world = sheet(), other = sheet();
    run(world, 0.2, frame);
    restore_from(world, other);
    for (World* each : {&world, &other}) run(*each, 0.2, frame);
    const Momentum held = momentum_balance(world).held, held_there = momentum_balance(other).held;
    EXPECT_GT(held.linear.y, 0);
    EXPECT_EQ(held_there.linear, held.linear);
    EXPECT_EQ(held_there.angular, held.angular);
}

TEST(JointStatics, AreTheSameForAllThreads) {
    const auto forces = [](int threads) {
        World world = hanging_sheet(15, [](int column) { return column % 7 == 0; });
        Settings settings = world.settings();
        settings.threads = threads;
        world.configure(settings);
        run(world, 0.1, frame);
        std::vector<double> all;
        for (const JointId id : world.joint_ids())
            for (const double f : {world.reaction(id).force.x, world.reaction(id).force.y}) all.push_back(f);
        return all;
    };
    EXPECT_EQ(forces(1), forces(2));
}

/// Whether beads on a string of rods stand around the top of a fixed drum, where its ends are pulled by forces of which
/// the larger is so much of what friction can hold: T₂/T₁ = ((1 + µ tan δ/2)/(1 − µ tan δ/2))ⁿ.
bool beads_hold(int beads, double mu, double of_most) {
    World world = mechanism_world({}, {});
    const double reach = 1.02, apart = pi / 40, slope = mu * std::tan(apart / 2);
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Disc{.radius = 1}}}, .restitution = 0, .friction = mu});
    const auto place = [&](double k) {
        const double angle = pi / 2 - (k - (beads - 1) / 2.0) * apart;
        return reach * Vec2{std::cos(angle), std::sin(angle)};
    };
    std::vector<BodyId> made;
    for (int i = 0; i < beads; ++i) {
        made.push_back(world.add(Body{.position = place(i),
                                      .mass = 0.1,
                                      .fixed_rotation = true,
                                      .radius = reach - 1,
                                      .restitution = 0,
                                      .friction = mu}));
        if (i > 0) world.add(Joint{.a = made[made.size() - 2], .b = made.back(), .type = DistanceJoint{}});
    }
    const auto pull = [&](BodyId on, double from, double to, double force) {
        const Vec2 way = place(to) - place(from);
        world.add(ConstantForce{.body = on, .force = force / length(way) * way});
    };
    const double most = std::pow((1 + slope) / (1 - slope), beads), weak = 10;
    pull(made.front(), 0, -1, weak), pull(made.back(), beads - 1, beads, weak * (1 + (most - 1) * of_most));
    const Vec2 before = world.position(made.back());
    run(world, 0.5, frame);
    return length(world.position(made.back()) - before) < 1e-13;  // what stands does not move
}

// Twenty beads let go at 0.89 of it, since whoever bore too much was made to bear no more than four fifths of it, and
// so were all. Weights, of a tenth of the pull, move the bound by less than a hundredth.
TEST(JointStatics, AStringOfBeadsHoldsOnADrumWhatFrictionCan) {
    for (const double mu : {0.2, 0.5}) {
        EXPECT_TRUE(beads_hold(20, mu, 0.98)) << mu;
        EXPECT_FALSE(beads_hold(20, mu, 1.001)) << mu;
    }
}

}  // namespace
}  // namespace carom
