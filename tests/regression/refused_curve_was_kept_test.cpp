// A curve that threw before or after now, and not at it, was refused by World::drive and kept all the same: energy()
// and step() threw from then on. One that was no number there was taken, and could not be ended after its first step.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <stdexcept>

#include "error_of.hpp"

namespace carom::test {
namespace {

TEST(RefusedCurve, IsNotKeptIfItThrowsBeforeOrAfterNow) {
    World world;
    const BodyId lift = world.add(Body{.kind = Kind::driven, .velocity = {1, 0}, .radius = 1});
    const auto throws_elsewhere = [](double t) {
        if (t != 0) throw std::runtime_error("elsewhere");
        return Pose{{7, 0}, 0};
    };
    EXPECT_THROW(world.drive(lift, throws_elsewhere), std::runtime_error);
    EXPECT_FALSE(world.follows_curve(lift));
    EXPECT_EQ(world.position(lift), Vec2{});
    EXPECT_NO_THROW(energy(world));
    world.step(0.5);
    EXPECT_EQ(world.position(lift), (Vec2{0.5, 0}));
}

TEST(RefusedCurve, IsOneThatIsNoNumberBeforeOrAfterNow) {
    World world;
    const BodyId lift = world.add(Body{.kind = Kind::driven, .radius = 1});
    const std::string error = error_of([&] { world.drive(lift, [](double t) { return Pose{{std::sqrt(t), 0}, 0}; }); });
    EXPECT_TRUE(error.starts_with("World::drive: the curve must be finite before and after t = 0 s too")) << error;
    EXPECT_FALSE(world.follows_curve(lift));
    world.step(0.5);
    EXPECT_EQ(world.position(lift), Vec2{});
}

// What goes wrong later ends the run, and can be ended itself.
TEST(RefusedCurve, CanBeEndedWhereItLeadsNowhereAnyMore) {
    World world;
    const BodyId lift = world.add(Body{.kind = Kind::driven, .radius = 1});
    world.drive(lift, [](double t) { return Pose{{t < 0.9 ? t : NAN, 0}, 0}; });
    world.step(0.5);
    EXPECT_THROW(world.step(0.5), Error);
    EXPECT_EQ(error_of([&] { world.drive(lift, {}); }), "no error");
    EXPECT_FALSE(world.follows_curve(lift));
    world.set_position(lift, {}, 0), world.set_velocity(lift, {1, 0}, 0);
    world.step(0.5);
    EXPECT_EQ(world.position(lift), (Vec2{0.5, 0}));
}

// One that removes its body was accepted, and then written where that had been.
TEST(RefusedCurve, IsOneThatChangesTheWorld) {
    World world;
    const BodyId lift = world.add(Body{.kind = Kind::driven, .radius = 1});
    const auto removes = [&](double) {
        world.remove(lift);
        return Pose{};
    };
    EXPECT_NE(error_of([&] { world.drive(lift, removes); }), "no error");
    EXPECT_EQ(world.size(), 1u);
    EXPECT_FALSE(world.follows_curve(lift));
}

}  // namespace
}  // namespace carom::test
