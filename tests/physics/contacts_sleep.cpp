// Sleep: who rests with all that it touches is left alone, and nobody can tell but by the time it takes.

#include <algorithm>
#include <carom/archive.hpp>
#include <string>

#include "physics/contacts.hpp"
#include "throughput.hpp"

namespace carom::test {
namespace {

World stack_of(int boxes, SoftStep solver = {}) {
    World world = floor_world(0.6, solver);
    add_stack(world, boxes);
    return world;
}

/// How many bodies sleep.
int sleepers(const World& world) {
    const auto ids = world.ids();
    return static_cast<int>(std::count_if(ids.begin(), ids.end(), [&](BodyId id) { return world.asleep(id); }));
}

World sleeping_stack() {
    World world = stack_of(5);
    pass(world, 15);
    return world;
}

TEST(Sleep, AStackFallsAsleepAndStopsToTheLastBit) {
    World world = stack_of(5);
    std::size_t asleep = 0;
    for (int step = 0; step < 900; ++step) {
        world.step(frame);
        asleep += world.events().sleeps.size();
        EXPECT_TRUE(world.events().wakes.empty());
    }
    EXPECT_EQ(asleep, 5u);
    EXPECT_EQ(sleepers(world), 5);
    EXPECT_EQ(motion(world), 0);
    const auto before = state_hash(world);
    pass(world, 5);
    EXPECT_EQ(state_hash(world), before);
}

// A body at rest is slower than 1e-6 g dt = 2e-7 m/s, and sweeps bring it to rest at a rate of many a second: what is
// left of its way is below a tenth of a micrometre.
TEST(Sleep, NobodyLiesElsewhereForIt) {
    const World asleep = sleeping_stack();
    World awake = stack_of(5, {.sleep = false});
    pass(awake, 30);
    EXPECT_EQ(sleepers(awake), 0);
    for (const BodyId id : awake.ids()) {
        EXPECT_NEAR(asleep.position(id).x, awake.position(id).x, 1e-7);
        EXPECT_NEAR(asleep.position(id).y, awake.position(id).y, 1e-7);
    }
}

// The floor bears five kilograms, asleep or awake: m g t, to the 1e-6 that a stack at rest may still accelerate with.
TEST(Sleep, TheFloorBearsTheWeightAllTheSame) {
    World world = sleeping_stack();
    const MomentumBalance before = momentum_balance(world);
    const double residual = energy(world).residual;
    pass(world, 10);
    const MomentumBalance after = momentum_balance(world);
    EXPECT_NEAR(after.walls.linear.y - before.walls.linear.y, 5 * g * 10, 1e-5 * 5 * g * 10);
    EXPECT_NEAR(after.gravity.linear.y - before.gravity.linear.y, -5 * g * 10, 1e-9 * 5 * g * 10);
    EXPECT_NEAR(after.unaccounted().linear.y, 0, 1e-10 * 5 * g * 25);
    EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-10 * 5 * g * 5);
    EXPECT_NEAR(energy(world).residual, residual, 1e-10);  // rounding of 245 J that are moved in 10 s
    double borne = 0;
    for (const ContactPoint& point : world.contacts())
        if (point.shapes.at_wall()) borne += point.normal_force;
    EXPECT_NEAR(borne, 5 * g, 1e-5 * 5 * g);
}

TEST(Sleep, WhatFallsOnAStackWakesIt) {
    World world = sleeping_stack();
    world.add(box({0.2, 6.5}, 0.5, 0.5, 0.6));
    int steps = 0;
    while (world.events().wakes.empty() && ++steps < 120) world.step(frame);
    EXPECT_LT(steps, 60);  // it falls 1.25 m, in 0.5 s
    EXPECT_EQ(world.events().wakes.size(), 5u);
    pass(world, 15);
    EXPECT_EQ(sleepers(world), 6);
}

TEST(Sleep, AStackFallsWhenItsLowestBoxIsTakenAway) {
    World world = sleeping_stack();
    world.remove(world.ids()[0]);
    pass(world, 1);
    double lowest = 10;
    for (const Vec2 place : world.positions()) lowest = std::min(lowest, place.y);
    EXPECT_NEAR(lowest, 0.5, 0.01);  // it may clatter a little still
}

TEST(Sleep, AStackFallsWhenItsLowestBoxIsPutElsewhere) {
    World world = sleeping_stack();
    world.set_position(world.ids()[0], {5, 0.5}, 0);
    pass(world, 1);
    EXPECT_NEAR(world.positions()[1].y, 0.5, 0.01);
}

TEST(Sleep, APushWakes) {
    World world = sleeping_stack();
    const BodyId top = world.ids()[4];
    const double from = world.position(top).x;
    world.set_velocity(top, {1, 0}, 0);
    EXPECT_FALSE(world.asleep(top));
    pass(world, 1);
    EXPECT_GT(world.position(top).x - from, 0.05);  // v² / (2 µ g) = 0.085 m
}

TEST(Sleep, AChangeOfGravityWakesAll) {
    World world = sleeping_stack();
    Settings settings = world.settings();
    settings.gravity = {0, 1};
    world.configure(settings);
    pass(world, 1);
    EXPECT_NEAR(world.positions()[0].y, 0.5 + 0.5, 1e-2);
}

TEST(Sleep, APlatformThatSetsOffTakesItsLoadAlong) {
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    Body platform = box({0, 0}, 4, 0.5, 0.6);
    platform.kind = Kind::driven;
    const BodyId lift = world.add(platform);
    const BodyId load = world.add(box({0, 0.75}, 1, 1, 0.6));
    pass(world, 15);
    world.set_velocity(lift, {0, 0.5}, 0);
    pass(world, 2);
    EXPECT_NEAR(world.position(load).y, 0.75 + 1, 1e-3);
}

// On a spring nothing sleeps: its other end may be pulled, and it would not feel it.
TEST(Sleep, WhoHangsOnASpringStaysAwake) {
    World world = floor_world(0.6);
    const BodyId hook = world.add(Body{.kind = Kind::fixed, .position = {0, 3}});
    const BodyId load = world.add(box({0, 0.5}, 1, 1, 0.6));
    world.add(Spring{.a = hook, .b = load, .stiffness = 1, .rest_length = 2.5, .damping = 1});
    pass(world, 15);
    EXPECT_FALSE(world.asleep(load));
}

// It leans by a thousandth of its size over the edge: it takes seconds to be seen to fall.
TEST(Sleep, WhatIsAboutToTipDoesNotSleep) {
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    Body table = box({-2, 0}, 4, 1, 0.9);
    table.kind = Kind::fixed;
    world.add(table);
    const BodyId plank = world.add(box({0.001, 0.55}, 1, 0.1, 0.9));
    pass(world, 8);
    EXPECT_LT(world.position(plank).y, -0.5);
}

TEST(Sleep, ACopyAndARestoredWorldGoOnWithTheSameBits) {
    World world = stack_of(5), other = stack_of(5);
    pass(world, 15);
    ASSERT_EQ(sleepers(world), 5);
    restore_from(world, other);
    World copy = world;
    for (World* w : {&world, &other, &copy}) {
        EXPECT_EQ(sleepers(*w), 5);
        pass(*w, 1);
        w->set_velocity(w->ids()[2], {0.5, 0.1}, 0);
        pass(*w, 1);
    }
    EXPECT_EQ(state_hash(other), state_hash(world));
    EXPECT_EQ(state_hash(copy), state_hash(world));
    EXPECT_EQ(other.events(), world.events());
    EXPECT_EQ(energy(other).residual, energy(world).residual);
}

// Who sleeps is left out of the search for contacts. A world that is restored in every step has to search all anew.
TEST(Sleep, WhoIsLeftOutOfTheSearchIsFoundWhenItMatters) {
    World world = floor_world(0.6);
    for (int stack = 0; stack < 6; ++stack)
        for (int i = 0; i < 3; ++i) world.add(box({3.0 * stack, 0.5 + i}, 1, 1, 0.6));
    world.add(
        Body{.kind = Kind::driven, .position = {-9, 0.5}, .velocity = {1, 0}, .shapes = {{.geometry = Box{0.2, 0.8}}}});
    pass(world, 4);
    ASSERT_EQ(sleepers(world), 18);
    world.add(box({6.2, 8}, 1, 1, 0.6));  // falls on the third stack
    Body roller = disc({12, 20}, 0.3, 0.5);
    roller.velocity = {0.5, 0};  // comes down between the last two, and rolls
    world.add(roller);
    World other = world;
    std::size_t woken = 0;
    for (int step = 0; step < 400; ++step) {
        restore_from(other, other);
        world.step(frame), other.step(frame);
        ASSERT_EQ(state_hash(other), state_hash(world)) << step;
        ASSERT_EQ(other.contacts().size(), world.contacts().size()) << step;
        woken += world.events().wakes.size();
    }
    EXPECT_GE(woken, 9u);           // three stacks at least
    EXPECT_GE(sleepers(world), 3);  // and one that nobody touched
}

/// Forty boxes in stacks of two that sleep, and a disc that comes from the left.
World sleepers_and_disc(const Integrator& integrator, SoftStep solver = {}) {
    World world({.gravity = {0, -g}, .integrator = integrator, .solver = solver});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
    for (int k = 0; k < 40; ++k) world.add(box({2.0 * (k / 2), 0.5 + k % 2}, 1, 1, 0.6));
    return world;
}
BodyId roll_in(World& world, double speed) {
    Body roller = disc({-3, 0.5}, 0.5, 0.6);
    roller.velocity = {speed, 0}, roller.angular_velocity = -speed / 0.5;
    return world.add(roller);
}

// Rows of sleepers are neither moved nor booked one by one. What is kept of them is what is made anew after a
// checkpoint, to the last bit of every account: under methods that leave rows out and others, with forces that act on
// one body alone and without.
TEST(Sleep, AccountsDoNotTellWhetherSleepersWereLookedAt) {
    const auto run_with = [](const Integrator& integrator, bool forced, bool driven) {
        World world = sleepers_and_disc(integrator);
        if (forced) {
            world.add(Drag{.linear = 0.01});
            for (const std::size_t i : {0, 25}) world.add(ConstantForce{.body = world.ids()[i], .force = {0.5, -1}});
        }
        if (driven)
            world.add(Body{
                .kind = Kind::driven, .position = {-30, 5}, .velocity = {0.1, 0}, .shapes = {{.geometry = Box{1, 1}}}});
        pass(world, 25);
        ASSERT_EQ(sleepers(world), 40);
        const BodyId roller = roll_in(world, 4);
        if (forced) {
            const BodyId post = world.add(Body{.kind = Kind::fixed, .position = {-40, 0.5}});
            world.add(Spring{.a = post, .b = roller, .anchor_b = {0, 0.1}, .stiffness = 0.01, .rest_length = 30});
            world.add(ForceField{.body = roller, .force = [](Vec2 x, Vec2, double, double) {
                                     return Vec2{-0.01 * x.x, 0};
                                 }});
        }
        World other = world;
        std::size_t woken = 0, slept = 0;
        for (int step = 0; step < 300; ++step) {
            restore_from(other, other);
            world.step(frame), other.step(frame);
            ASSERT_EQ(saved(other), saved(world)) << step;
            ASSERT_EQ(other.events(), world.events()) << step;
            woken += world.events().wakes.size(), slept += world.events().sleeps.size();
        }
        EXPECT_GE(woken, 2u);
        EXPECT_LE(woken, 10u);
        EXPECT_GE(slept, 2u);
    };
    for (const bool forced : {false, true})
        for (const bool driven : {false, true})
            for (const Integrator& integrator : {Integrator{Verlet{}}, Integrator{Rk4{}}}) {
                SCOPED_TRACE(std::string(forced ? "forced " : "") + (driven ? "driven " : "") +
                             std::to_string(integrator.index()));
                run_with(integrator, forced, driven);
            }
}

// Nothing that does not move heats the air, or does work: to the last bit, once all sleep. Gravity and the floor go on
// giving momentum.
TEST(Sleep, WhereAllSleepEnergyStandsStill) {
    World world = sleepers_and_disc(Verlet{});
    world.add(Drag{.linear = 0.01});
    pass(world, 25);
    ASSERT_EQ(sleepers(world), 40);
    const Energy before = energy(world);
    const MomentumBalance had = momentum_balance(world);
    pass(world, 10);
    const Energy after = energy(world);
    EXPECT_EQ(after.heat.total(), before.heat.total());
    EXPECT_EQ(after.work.total(), before.work.total());
    EXPECT_EQ(after.residual, before.residual);
    const MomentumBalance has = momentum_balance(world);
    EXPECT_NEAR(has.gravity.linear.y - had.gravity.linear.y, -40 * g * 10, 1e-12 * 40 * g * 10);
    // They were put down at rest, so that what the floor bears is their weight; rounding.
    EXPECT_NEAR(has.walls.linear.y - had.walls.linear.y, 40 * g * 10, 1e-12 * 40 * g * 10);
    EXPECT_NEAR(has.unaccounted().linear.y, 0, 1e-10 * 40 * g * 35);
    EXPECT_NEAR(has.unaccounted().angular, 0, 1e-10 * 40 * g * 35 * 20);
}

// Who falls asleep beside a heap that sleeps, is touched, and is left again.
TEST(Sleep, ForgetsNoTouchOfThoseThatSleep) {
    World world = sleepers_and_disc(Verlet{});
    std::size_t begun = 0, ended = 0;
    const auto count = [&](double seconds) {
        run(world, seconds, frame,
            [&](const World& w) { begun += w.events().begins.size(), ended += w.events().ends.size(); });
    };
    count(25);
    EXPECT_EQ(begun - ended, 40u);  // each box the one below or the floor
    ASSERT_EQ(sleepers(world), 40);
    const BodyId disc = roll_in(world, 1);
    count(1);
    EXPECT_EQ(begun - ended, 41u);  // the floor and the disc
    ASSERT_EQ(sleepers(world), 40);
    world.remove(disc);
    world.remove(world.ids()[1]);  // the upper one of the first stack
    count(1);
    EXPECT_EQ(begun - ended, 39u);
    EXPECT_EQ(sleepers(world), 39);
}

// A crowd of discs creeps for long at micrometres a second, and nothing stops what lies on a table seen from above.
TEST(Sleep, ComesSoonerWithAGreaterSpeed) {
    constexpr double soon = 6, at_length = 20;  // s
    for (const bool from_above : {false, true}) {
        double asleep_after[2]{at_length, at_length};
        for (const bool is_said : {false, true}) {
            SoftStep solver;
            if (is_said) solver.sleep_speed = 0.01;
            World world({.gravity = {0, from_above ? 0 : -g}, .solver = solver});
            const Side side{.restitution = 0, .friction = 0.3};
            world.add(Rectangle{{0, 0}, {5, 20}, side, side, side, side});
            for (int i = 0; i < 60; ++i) {
                Body body =
                    disc({0.4 + 0.6 * (i % 8) + 0.01 * (i % 3), 0.4 + 0.65 * (i / 8)}, 0.2 + 0.01 * (i % 5), 0.3);
                body.velocity.x = from_above ? 0.003 * (i % 3) : 0;
                world.add(body);
            }
            Throughput through(world);
            run(world, is_said ? soon : at_length, frame, [&](const World& now) {
                through.add(now);
                if (sleepers(now) >= 59)  // one may roll on along the floor
                    asleep_after[is_said] = std::min(asleep_after[is_said], now.time());
            });
            expect_closed(world, through);
            if (from_above) {
                EXPECT_LE(std::abs(energy(world).residual), 60 * 0.5 * 0.01 * 0.01);
            }
        }
        EXPECT_LE(asleep_after[true], soon);
        if (from_above) {
            EXPECT_LT(asleep_after[true], 0.5 * asleep_after[false]);
        }
    }
}

}  // namespace
}  // namespace carom::test
