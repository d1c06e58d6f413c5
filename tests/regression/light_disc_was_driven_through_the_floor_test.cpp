// Under the default solver a disc that fell on one of a thousandth of its mass drove that through the floor, and they
// changed places: what a light one that lies on a wall passes on of a blow is little, and after 512 blows in a step the
// heavy one went on through it.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "throughput.hpp"

namespace carom {
namespace {

struct Fall {
    double restitution, mass;
    bool other_force;  ///< then the whole world flies from impact to impact
};

class LightDisc : public testing::TestWithParam<Fall> {};

TEST_P(LightDisc, LiesOnTheFloorUnderAHeavyOne) {
    constexpr double r = 0.1, dt = 1.0 / 60;
    const auto [restitution, mass, other_force] = GetParam();
    World world({.gravity = {0, -9.81}});
    world.add(HalfPlane{.side = {.restitution = restitution}});
    const BodyId light = world.add(Body{.position = {0, r}, .mass = mass, .radius = r, .restitution = restitution});
    const BodyId heavy = world.add(Body{.position = {0, 2}, .mass = 100, .radius = r, .restitution = restitution});
    if (other_force) world.add(Drag{.linear = 1e-6});
    test::Throughput through(world);
    // Under other forces those at rest sink by ½ g dt² in a step and are lifted again (docs/theory/contacts.md), to a
    // billionth of a radius.
    const double least = r * (1 - 1e-8);
    for (int i = 0; i < 240; ++i) {
        world.step(dt);
        through.add(world);
        EXPECT_GT(world.position(light).y, least) << world.time();
        EXPECT_GT(world.position(heavy).y - world.position(light).y, 2 * least) << world.time();
        test::expect_closed(world, through);
    }
    EXPECT_NEAR(world.position(heavy).y, 3 * r, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(All, LightDisc,
                         testing::Values(Fall{0, 1, false}, Fall{0, 0.1, false}, Fall{0, 0.001, false},
                                         Fall{0.5, 0.1, false}, Fall{0.9, 0.1, false}, Fall{0, 0.1, true},
                                         Fall{0.5, 0.001, true}));

// Without gravity one that comes on at a light one before a wall stops dead: there is nothing that would throw it back.
TEST(LightDisc, StopsAHeavyOneBeforeAWall) {
    for (const double mass : {1e3, 1e6}) {
        World world;
        world.add(HalfPlane{.side = {.restitution = 0.5}});
        world.add(Body{.position = {0, 0.7}, .radius = 0.5, .restitution = 0.5});
        const BodyId heavy =
            world.add(Body{.position = {0, 3}, .velocity = {0, -1}, .mass = mass, .radius = 0.5, .restitution = 0.5});
        run(world, 4, 0.01);
        EXPECT_NEAR(world.position(heavy).y, 1.5, 1e-9);
        EXPECT_NEAR(world.velocity(heavy).y, 0, 1e-12);
        EXPECT_NEAR(energy(world).heat.impact, 0.5 * mass, 1e-9 * mass);
    }
}

// What stands or is driven takes its part of a blow of which a wall takes another: of a disc on a floor that runs
// under another one, which is fixed or comes on.
TEST(LightDisc, IsStoppedByWhatDoesNotYield) {
    for (const double speed : {0.0, -1.0}) {
        World world;
        world.add(HalfPlane{.side = {.restitution = 0}});
        Body other{.kind = speed == 0 ? Kind::fixed : Kind::driven, .position = {2, 0.5}, .radius = 0.5};
        other.velocity = {speed, 0}, other.restitution = 0, other.friction = 0;
        world.add(other);
        const Vec2 start{speed == 0 ? 1.0 : 0.0, 0};
        const BodyId id = world.add(Body{.position = {0, 0.1}, .velocity = start, .radius = 0.1, .restitution = 0});
        test::Throughput through(world);
        for (int i = 0; i < 180; ++i) {
            world.step(0.01);
            through.add(world);
            test::expect_closed(world, through);
        }
        EXPECT_NEAR(world.velocity(id).x, speed, 1e-12);  // it stands, or is pushed along
        EXPECT_NEAR(world.position(id).y, 0.1, 1e-9);
        EXPECT_NEAR(energy(world).work.driven, speed * speed, 1e-12);
        EXPECT_NEAR(energy(world).heat.impact, 0.5, 1e-12);
    }
}

}  // namespace
}  // namespace carom
