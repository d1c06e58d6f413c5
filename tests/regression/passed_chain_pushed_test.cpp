// A chain is solid from one side, and pushed along who came from the other one as soon as his middle was across:
// without a blow, by up to 8 cm of a disc of 10 cm, and a jump that ended half way through a platform was lifted onto
// it. Later it was so again for who was pushed or given a velocity in each step, as a game does with its characters:
// that was taken for having been put there. So was World::set, whatever it changed. Who went sideways was lifted from
// as deep as he went in a step, 13 cm at 8 m/s; and a level of one body lifted whoever stood on its floor onto its
// ledges.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "restored.hpp"

namespace carom {
namespace {

constexpr double g = 10, dt = 1.0 / 60;

/// A platform of two segments, solid from above.
World platform(double gravity) {
    World world({.gravity = {0, -gravity}, .solver = SoftStep{}});
    world.add(
        Body{.kind = Kind::fixed, .shapes = {{.geometry = Chain{{{-5, 0}, {0.1, 0}, {5, 0}}}}}, .restitution = 0});
    return world;
}
const std::vector<Shape> shapes[] = {{{.geometry = Disc{{}, 0.1}}},
                                     {{.geometry = Box{0.4, 0.2}}},
                                     {{.geometry = Capsule{{-0.2, 0}, {0.2, 0}, 0.1}}},
                                     {{.geometry = Disc{{0.1, 0.1}, 0.1}}, {.geometry = Box{0.3, 0.3}}}};
Body body(const std::vector<Shape>& of, Vec2 position, Vec2 velocity, double spin = 0) {
    return {.position = position,
            .angle = 0.3,
            .velocity = velocity,
            .angular_velocity = spin,
            .shapes = of,
            .restitution = 0};
}

TEST(ChainPassedFromBehind, LeavesWayAndSpin) {
    for (const auto& of : shapes)
        for (const double speed : {0.01, 0.1, 1.0, 10.0, 100.0}) {
            World world = platform(0);
            const BodyId id = world.add(body(of, {0, -1}, {0.2 * speed, speed}, 0.5 * speed));
            const Vec2 start = world.position(id);
            constexpr double rounding = 1e-11;  // of 12 000 steps
            const double time = 2 / speed;
            run(world, time, std::min(dt, time / 10));
            EXPECT_NEAR(world.position(id).y, start.y + 2, rounding) << speed;
            EXPECT_NEAR(world.position(id).x, start.x + 0.4, rounding) << speed;
            EXPECT_NEAR(world.angle(id), 0.3 + 1, rounding) << speed;
            EXPECT_EQ(energy(world).work.overlap, 0) << speed;
        }
}

/// A body whose jump through a platform ends where its middle is so far above it falls back, whatever act(world, id)
/// does before each step.
template <class Act>
void expect_to_fall_back(const std::vector<Shape>& of, double above, const Act& act) {
    World world = platform(g);
    const double rise = 1 + above;
    const BodyId id = world.add(body(of, {0, -1}, {0, std::sqrt(2 * g * rise)}));
    const double start = world.position(id).y, time = 2 * std::sqrt(2 * rise / g);
    for (double rest = time; rest > 0; rest -= dt) {
        act(world, id);
        world.step(std::min(rest, dt));
    }
    EXPECT_NEAR(world.position(id).y, start, 1e-9) << above;
}

TEST(ChainPassedFromBehind, LetsAJumpThatEndsHalfWayFallBack) {
    for (const auto& of : shapes)
        for (const double above : {-0.05, 0.02}) {     // where its middle turns back
            if (of.size() > 1 && above > 0) continue;  // one of its shapes is all above then, and lands
            expect_to_fall_back(of, above, [](World&, BodyId) {});
        }
}

TEST(ChainPassedFromBehind, LetsWhoIsGivenHisOwnVelocityInEachStepFallBack) {
    for (const auto& of : shapes)
        expect_to_fall_back(of, -0.05, [](World& world, BodyId id) {
            world.set_velocity(id, world.velocity(id), world.angular_velocity(id));
        });
}

TEST(ChainPassedFromBehind, LetsWhoseFrictionIsSetInEachStepFallBack) {
    for (const auto& of : shapes)
        expect_to_fall_back(of, -0.05, [](World& world, BodyId id) {
            Body now = world.body(id);
            now.friction = 1 - now.friction;
            world.set(id, now);
        });
}

TEST(ChainPassedFromBehind, LetsWhoFliesSidewaysFallBackAlsoRestored) {
    for (const double speed : {-8.0, 0.0, 8.0})
        for (const double below : {0.02, 0.1, 0.3}) {  // where his feet turn back
            World world = platform(g), restored = platform(g);
            const double rise = 2 - below, time = std::sqrt(2 * rise / g);
            const BodyId id = world.add(Body{.position = {-speed * time, -1},
                                             .velocity = {speed, std::sqrt(2 * g * rise)},
                                             .fixed_rotation = true,
                                             .shapes = {{.geometry = Capsule{{0, -0.6}, {0, 0.6}, 0.4}}}});
            run(world, time, dt);
            test::restore_from(world, restored);
            for (World* one : {&world, &restored}) run(*one, time, dt);
            EXPECT_NEAR(world.position(id).y, -1, 1e-9) << speed << ' ' << below;  // rounding
            EXPECT_EQ(state_hash(restored), state_hash(world));
        }
}

TEST(ChainPassedAtItsEnd, DoesNotLiftWhoStandsOnTheFloorOfTheSameBody) {
    for (const Shape& floor :
         {Shape{.geometry = Box{60, 1, {0, -0.5}}}, Shape{.geometry = Chain{{{-30, 0}, {30, 0}}}}}) {
        World world({.gravity = {0, -g}, .solver = SoftStep{}});
        world.add(
            Body{.kind = Kind::fixed, .shapes = {floor, {.geometry = Chain{{{0, 0.6}, {30, 0.6}}}}}, .restitution = 0});
        const BodyId id = world.add(Body{
            .position = {-1, 0.9}, .fixed_rotation = true, .shapes = {{.geometry = Box{0.8, 1.8}}}, .restitution = 0});
        for (int n = 0; n < 60; ++n) {
            world.set_velocity(id, {3, world.velocity(id).y}, 0);
            world.step(dt);
            EXPECT_NEAR(world.position(id).y, 0.9, 1e-3);  // it lies on the floor, and sinks in by its weight
        }
    }
}

TEST(ChainPassedAtItsEnd, DoesNotLiftWhoIsDrivenSideways) {
    for (const Shape& walker : {Shape{.geometry = Box{1, 2}, .friction = 0},
                                Shape{.geometry = Capsule{{0, -0.5}, {0, 0.5}, 0.5}, .friction = 0}})
        for (const double height : {0.55, 0.7, 0.99})  // of the end, over the feet: beside the straight sides of both
            for (const double speed : {1.0, 3.0, 8.0}) {
                World world = platform(g);
                const BodyId id = world.add(Body{.position = {-7, 1 - height},
                                                 .mass = 10,
                                                 .fixed_rotation = true,
                                                 .shapes = {walker},
                                                 .restitution = 0});
                world.add(HalfPlane{.point = {0, -height}, .side = {.restitution = 0, .friction = 0}});
                for (int n = 0; n < 3 / (speed * dt); ++n) {
                    world.set_velocity(id, {speed, world.velocity(id).y}, 0);
                    world.step(dt);
                    EXPECT_NEAR(world.position(id).y, 1 - height, 1e-3) << speed;  // a hundredth of what it was
                }
            }
}

TEST(ChainPassedFromBehind, BearsWhoFallsBackFromAbove) {
    for (const auto& of : shapes) {
        World world = platform(g);
        const BodyId id = world.add(body(of, {0, -1}, {0, std::sqrt(2 * g * 2)}));
        run(world, 5, dt);
        EXPECT_GT(world.position(id).y, 0.09);
        EXPECT_TRUE(world.asleep(id));
    }
}

TEST(ChainPassedFromBehind, BearsWhoWasPutIntoIt) {
    for (const auto& of : shapes) {
        World world = platform(g);
        const BodyId id = world.add(body(of, {0, 0.05}, {}));
        run(world, 5, dt);
        EXPECT_GT(world.position(id).y, 0.09);
    }
}

}  // namespace
}  // namespace carom
