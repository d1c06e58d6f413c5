// To ask a world between an edit and the next step moved bodies on curves by the last bit, for where they are was
// evaluated anew; what asking booked rounded the ledger otherwise; and who was asked about woke sleepers.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "restored.hpp"

namespace carom {
namespace {

void ask(const World& world) {
    energy(world), momentum_balance(world);
    world.check(), world.stable_step();
    for (const BodyId id : world.ids()) world.asleep(id), world.in_steps(id);
}

TEST(AskingBetweenEdits, LeavesWhoIsOnACurveWhereTheStepLeftHim) {
    for (const Solver& solver : {Solver(Impulse{}), Solver(SoftStep{})}) {
        World world({.solver = solver});
        const BodyId lift = world.add(Body{.kind = Kind::driven, .radius = 1});
        world.drive(lift, [](double t) { return Pose{{std::sin(3 * t), std::cos(2 * t)}, t * t}; });
        for (int i = 0; i < 50; ++i) {
            world.step(1.0 / 60);
            world.add(Body{.position = {100.0 + 3 * i, 0}, .radius = 1});
            const auto before = state_hash(world);
            ask(world);
            EXPECT_EQ(state_hash(world), before) << i;
        }
    }
}

/// A world that is edited a lot, asked in between or not.
World edited(bool asks) {
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    world.add(HalfPlane{});
    for (int i = 0; i < 3; ++i)
        world.add(Body{.position = {2.0 * i, 0.5}, .mass = 1.1, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0});
    const BodyId rock = world.add(Body{.kind = Kind::fixed, .position = {50, 50}, .radius = 1});
    run(world, 2, 1.0 / 60);
    EXPECT_TRUE(world.asleep(world.ids()[0]));
    const auto edit = [&](auto act) {
        act();
        if (asks) ask(world);
    };
    for (int i = 0; i < 10; ++i) {
        edit([&] {
            world.add(Body{.position = {0.3 * i, 7.1}, .velocity = {0.1 * i, 0}, .mass = 0.7, .radius = 0.1});
        });
        edit([&] { world.set_position(rock, {2, 0.7}, 0); });  // into a sleeper, and
        edit([&] { world.set_position(rock, {50, 50}, 0); });  // out again
        edit([&] { world.add(ConstantForce{.body = world.ids().back(), .force = {0.3, 0.1 * i}}); });
        edit([&] { world.apply_impulse(world.ids().back(), {0.1, 0.7}, {}); });
        run(world, 0.1, 1.0 / 60);
    }
    return world;
}

TEST(AskingBetweenEdits, LeavesAllThatIsSavedAsItWas) {
    EXPECT_TRUE(test::saved(edited(true)) == test::saved(edited(false)));
}

}  // namespace
}  // namespace carom
