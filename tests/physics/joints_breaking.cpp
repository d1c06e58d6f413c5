// What breaks where many joints bear too much in one step.
#include "joints.hpp"

namespace carom::test {
namespace {

/// Hinged planks between two banks, which sag by a quarter.
World bridge(int planks, double break_force) {
    World world = mechanism_world();
    const auto end = [planks](int i) {
        const double x = i - 0.5 * planks, bank = 0.5 * planks;
        return Vec2{x, (x * x - bank * bank) / (2 * planks)};
    };
    std::optional<BodyId> last;
    for (int i = 0; i <= planks; ++i) {
        std::optional<BodyId> next;
        if (i < planks) {
            const Vec2 along = end(i + 1) - end(i);
            next = world.add(Body{.position = 0.5 * (end(i) + end(i + 1)),
                                  .angle = std::atan2(along.y, along.x),
                                  .mass = 20,
                                  .shapes = {{.geometry = Box{length(along), 0.2}}},
                                  .restitution = 0,
                                  .friction = 0.6});
        }
        world.add(Joint{.a = next ? last : std::nullopt,
                        .b = next ? *next : *last,
                        .at = end(i),
                        .type = RevoluteJoint{},
                        .break_force = break_force});
        last = next;
    }
    return world;
}

std::size_t broken_by_step(World& world) {
    world.step(frame);
    return world.events().broken.size();
}

}  // namespace

/// A blow goes through all hinges at once, however much they bear: all 21 broke, and planks rained.
TEST(Breaking, OfABridgeIsAtOneHinge) {
    for (const double break_force : {2e4, 1e5, 3e5}) {
        World world = bridge(20, break_force);
        run(world, 1, frame);
        ASSERT_EQ(world.joints().size(), 21u);
        world.add(Body{.position = {0.3, 0}, .velocity = {0, -8}, .mass = 300, .radius = 0.7, .restitution = 0});
        std::size_t first = 0;
        for (int i = 0; i < 60 && first == 0; ++i) first = broken_by_step(world);
        EXPECT_EQ(first, 1u) << break_force;
        run(world, 0.5, frame);
        EXPECT_GE(world.joints().size(), 16u) << break_force;
    }
}

/// The uppermost hinge of a chain bears most.
TEST(Breaking, OfAChainIsWhereItBearsMost) {
    World world = mechanism_world();
    const auto links = add_chain(world, 10, 0.5, 5);
    const std::vector<JointId> hinges(world.joint_ids().begin(), world.joint_ids().end());
    for (const JointId id : hinges) {
        Joint joint = world.joint(id);
        joint.break_force = 20;
        world.set(id, joint);
    }
    for (std::size_t i = 0; i < links.size(); ++i) world.set_position(links[i], {0, -0.5 * (double(i) + 0.5)}, -pi / 2);
    world.set_position(links.back(), {0, -5}, 0);
    world.step(frame);
    EXPECT_EQ(world.events().broken, std::vector{hinges[0]});
    run(world, 0.5, frame);
    EXPECT_EQ(world.joints().size(), 10u);  // it falls as it is
}

TEST(Breaking, OfTwoRopesIsOneAfterTheOther) {
    World world = mechanism_world();
    const BodyId load = world.add(Body{.mass = 10, .radius = 0.3});
    for (const double x : {-1.0, 1.0})
        world.add(Joint{.b = load, .anchor_a = {x, 1}, .type = DistanceJoint{}, .break_force = 60});
    EXPECT_EQ(broken_by_step(world), 1u);
    EXPECT_EQ(broken_by_step(world), 1u);
}

/// In a wall no two welds part anything, but at its corners: where the blow is too much for all, all give way.
TEST(Breaking, OfAWallIsEverywhere) {
    World world = mechanism_world();
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
    const int n = 8;
    const auto weld = [&](BodyId a, BodyId b, Vec2 at) {
        world.add(Joint{.a = a, .b = b, .at = at, .type = WeldJoint{}, .break_force = 300});
    };
    std::vector<BodyId> bricks;
    for (int i = 0; i < n * n; ++i) {
        const Vec2 at{0.5 * (i % n), 0.25 + 0.5 * (i / n)};
        bricks.push_back(world.add(Body{.position = at, .shapes = {{.geometry = Box{0.5, 0.5}}}, .restitution = 0}));
        if (i % n > 0) weld(bricks[static_cast<std::size_t>(i - 1)], bricks.back(), at - Vec2{0.25, 0});
        if (i >= n) weld(bricks[static_cast<std::size_t>(i - n)], bricks.back(), at - Vec2{0, 0.25});
    }
    world.add(Body{.position = {-2, 2.5}, .velocity = {30, 0}, .mass = 10, .radius = 0.4, .restitution = 0});
    std::size_t most = 0;
    for (int i = 0; i < 30; ++i) most = std::max(most, broken_by_step(world));
    EXPECT_GE(most, 100u);  // of 112
}

/// Two limbs of a doll that nothing holds are not in series: what tears one off relieves the other by nothing.
TEST(Breaking, OfLimbsIsEachForItself) {
    World world = mechanism_world({}, {});
    const BodyId trunk = world.add(rod({0, 0}, 1, 10));
    for (const double x : {-0.5, 0.5}) {
        const BodyId limb = world.add(Body{.position = {3 * x, 0}, .mass = 1, .radius = 0.1});
        world.add(Joint{.a = trunk, .b = limb, .at = Vec2{x, 0}, .type = WeldJoint{}, .break_force = 1});
        world.set_velocity(limb, {0, 9}, 0);
    }
    EXPECT_EQ(broken_by_step(world), 2u);
}

}  // namespace carom::test
