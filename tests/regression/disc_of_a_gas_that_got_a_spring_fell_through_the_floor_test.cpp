// A disc of an exact gas that got a spring or a joint in the run, and so was moved in steps from then on, fell through
// the floor and through boxes; after others had lost theirs bodies were nowhere (NaN), or the program ended. The search
// for pairs went on with candidates that were numbered as the pieces of bodies in steps had been before.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

#include "restored.hpp"

namespace carom {
namespace {

/// A box between two discs in a room; all lie on the floor, or come to.
struct RoomWithABox {
    World world{{.gravity = {0, -9.81}, .solver = Events{}}};
    BodyId low, high, box;

    RoomWithABox() {
        const Side side{.restitution = 0.5};
        world.add(Rectangle{{0, 0}, {10, 6}, side, side, side, side});
        low = world.add(Body{.position = {2, 0.5}, .radius = 0.15, .restitution = 0.5});
        box = world.add(Body{.position = {5, 1}, .shapes = {{.geometry = Box{0.4, 0.3}}}, .restitution = 0.5});
        high = world.add(Body{.position = {8, 2}, .radius = 0.15, .restitution = 0.5});
    }
    void step(int times) {
        for (int i = 0; i < times; ++i) world.step(1.0 / 60);
    }
    /// Contacts give way to weights by some g h², 2e-4 m, in substeps of h = 1/240 s, and to a landing by little more.
    void expect_inside() const {
        for (const BodyId id : world.ids()) EXPECT_GT(world.position(id).y, 0.9 * 0.15) << world.time();
    }
    void expect_to_go_on_as(World other) {
        test::restore_from(world, other);
        for (int i = 0; i < 20; ++i) {
            world.step(1.0 / 60), other.step(1.0 / 60);
            ASSERT_EQ(state_hash(world), state_hash(other)) << i;
        }
    }
};

TEST(DiscOfAGasThatGotASpring, LiesOnTheFloor) {
    RoomWithABox room;
    room.step(6);
    room.world.add(Spring{.a = room.low, .b = room.box, .stiffness = 0.01});
    room.step(60);
    room.expect_inside();
}

TEST(DiscOfAGasThatGotAJoint, LiesOnTheFloor) {
    RoomWithABox room;
    room.step(6);
    const Vec2 pivot = room.world.position(room.low) + Vec2{0.4, 0.2};
    room.world.add(Joint{.b = room.low, .at = pivot, .type = RevoluteJoint{}});
    const World before = room.world;
    room.step(3);
    room.expect_to_go_on_as(before);
    room.step(60);
    room.expect_inside();
}

// As many are moved in steps as before, and others.
TEST(DiscOfAGasThatLostAJoint, FliesAndAnotherHangs) {
    RoomWithABox room;
    const JointId first = room.world.add(
        Joint{.b = room.low, .at = room.world.position(room.low) + Vec2{0.1, 0.4}, .type = RevoluteJoint{}});
    room.step(20);
    room.world.remove(first);
    room.world.add(Joint{.b = room.high, .at = room.world.position(room.high) + Vec2{0.4, 0}, .type = RevoluteJoint{}});
    EXPECT_FALSE(room.world.in_steps(room.low));
    EXPECT_TRUE(room.world.in_steps(room.high));
    const World before = room.world;
    room.step(3);
    room.expect_to_go_on_as(before);
    room.step(60);
    room.expect_inside();
    EXPECT_NEAR(energy(room.world).unaccounted(), 0, 1e-12);
}

}  // namespace
}  // namespace carom
