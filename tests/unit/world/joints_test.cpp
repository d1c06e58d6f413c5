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
    world.remove(a);
    EXPECT_EQ(world.joints(b), Ids{last});
    EXPECT_EQ(error_of([&] { world.joints(a); }), "BodyId is stale: body 0 (generation 1) was removed from this world");
}
