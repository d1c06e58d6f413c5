// The place and the velocity that a body on a curve was given were those of the curve again in the next step, without a
// word. And a curve could not be ended.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "error_of.hpp"

namespace carom::test {
namespace {

TEST(CurveOverruledWhatWasSet, WhereAndHowFastIsSaidByTheCurveAlone) {
    World world({.solver = SoftStep{}});
    const BodyId lift = world.add(Body{.kind = Kind::driven, .radius = 1, .name = "lift"});
    world.drive(lift, [](double t) { return Pose{{std::sin(t), 1000 * t}, 3 * t}; });
    run(world, 1.01, 0.01);
    const std::string why =
        ": body 'lift' must not follow a curve, which says where it is and how fast; World::drive with no curve ends "
        "it";
    EXPECT_EQ(error_of([&] { world.set_position(lift, {50, 0}, 0); }), "World::set_position" + why);
    EXPECT_EQ(error_of([&] { world.set_velocity(lift, {9, 9}, 0); }), "World::set_velocity" + why);
    Body body = world.body(lift);
    body.friction = 1;
    world.set(lift, body);
    body.position.x += 1;
    EXPECT_EQ(error_of([&] { world.set(lift, body); }), "World::set" + why);
    body = world.body(lift), body.velocity.y += 1;
    EXPECT_EQ(error_of([&] { world.set(lift, body); }), "World::set" + why);
    body.kind = Kind::dynamic;  // with it the curve ends
    EXPECT_EQ(error_of([&] { world.set(lift, body); }), "no error");
}

TEST(CurveOverruledWhatWasSet, NoCurveEndsACurveAndTheBodyGoesOnAsItMoves) {
    World world({.solver = SoftStep{}});
    const BodyId lift = world.add(Body{.kind = Kind::driven, .radius = 1});
    world.drive(lift, {});
    world.drive(lift, [](double t) { return Pose{{t * t, 0}, 3 * t}; });
    run(world, 1, 0.01);
    world.drive(lift, {});
    EXPECT_FALSE(world.follows_curve(lift));
    run(world, 1, 0.01);
    EXPECT_NEAR(world.position(lift).x, 1 + 2, 1e-7);
    EXPECT_NEAR(world.angle(lift), 6, 1e-7);
    world.set_velocity(lift, {}, 0);
    const BodyId free = world.add(Body{.name = "free"});
    EXPECT_EQ(error_of([&] { world.drive(free, {}); }), "World::drive: the body 'free' must be of kind driven");
}

}  // namespace
}  // namespace carom::test
