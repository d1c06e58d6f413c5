// Mechanisms that are alike are solved in lanes: each as if it were alone, whatever the instruction set.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "simd/isa.hpp"

namespace carom {
namespace {

class MechanismLanes : public testing::Test {
  protected:
    ~MechanismLanes() override { use_isa({}); }
};

/// What hangs on the hinges of a figure.
enum class Hinges { free, limited, sprung };

/// A trunk with limbs of two bones, thrown: their hinges pass from one step of their staircase to the next, and the
/// fastest turn by more than a quarter of a radian in a substep; by 0.75 the substeps of all would be cut.
std::vector<BodyId> add_figure(World& world, int number, Hinges hinges) {
    const Vec2 at{10.0 * number, 0};
    std::vector<BodyId> bones;
    const auto bone = [&](Vec2 from_trunk) {
        const Shape ball{.geometry = Disc{{}, 0.1}, .filter = {.group = -1}};
        bones.push_back(world.add(Body{.position = at + from_trunk,
                                       .velocity = {1.0 * number, -0.3 * number},
                                       .angular_velocity = number == 5 ? 80 : 3.0 * (number - 4),
                                       .mass = 1 + 0.1 * number,
                                       .moment_of_inertia = 0.02,
                                       .shapes = {ball},
                                       .restitution = 0}));
        return bones.back();
    };
    const auto hinge = [&](BodyId a, BodyId b, Vec2 pivot, int k) {
        RevoluteJoint type;
        if (hinges != Hinges::free) type.limits = {-0.3 - 0.1 * k, 0.5}, type.motor = JointMotor{.maximum = 0.2 * k};
        if (hinges == Hinges::sprung) type.spring = JointSpring{.stiffness = 4.0 + k, .damping = 0.01};
        world.add(Joint{.a = a, .b = b, .at = at + pivot, .type = type});
    };
    const BodyId trunk = bone({});
    for (int k = 0; k < 3; ++k) {
        const Vec2 arm{0.3 * std::cos(2.0 * k), 0.3 * std::sin(2.0 * k)};
        const BodyId upper = bone(2 * arm), lower = bone(4 * arm);
        hinge(trunk, upper, arm, k), hinge(upper, lower, 3 * arm, k + 1);
    }
    return bones;
}

World world_of(std::vector<int> numbers, Hinges hinges, std::vector<std::vector<BodyId>>& bones) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{.sleep = false}, .threads = 1});
    for (const int number : numbers) bones.push_back(add_figure(world, number, hinges));
    return world;
}

TEST_F(MechanismLanes, EachMovesAsIfItWereAlone) {
    const std::vector<int> all{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    for (const Hinges hinges : {Hinges::free, Hinges::limited, Hinges::sprung})
        for (const Isa which : available_isas()) {
            use_isa(which);
            std::vector<std::vector<BodyId>> crowd;
            World together = world_of(all, hinges, crowd);
            for (int i = 0; i < 90; ++i) together.step(1.0 / 60);
            for (const int number : all) {
                std::vector<std::vector<BodyId>> own;
                World alone = world_of({number}, hinges, own);
                for (int i = 0; i < 90; ++i) alone.step(1.0 / 60);
                for (std::size_t k = 0; k < own[0].size(); ++k) {
                    const BodyId a = own[0][k], b = crowd[static_cast<std::size_t>(number)][k];
                    EXPECT_EQ(alone.position(a), together.position(b)) << "figure " << number << ", bone " << k;
                    EXPECT_EQ(alone.angle(a), together.angle(b));
                    EXPECT_EQ(alone.velocity(a), together.velocity(b));
                    EXPECT_EQ(alone.angular_velocity(a), together.angular_velocity(b));
                }
            }
        }
}

/// Three that fall on a floor: two lanes hold two of them and leave one alone, and more hold all. Contacts act between
/// the solves for which they lie side by side.
TEST_F(MechanismLanes, ThoseThatTouchAFloorMoveAlikeInAnyNumberOfLanes) {
    for (const Hinges hinges : {Hinges::free, Hinges::limited, Hinges::sprung}) {
        std::vector<Vec2> expected;
        for (const Isa which : available_isas()) {
            use_isa(which);
            std::vector<std::vector<BodyId>> bones;
            World world = world_of({1, 2, 3}, hinges, bones);
            world.add(HalfPlane{.point = {0, -1.5}, .side = {.restitution = 0, .friction = 0.5}});
            for (int i = 0; i < 240; ++i) world.step(1.0 / 60);
            EXPECT_GT(world.contacts().size(), 0U);
            const std::vector<Vec2> places(world.positions().begin(), world.positions().end());
            if (expected.empty()) expected = places;
            EXPECT_EQ(places, expected);
        }
    }
}

/// A chain that is as long as the way between its ends, which are held: its drifts have to be projected.
std::vector<BodyId> add_taut_chain(World& world, int number) {
    constexpr int planks = 40;
    std::vector<BodyId> chain;
    for (int i = 0; i < planks; ++i) {
        const Shape ball{.geometry = Disc{{}, 0.1}, .filter = {.group = -1}};
        chain.push_back(world.add(Body{.position = {i + 0.5, 0},
                                       .mass = 5 + 0.1 * number,
                                       .moment_of_inertia = 0.4,
                                       .shapes = {ball},
                                       .restitution = 0}));
        Joint hinge{.b = chain.back(), .at = Vec2{1.0 * i, 0}, .type = RevoluteJoint{}};
        if (i > 0) hinge.a = chain[chain.size() - 2];
        world.add(hinge);
    }
    world.add(Joint{.b = chain.back(), .at = Vec2{1.0 * planks, 0}, .type = RevoluteJoint{}});
    return chain;
}

TEST_F(MechanismLanes, TautChainIsProjectedAsIfItWereAlone) {
    const auto run = [](World& world) {
        for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
        Settings settings = world.settings();
        settings.gravity = {};
        world.configure(settings);  // nothing pulls at the chain: it need not be projected any more
        for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
    };
    for (const Isa which : available_isas()) {
        use_isa(which);
        World together({.gravity = {0, -9.81}, .solver = SoftStep{.sleep = false}, .threads = 1});
        std::vector<std::vector<BodyId>> chains;
        for (int number = 0; number < 5; ++number) chains.push_back(add_taut_chain(together, number));
        run(together);
        for (int number = 0; number < 5; ++number) {
            World alone({.gravity = {0, -9.81}, .solver = SoftStep{.sleep = false}, .threads = 1});
            const std::vector<BodyId> own = add_taut_chain(alone, number);
            run(alone);
            for (std::size_t k = 0; k < own.size(); ++k) {
                const BodyId in_crowd = chains[static_cast<std::size_t>(number)][k];
                ASSERT_EQ(alone.position(own[k]), together.position(in_crowd)) << number << ' ' << k;
                ASSERT_EQ(alone.velocity(own[k]), together.velocity(in_crowd)) << number << ' ' << k;
            }
        }
    }
}

/// Two rods of 1 m that hang on one another and on the origin, the lower one thrown. They have no shapes.
BodyId hang_rods(World& world, double speed) {
    const auto rod = [&](double below, double v) {
        return world.add(Body{.position = {0, -below}, .velocity = {v, 0}, .mass = 1, .moment_of_inertia = 0.1});
    };
    const BodyId upper = rod(0.5, 0), lower = rod(1.5, speed);
    world.add(Joint{.b = upper, .at = Vec2{}, .type = RevoluteJoint{}});
    world.add(Joint{.a = upper, .b = lower, .at = Vec2{0, -1}, .type = RevoluteJoint{}});
    return lower;
}

// What stands is not ordered until it moves. The first of those that are alike is here, for the second moves, and the
// third is not; and all are made anew with the world.
TEST_F(MechanismLanes, WhoHasStoodMovesAsIfItWereAloneOnceItIsStirred) {
    const auto run = [](std::vector<double> speeds) {
        World world({.gravity = {0, -9.81}, .solver = SoftStep{.sleep = false}, .threads = 1});
        std::vector<BodyId> lower;
        for (const double v : speeds) lower.push_back(hang_rods(world, v));
        for (int i = 0; i < 60; ++i) {
            world.step(1.0 / 60);
            if (i == 20) world.add(Body{.position = {0, 100}});
            for (const BodyId one : lower)
                if (i == 30 && world.velocity(one) == Vec2{}) world.set_velocity(one, {2, 0}, 0);
        }
        return world;
    };
    const World alone = run({0}), together = run({0, 1, 0});
    EXPECT_GT(length(alone.positions()[1] - Vec2{0, -1.5}), 0.1);
    for (const std::size_t first : {0U, 4U})
        for (const std::size_t rod : {0U, 1U}) {
            EXPECT_EQ(together.positions()[first + rod], alone.positions()[rod]) << first << ' ' << rod;
            EXPECT_EQ(together.angles()[first + rod], alone.angles()[rod]) << first << ' ' << rod;
        }
}

}  // namespace
}  // namespace carom
