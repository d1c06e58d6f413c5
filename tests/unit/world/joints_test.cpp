// What a world takes and tells of joints; how they move is in tests/physics.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "error_of.hpp"

using namespace carom;
using test::error_of;

TEST(Joints, OfABodyAreThoseThatHoldIt) {
    World world({.solver = SoftStep{}});
    const BodyId a = world.add(Body{.radius = 1}), b = world.add(Body{.position = {3, 0}, .radius = 1}),
                 free = world.add(Body{.position = {9, 0}, .radius = 1});
    const JointId pin = world.add(Joint{.b = a, .at = Vec2{0, 0}, .type = RevoluteJoint{}}),
                  rod = world.add(Joint{.a = a, .b = b, .type = DistanceJoint{}}),
                  last = world.add(Joint{.b = b, .at = Vec2{3, 0}, .type = RevoluteJoint{}});
    using Ids = std::vector<JointId>;
    EXPECT_EQ(world.joints(a), (Ids{pin, rod}));
    EXPECT_EQ(world.joints(b), (Ids{rod, last}));
    EXPECT_EQ(world.joints(free), Ids{});
    world.set(last, Joint{.b = free, .at = Vec2{9, 0}, .type = RevoluteJoint{}});
    EXPECT_EQ(world.joints(b), Ids{rod});
    EXPECT_EQ(world.joints(free), Ids{last});
    const World copy = world;
    world.remove(a);
    EXPECT_EQ(world.joints(b), Ids{});
    EXPECT_EQ(world.joints(free), Ids{last});
    world.remove(last);
    EXPECT_EQ(world.joints(free), Ids{});
    EXPECT_EQ(copy.joints(a), (Ids{pin, rod}));
    EXPECT_EQ(error_of([&] { world.joints(a); }), "BodyId is stale: body 0 (generation 1) was removed from this world");
}

// 'at' was preferred without a word.
TEST(Joints, HaveEitherAPointOfTheWorldOrAnchors) {
    World world({.solver = SoftStep{}});
    const BodyId b = world.add(Body{.position = {1, 0}, .radius = 1});
    const Joint both{.name = "pin", .b = b, .at = Vec2{0, 0}, .anchor_b = {-2, 0}, .type = RevoluteJoint{}};
    const std::string said =
        "Joint 'pin'.at is the point of the world that both anchors are in: give either it, or anchor_a and anchor_b";
    EXPECT_EQ(error_of([&] { world.add(both); }), said);
    EXPECT_TRUE(world.joints().empty());
    Joint one = both;
    one.anchor_b = {};
    const JointId id = world.add(one);
    EXPECT_EQ(error_of([&] { world.set(id, both); }), said);
    EXPECT_EQ(world.joint(id).anchor_b, (Vec2{-1, 0}));
}

/// What a world tells of a joint is complete: given back, it is what it was.
TEST(Joints, AreTakenAsTheyAreTold) {
    World world({.solver = SoftStep{}});
    const BodyId b = world.add(Body{.position = {1, 0}, .radius = 1});
    const JointId id = world.add(Joint{.b = b, .at = Vec2{0, 0}, .type = RevoluteJoint{}});
    const Joint told = world.joint(id);
    EXPECT_FALSE(told.at);
    world.set_position(b, {5, 5}, 1);
    world.set(id, told);
    EXPECT_EQ(world.joint(id).anchor_b, told.anchor_b);
    EXPECT_EQ(world.joint(world.add(told)).anchor_b, (Vec2{-1, 0}));
}

TEST(Joints, AreMovedToAPointOfTheWorldAsTheyAreTold) {
    World world({.solver = SoftStep{}});
    const BodyId b = world.add(Body{.position = {1, 0}, .radius = 1});
    const JointId id = world.add(Joint{.b = b, .at = Vec2{0, 0}, .type = RevoluteJoint{}});
    Joint moved = world.joint(id);
    moved.at = Vec2{1, 3};
    world.set(id, moved);
    EXPECT_EQ(world.joint(id).anchor_a, (Vec2{1, 3}));
    EXPECT_EQ(world.joint(id).anchor_b, (Vec2{0, 3}));
    moved.anchor_a = {5, 5};
    EXPECT_NE(error_of([&] { world.set(id, moved); }), "none");
}
