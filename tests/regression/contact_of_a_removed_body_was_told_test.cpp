// Between the removal of a body and the next step contacts() told of its contacts with other bodies, under its stale
// id.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace {

using namespace carom;

TEST(ContactOfARemovedBody, IsNotToldWhicheverOfBothIsGone) {
    for (const bool lower_goes : {true, false}) {
        World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
        world.add(HalfPlane{});
        const BodyId lower = world.add(Body{.position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}}}});
        const BodyId upper = world.add(Body{.position = {0, 1.5}, .shapes = {{.geometry = Box{1, 1}}}});
        for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
        ASSERT_EQ(world.contacts().size(), 4u);
        world.remove(lower_goes ? lower : upper);
        for (const ContactPoint& c : world.contacts()) {
            EXPECT_TRUE(c.shapes.at_wall() || world.contains(c.shapes.a.body));
            EXPECT_TRUE(world.contains(c.shapes.b.body));
        }
    }
}

}  // namespace
