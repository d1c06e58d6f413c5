// Who sleeps is woken by what is changed about him, or about what bears or holds him.

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

/// A disc that has come to rest on a rod below a fixed body.
struct Hanging {
    World world{{.gravity = {0, -g}, .solver = SoftStep{}}};
    BodyId hook = world.add(Body{.kind = Kind::fixed});
    BodyId bob = world.add(disc({0, -1}, 0.2));
    Hanging() {
        world.add(Joint{.a = hook, .b = bob, .type = DistanceJoint{}});
        pass(world, 3);
        EXPECT_TRUE(world.asleep(bob));
    }
};

TEST(Wake, WhoHungOnARemovedBodyFalls) {
    Hanging h;
    h.world.remove(h.hook);
    pass(h.world, 0.5);
    EXPECT_NEAR(h.world.position(h.bob).y, -1 - 0.5 * g * 0.25, 1e-9);  // ½ g t², by Verlet exactly
}

TEST(Wake, WhoHangsOnAMovedBodyFollows) {
    Hanging h;
    h.world.set_position(h.hook, {0.1, 0}, 0);
    pass(h.world, 0.1);
    EXPECT_FALSE(h.world.asleep(h.bob));
    EXPECT_NEAR(length(h.world.position(h.bob) - Vec2{0.1, 0}), 1, 1e-6);  // what a solve for a joint leaves
}

TEST(Wake, WhoRestsOnAFloorThatIsLiftedIsLifted) {
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    Body floor = box({0, -0.5}, 100, 1, 1);
    floor.kind = Kind::fixed;
    const BodyId ground = world.add(floor), crate = world.add(box({0, 0.5}, 1, 1, 1));
    pass(world, 3);
    ASSERT_TRUE(world.asleep(crate));
    world.set_position(ground, {0, -0.4}, 0);
    pass(world, 3);
    EXPECT_NEAR(world.position(crate).y, 0.6, 1e-3);  // at rest: a thousandth of its size
}

// A game says in each frame what its characters are to do, most often nothing: all that they lean on woke each time.
TEST(Wake, NobodyIsWokenByAVelocityThatHeHasOrAnImpulseOfNothing) {
    World world = floor_world(0.6);
    add_stack(world, 3);
    const BodyId top = world.ids()[2];
    pass(world, 10);
    ASSERT_TRUE(world.asleep(top));
    const double vx = world.velocity(top).x, w = world.angular_velocity(top);
    for (int n = 0; n < 3; ++n) {
        world.set_velocity(top, {vx, world.velocity(top).y}, w);
        world.apply_impulse(top, {}, world.position(top));
        world.apply_angular_impulse(top, 0);
        world.step(frame);
        EXPECT_TRUE(world.asleep(top));
        EXPECT_TRUE(world.events().wakes.empty());
    }
    world.set_velocity(top, {1e-3, 0}, 0);
    world.step(frame);
    EXPECT_FALSE(world.asleep(top));
}

TEST(Wake, WakesABodyAndThoseThatItRestsWith) {
    World world = floor_world(0.6);
    add_stack(world, 3);
    const BodyId far = world.add(box({50, 0.5}, 1, 1, 0.5));
    pass(world, 10);
    ASSERT_TRUE(world.asleep(far));
    const auto ids = std::vector(world.ids().begin(), world.ids().end());
    world.wake(ids[0]);
    world.step(frame);
    EXPECT_EQ(world.events().wakes.size(), 3u);
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(world.asleep(ids[i]));
    EXPECT_TRUE(world.asleep(far));
    pass(world, 5);
    EXPECT_TRUE(world.asleep(ids[0]));
}

}  // namespace
}  // namespace carom::test
