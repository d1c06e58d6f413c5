// Forces on fixed bodies alone were taken and changed nothing.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "error_of.hpp"

namespace carom::test {
namespace {

TEST(ForceOnAFixedBodyWasTaken, IsRefused) {
    World world;
    const BodyId fixed = world.add(Body{.kind = Kind::fixed}), driven = world.add(Body{.kind = Kind::driven}),
                 ball = world.add(Body{.radius = 1});
    const auto none = [](Vec2, Vec2, double, double) { return Vec2{}; };
    const std::string nothing = ".body must not be fixed: the force would change nothing";
    EXPECT_EQ(error_of([&] { world.add(ConstantForce{.body = fixed}); }), "ConstantForce" + nothing);
    EXPECT_EQ(error_of([&] { world.add(Drag{.body = fixed}); }), "Drag" + nothing);
    EXPECT_EQ(error_of([&] { world.add(ForceField{.body = fixed, .force = none}); }), "ForceField" + nothing);
    const auto force = world.add(ConstantForce{.body = ball, .force = {1, 0}});
    ConstantForce moved = world.force(force);
    moved.body = fixed;
    EXPECT_EQ(error_of([&] { world.set(force, moved); }), "ConstantForce" + nothing);
    EXPECT_EQ(world.force(force).body, ball);
    world.add(Drag{}), world.add(ForceField{.force = none}), world.add(ConstantForce{.body = driven});
    Body held = world.body(ball);
    held.kind = Kind::fixed;
    world.set(ball, held);  // for a while
    world.step(0.1);
    EXPECT_TRUE(world.contains(force));
}

}  // namespace
}  // namespace carom::test
