// What is put down at rest: it stands exactly where its contacts can hold it, and else moves as it should.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include "../arch.hpp"
#include "statics.hpp"

namespace carom::test {
namespace {

/// The largest force [N] or torque [N m] that is left on a body by its weight and its contacts, after checking that
/// these are within Coulomb's cones.
struct Imbalance {
    double force = 0, torque = 0;
};
Imbalance imbalance(const World& world) {
    struct Sum {
        Vec2 force{};
        double torque = 0;
    };
    std::map<std::uint32_t, Sum> on;
    for (const BodyId id : world.ids()) on[id.index].force = world.body(id).mass * world.settings().gravity;
    const auto add = [&](const ShapeId& shape, Vec2 at, Vec2 force) {
        if (shape.body.generation == 0) return;  // a wall
        on[shape.body.index].force += force;
        on[shape.body.index].torque += cross(at - world.position(shape.body), force);
    };
    for (const ContactPoint& c : world.contacts()) {
        EXPECT_GT(c.normal_force, 0);
        EXPECT_LE(std::abs(c.tangent_force), 0.6 * c.normal_force);
        const Vec2 force = c.normal_force * c.normal + c.tangent_force * perpendicular(c.normal);
        add(c.shapes.b, c.point, force), add(c.shapes.a, c.point, -force);
    }
    Imbalance most;
    for (const auto& [index, sum] : on) {
        most.force = std::max(most.force, length(sum.force));
        most.torque = std::max(most.torque, std::abs(sum.torque));
    }
    return most;
}

// Where boxes touch at their sides too, forces are many times undetermined.
TEST(Statics, APyramidStandsByForcesInBalanceAndWithinTheirCones) {
    for (const double pitch : {1.0, 1.1})
        for (const int rows : {1, 10, 40}) {
            World world = statics_world(0.6);
            add_pyramid(world, rows, pitch);
            const std::vector<Vec2> before = copy_of(world.positions());
            pass(world, 2);
            EXPECT_EQ(copy_of(world.positions()), before);
            EXPECT_EQ(fastest(world), 0);
            // Rounding of what is borne below, in sums over a few contacts.
            const auto [force, torque] = imbalance(world);
            EXPECT_LE(force, 1e-12 * rows * rows * g) << rows << " rows, pitch " << pitch;
            EXPECT_LE(torque, 1e-12 * rows * rows * g) << rows << " rows, pitch " << pitch;
            EXPECT_EQ(energy(world).residual, 0);
            const auto walls = momentum_balance(world).walls;
            const double weight = static_cast<double>(world.size()) * g;
            EXPECT_NEAR(walls.linear.y, 2 * weight, 1e-11 * weight);
        }
}

// The whole point of the option: what would settle under soft contacts does not.
TEST(Statics, WithoutThemAPyramidSettles) {
    World world = statics_world(0.6, {.statics = false});
    add_pyramid(world, 20, 1.1);
    pass(world, 1);
    EXPECT_GT(fastest(world), 1e-4);
}

// A block on a slope stands below the angle of friction, and above it slides as the textbook has it.
TEST(Statics, ABlockStandsBelowTheAngleOfFriction) {
    const double mu = 0.5;
    for (const double part : {0.9, 0.999, 1.001, 1.1}) {
        const double slope = std::atan(part * mu);
        World world = statics_world(mu, {}, {g * std::sin(slope), -g * std::cos(slope)});
        const BodyId block = world.add(box({0, 0.5}, 2, 1, mu));
        pass(world, 1);
        const double acceleration = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope)));
        // Sweeps on a body alone are right to rounding; standing is exact.
        EXPECT_NEAR(world.position(block).x, acceleration / 2, part < 1 ? 0 : 1e-9) << part;
    }
}

// Books of length 1 that stick out by parts of 1/2, 1/4, 1/6, ... of one another stand up to their whole lengths.
TEST(Statics, BooksStandOutAsFarAsTheirSeriesSays) {
    for (const double part : {0.999, 1.001}) {
        World world = statics_world(0.6);
        world.add(Body{.kind = Kind::fixed,
                       .position = {-2, 0.5},
                       .shapes = {{.geometry = Box{4, 1}, .restitution = 0, .friction = 0.6}}});
        const int books = 6;
        double x = 0;  // of the right end of what a book lies on
        for (int i = 0; i < books; ++i) {
            x += part / (2.0 * (books - i));
            world.add(box({x - 0.5, 1.05 + 0.1 * i}, 1, 0.1, 0.6));
        }
        pass(world, 1);
        EXPECT_EQ(fastest(world) == 0, part < 1) << part;
    }
}

// Only where somebody bears it: walls that a block touches exactly give it no force to rub by.
TEST(Statics, ABlockInAShaftFalls) {
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    for (const double side : {1.0, -1.0})
        world.add(
            HalfPlane{.point = {-0.5 * side, 0}, .normal = {side, 0}, .side = {.restitution = 0, .friction = 0.9}});
    const BodyId block = world.add(box({0, 0}, 1, 1, 0.9));
    pass(world, 0.5);
    EXPECT_NEAR(world.position(block).y, -g / 8, 1e-9);
}

// Half a circle of equal stones stands if it is no thinner than 0.1075 of its radius (M. Milankovitch, Z. Math. Phys.
// 55, 1 (1907); J. Ochsendorf, The Structural Engineer 84, 49 (2006)), for it can hinge nowhere but where stones meet
// also a little below that.
bool arch_stands(double thickness, int stones) {
    World world = statics_world(0.9);
    add_half_circle(world, thickness, stones);
    pass(world, 1.0 / 60);
    return fastest(world) == 0;
}
TEST(Statics, AnArchStandsDownToTheThicknessOfMilankovitch) {
    for (const int stones : {24, 60, 120}) {
        EXPECT_TRUE(arch_stands(0.1076, stones)) << stones;
        EXPECT_TRUE(arch_stands(0.3, stones)) << stones;
        EXPECT_FALSE(arch_stands(0.107, stones)) << stones;
    }
}

// Put down inside one another bodies are parted, as ever.
TEST(Statics, WhoOverlapsIsParted) {
    World world = statics_world(0.6);
    for (int i = 0; i < 3; ++i) world.add(box({0, 0.45 + 0.9 * i}, 1, 1, 0.6));
    pass(world, 3);
    EXPECT_NEAR(world.positions()[2].y, 2.5, 1e-3);
}

TEST(Statics, WhatIsHitIsStirredAndTheLedgerCloses) {
    World world = statics_world(0.6);
    add_pyramid(world, 8, 1.1);
    pass(world, 0.2);
    EXPECT_EQ(fastest(world), 0);
    Body ball = disc({-4, 3}, 0.5, 0.5);
    ball.mass = 20, ball.velocity = {15, 0};
    world.add(ball);
    pass(world, 1);
    // The right end of the lowest row, by 1 cm to 1.7 m from one step to the next: the blow is chaotic.
    EXPECT_GT(std::abs(world.positions()[7].x - 7 * 1.1), 0.005);
    EXPECT_LE(std::abs(energy(world).unaccounted()), 1e-11 * energy(world).initial_total);
}

// What stands is left out of the work whether bodies sleep or not: only then they are told to be asleep, and at once.
TEST(Statics, WhoStandsIsAsleepOnlyWhereBodiesSleep) {
    for (const bool sleep : {true, false}) {
        World world = statics_world(0.6, {.sleep = sleep});
        add_pyramid(world, 3, 1.1);
        world.step(frame);
        EXPECT_EQ(world.events().sleeps.size(), sleep ? 6u : 0u);
        for (const BodyId id : world.ids()) EXPECT_EQ(world.asleep(id), sleep);
        EXPECT_EQ(world.events().begins.size(), 9u);  // three on the floor, and twice each of three others
        if (!sleep) continue;
        world.wake(world.ids()[0]);
        world.step(frame);
        for (const BodyId id : world.ids()) EXPECT_FALSE(world.asleep(id));
    }
}

// Each one that was told to be asleep is told to wake, also where `sleep` is turned off and on.
TEST(Statics, SleepsAndWakesPairWhereSleepIsTurnedOff) {
    World world = statics_world(0.6);
    add_pyramid(world, 3, 1.1);
    const auto told = [&] {
        world.step(frame);
        return std::pair{world.events().sleeps.size(), world.events().wakes.size()};
    };
    using Told = std::pair<std::size_t, std::size_t>;
    EXPECT_EQ(told(), (Told{6, 0}));
    Settings settings = world.settings();
    settings.solver = SoftStep{.sleep = false};
    world.configure(settings);
    EXPECT_EQ(told(), (Told{0, 6}));
    settings.solver = SoftStep{};
    world.configure(settings);
    EXPECT_EQ(told(), (Told{6, 0}));
}

// The residual is judged body by body: what bears much blinds nobody who bears little.
TEST(Statics, AGreatForceElsewhereDoesNotHoldWhoSlides) {
    World world = statics_world(0, {.sleep = false}, {1e-7, -g});
    const BodyId block = world.add(box({0, 0.5}, 2, 1, 0));
    const BodyId speck = world.add(box({-1.05, 0.05}, 0.1, 0.1, 0, 1e-3));  // at its side, without friction
    world.add(ConstantForce{.body = speck, .force = {0, -100}});
    pass(world, 10);
    EXPECT_NEAR(world.position(block).x, 5e-6, 1e-9);
}

// Edits that move nothing, and removing what others do not lean on, leave what stands standing.
TEST(Statics, EditsThatMoveNothingLeaveItStanding) {
    World world = statics_world(0.6);
    add_pyramid(world, 8, 1.1);
    pass(world, 0.1);
    const std::vector<Vec2> before = copy_of(world.positions());
    const BodyId top = world.ids().back(), foot = world.ids()[0];
    const std::vector<std::function<void()>> edits = {[&] { world.set(top, world.body(top)); },
                                                      [&] { world.set_position(foot, world.position(foot), 0); },
                                                      [&] { world.set_velocity(foot, {}, 0); },
                                                      [&] { world.configure(world.settings()); },
                                                      [&] {
                                                          world.add(ConstantForce{.body = top, .force = {0.01, 0}});
                                                      },
                                                      [&] { world.remove(top); }};
    for (std::size_t k = 0; k < edits.size(); ++k) {
        edits[k]();
        pass(world, 0.1);
        EXPECT_EQ(fastest(world), 0) << "edit " << k;
        for (std::size_t i = 0; i < world.size(); ++i) EXPECT_EQ(world.positions()[i], before[i]) << "edit " << k;
    }
}

// Of walls whose bricks lie at random nearly all that can stand do, and their forces prove it.
TEST(Statics, BrickWallsStandByForcesInBalance) {
    NumpyRandom random(7);
    int standing = 0;
    for (int trial = 0; trial < 100; ++trial) {
        World world = statics_world(0.6);
        for (int row = 0; row < 6; ++row) {
            double x = random.uniform(-0.5, 0.5);
            for (int i = 0; i < 4; ++i) {
                const double width = random.uniform(0.6, 1.6);
                world.add(box({x + width / 2, 0.25 + 0.5 * row}, width, 0.5, 0.6, width));
                x += width + random.uniform(0, 0.3);
            }
        }
        world.step(frame);
        if (fastest(world) > 0) continue;
        ++standing;
        // Rounding, of up to 24 bricks of up to 1.6 kg on the lowest.
        EXPECT_LE(imbalance(world).force, 1e-11 * g) << trial;
        EXPECT_LE(imbalance(world).torque, 1e-11 * g) << trial;
    }
    EXPECT_GT(standing, 10);  // the others have a brick that hangs over too far
}

// Crates and discs that touch at their sides as well stand by what is below them, and nothing is wedged in between. To
// look for forces there, too, had let discs in such columns fall.
TEST(Statics, WhatIsStackedInColumnsSideBySideStandsByItsWeightAlone) {
    for (const bool are_discs : {false, true})
        for (const double friction : {0.1, 0.6}) {
            World world = statics_world(friction);
            for (const double side : {1, -1})
                world.add(HalfPlane{.point = {-5.5 * side, 0}, .normal = {side, 0}, .side = {.friction = friction}});
            for (int k = 0; k < 10; ++k)
                for (int i = 0; i < 11; ++i) {
                    const Vec2 at{i - 5.0, 0.5 + k};
                    world.add(are_discs ? disc(at, 0.5, friction) : box(at, 1, 1, friction));
                }
            world.step(frame);
            EXPECT_EQ(fastest(world), 0) << are_discs << friction;
            EXPECT_LE(imbalance(world).force, 1e-12 * 10 * g);
            EXPECT_LE(imbalance(world).torque, 1e-12 * 10 * g);
            for (const ContactPoint& c : world.contacts()) EXPECT_EQ(c.normal.x, 0);
        }
}

// Who is put on what stands, stands with it.
TEST(Statics, ATowerCanBeBuiltStoneByStone) {
    World world = statics_world(0.6);
    for (int i = 0; i < 20; ++i) {
        world.add(box({0.05 * (i % 2), 0.5 + i}, 1, 1, 0.6));
        world.step(frame);
        EXPECT_EQ(fastest(world), 0) << i;
    }
    EXPECT_LE(imbalance(world).force, 1e-12 * 20 * g);
    EXPECT_LE(imbalance(world).torque, 1e-12 * 20 * g);
}

TEST(Statics, AreTheSameForAllThreads) {
    const auto run = [](int threads) {
        World world({.gravity = {0, -g}, .solver = SoftStep{}, .threads = threads});
        world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
        for (int k = 0; k < 8; ++k)
            for (int i = 0; i < 6; ++i) world.add(box({3.0 * k + 0.1 * (i % 2), 0.5 + i}, 1, 1, 0.6));
        Body ball = disc({-3, 3}, 0.5, 0.5);
        ball.velocity = {10, 0};
        world.add(ball);
        pass(world, 0.6);
        std::vector<double> forces;
        for (const ContactPoint& c : world.contacts()) forces.push_back(c.normal_force);
        return std::pair{state_hash(world), forces};
    };
    EXPECT_EQ(run(1), run(4));
}

// What comes to rest by itself does so under contacts that give way, and the slowest of its motions for long. When
// nearly nothing moves any more it is held by the forces that it has but for what they miss.
TEST(Statics, APileThatSettlesIsHeldBeforeItsLastMotionsDie) {
    const auto seconds_to_sleep = [](bool statics) {
        World world = statics_world(0.6, {.statics = statics});
        world.add(Drag{.linear = 0.1});  // which bears nothing of those that are held
        for (int i = 0; i < 20; ++i)
            for (int j = i; j < 20; ++j) world.add(box({0.5 * i + (j - i), 0.501 + i}, 1, 1, 0.6));
        int steps = 0;
        while (!world.asleep(world.ids()[0]) && steps < 600) world.step(frame), ++steps;
        if (statics) {
            EXPECT_EQ(fastest(world), 0);
            // No torques: points are told on the outline of b, and act in the middle of an overlap.
            EXPECT_LE(imbalance(world).force, 1e-11 * 20 * 20 * g);
        }
        EXPECT_LE(std::abs(energy(world).unaccounted()), 1e-11 * energy(world).initial_total);
        return steps * frame;
    };
    EXPECT_LT(seconds_to_sleep(true), 0.7 * seconds_to_sleep(false));
}

// However slow, what is free to move goes on: a disc that rolls, and a plank on two rollers, which all their contacts
// would hold if they stood.
TEST(Statics, WhatRollsSlowlyIsNotStopped) {
    const double v = 1e-4, r = 0.5;
    World world = statics_world(0.6);
    const auto roller = [&](double x, double speed) {
        Body body = disc({x, r}, r, 0.6);
        body.velocity = {speed, 0}, body.angular_velocity = -speed / r;
        return world.add(body);
    };
    const BodyId wheel = roller(-5, v);
    roller(0, v / 2), roller(2, v / 2);
    Body plank = box({1, 2 * r + 0.1}, 4, 0.2, 0.6);
    plank.velocity = {v, 0};
    const BodyId board = world.add(plank);
    pass(world, 5);
    // It sleeps below 0.2 um/s; what rounding and the precise solve leave is a thousandth of that.
    EXPECT_NEAR(world.position(wheel).x, -5 + 5 * v, 1e-9);
    EXPECT_NEAR(world.position(board).x, 1 + 5 * v, 1e-9);
}

// Where nobody sleeps nothing may be taken but rounding: 1e-8 of what gravity gives in a step is 1e-18 J of a kilogram.
TEST(Statics, WhatHasComeToRestStandsWhereNobodySleeps) {
    World world = statics_world(0.6, {.sleep = false});
    for (int i = 0; i < 6; ++i)
        for (int j = i; j < 6; ++j) world.add(box({0.5 * i + (j - i), 0.501 + i}, 1, 1, 0.6));
    pass(world, 8);
    EXPECT_EQ(fastest(world), 0);
    for (const BodyId id : world.ids()) EXPECT_FALSE(world.asleep(id));
    EXPECT_LE(imbalance(world).force, 1e-12 * 6 * 6 * g);
    const BodyId top = world.ids().back();
    const double before = energy(world).total();
    EXPECT_LE(std::abs(energy(world).unaccounted()), 1e-13 * energy(world).initial_total);
    world.apply_impulse(top, {0.01, 0}, world.position(top));  // and is stirred as others are
    world.step(frame);
    EXPECT_GT(fastest(world), 0);
    pass(world, 8);
    EXPECT_EQ(fastest(world), 0);
    constexpr double given = 5e-5;  // [J], by the impulse: gone, but for what rounding of places is of the weight
    EXPECT_LT(energy(world).total(), before + 1e-4 * given);
}
TEST(Statics, WhatRollsAsSlowlyAsRoundingIsNotStoppedWhereNobodySleeps) {
    constexpr double v = 1e-10, r = 0.5;
    World world = statics_world(0.6, {.sleep = false});
    Body body = disc({0, r}, r, 0.6);
    body.velocity = {v, 0}, body.angular_velocity = -v / r;
    const BodyId wheel = world.add(body);
    pass(world, 5);
    EXPECT_NEAR(world.velocity(wheel).x, v, 1e-3 * v);
    EXPECT_NEAR(world.position(wheel).x, 5 * v, 1e-3 * v);
}

// What looking for forces cost is paid back in a run that was restored as in the one that went on.
TEST(Statics, AreAskedInARestoredRunWhenTheyAreInTheOther) {
    World world = statics_world(0.6);
    add_pyramid(world, 40, 1.1);
    pass(world, 0.05);
    World other = world;
    for (int step = 0; step < 160; ++step) {
        restore_from(other, other);
        if (step == 150)  // when it has been paid back in both, or in one
            for (World* w : {&world, &other}) w->add(box({19.5 * 1.1, 40.5}, 1, 1, 0.6));
        world.step(frame), other.step(frame);
        ASSERT_EQ(state_hash(other), state_hash(world)) << step;
    }
}

// A hundredth of a metre or a kilometre, grams or kilotonnes.
TEST(Statics, KnowNoUnits) {
    for (const double l : {0.01, 1.0, 1000.0})
        for (const double m : {1e-3, 1e6}) {
            World world = statics_world(0.6, {}, {0, -g * l});
            for (int i = 0; i < 12; ++i)
                for (int j = i; j < 12; ++j) world.add(box({l * (0.5 * i + (j - i)), l * (0.5 + i)}, l, l, 0.6, m));
            world.step(frame);
            EXPECT_EQ(fastest(world), 0) << l << " m, " << m << " kg";
        }
}

/// Points that had borne something on the way and bear nothing where all stands kept that, and a floor bore more than
/// the weight for ever.
TEST(Statics, WhatFallsAsleepReportsForcesInBalance) {
    for (const int rows : {7, 8}) {
        World world = statics_world(0.6);
        const double gap = 1e-3;
        for (int i = 0; i < rows; ++i)
            for (int k = 0; k < rows - i; ++k)
                world.add(box({1.05 * k + 0.525 * i, 0.5 + i + gap * (i + 1)}, 1, 1, 0.6));
        const double dt = rows == 7 ? 1.0 / 60 : 0.05;
        for (int i = 0; i < 10 / dt && !world.asleep(world.ids()[0]); ++i) world.step(dt);
        ASSERT_TRUE(world.asleep(world.ids()[0]));
        // A precise solve takes 1e-10 of what forces give in a substep for rest.
        EXPECT_LE(imbalance(world).force, 1e-10 * rows * rows * g) << rows << " rows";
        // A point is in the middle of an overlap, which may be as large as the gap was, and bears up to ten weights.
        EXPECT_LE(imbalance(world).torque, 10 * gap * g) << rows << " rows";
    }
}

}  // namespace
}  // namespace carom::test
