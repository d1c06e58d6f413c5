// The ledger under SoftStep: bodies of every shape, restitution and friction that fall on one another, wherever they
// are.

#include "physics/contacts.hpp"
#include "throughput.hpp"
#include "trials.hpp"

namespace carom::test {
namespace {

Geometry some_shape(Random& random) {
    const double a = random.uniform(0.15, 0.4), b = random.uniform(0.15, 0.4);
    switch (static_cast<int>(random.uniform(0, 5))) {
        case 0:
            return Disc{.radius = a};
        case 1:
            return Capsule{{-a, 0}, {a, 0}, 0.5 * b};
        case 2:
            return Box{.width = 2 * a, .height = 2 * b};
        case 3:
            return Box{.width = 2 * a, .height = 2 * b, .rounding = 0.1};
        default:
            return Polygon{.points = {{-a, -b}, {a, -b}, {0, a + b}}};
    }
}

/// Up to two dozen bodies in a bin, some of them overlapping, a few of them fixed or driven.
World random_pile(std::uint64_t seed) {
    Random random(seed);
    World world({.gravity = {random.uniform(-2, 2), -g},
                 .solver = SoftStep{.precise = random.uniform() < 0.2 ? Precise::all : Precise::some}});
    world.add(Rectangle{.low = {-2, 0}, .high = {2, 30}, .bottom = {0.5, 0.5}});
    const int n = 2 + static_cast<int>(random.uniform(0, 22));
    for (int i = 0; i < n; ++i) {
        const double kind = random.uniform(), x = random.uniform(-1.5, 1.5);
        Body body{.kind = kind < 0.9    ? Kind::dynamic
                          : kind < 0.95 ? Kind::fixed
                                        : Kind::driven,
                  .position = {x, 0.6 + 0.4 * i},
                  .angle = random.uniform(-3, 3),
                  .mass = std::exp(random.uniform(-2, 2)),
                  .shapes = {{.geometry = some_shape(random)}},
                  .restitution = random.uniform() < 0.3 ? 0 : random.uniform(),
                  .friction = random.uniform() < 0.3 ? 0 : random.uniform()};
        if (body.kind != Kind::fixed)
            body.velocity.x = random.uniform(-3, 3), body.angular_velocity = random.uniform(-3, 3);
        world.add(body);
    }
    return world;
}

void expect_closed_for_a_second(World world) {
    Throughput through(world);
    for (int step = 0; step < 60; ++step) {
        world.step(frame);
        through.add(world);
        expect_closed(world, through);
    }
}

TEST(PileLedger, ClosesAfterEveryStepOfTwoHundredRandomPiles) {
    for (std::uint64_t seed = 0; seed < trials(200) && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        expect_closed_for_a_second(random_pile(seed));
    }
}

/// Two hundred bodies of about one mass that bounce little: most are in one island, whose impacts are the sweeps'.
World random_crowd(std::uint64_t seed) {
    Random random(seed);
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    world.add(Rectangle{.low = {-4, 0}, .high = {4, 60}, .bottom = {0.5, 0.5}});
    for (int i = 0; i < 200; ++i) {
        const double x = -3.5 + i % 10 * 0.75;
        Body body{.position = {x, 0.8 + 0.8 * (i / 10)},
                  .angle = random.uniform(-3, 3),
                  .shapes = {{.geometry = some_shape(random)}},
                  .restitution = random.uniform(0, 0.5),
                  .friction = random.uniform()};
        body.velocity = {random.uniform(-3, 3), -10};
        world.add(body);
    }
    return world;
}

TEST(PileLedger, ClosesAfterEveryStepOfCrowdsThatBounceLittle) {
    for (std::uint64_t seed = 0; seed < 3 && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        expect_closed_for_a_second(random_crowd(seed));
    }
}

// Contacts that push apart what overlaps do work, and it was booked as heat of impacts that came back.
TEST(HeatOfImpacts, NeverFallsWhereBodiesArePushedApart) {
    World world = floor_world(0.5);
    for (int i = 0; i < 60; ++i) world.add(box({0.7 * (i % 6), 0.5 + 0.8 * (i / 6)}, 1, 1, 0.5));
    double heat = 0;
    for (int step = 0; step < 300; ++step) {
        world.step(frame);
        // In one of the steps 1e-3 of 715 J come back: somebody lands while what is under him is parted.
        EXPECT_GE(energy(world).heat.impact, (1 - 1e-5) * heat);
        heat = energy(world).heat.impact;
    }
    EXPECT_GT(energy(world).work.overlap, 1);  // 60 bodies of 1 kg that are lifted by decimetres
}

}  // namespace
}  // namespace carom::test
