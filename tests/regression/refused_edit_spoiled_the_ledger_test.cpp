// A force that tried to edit the world got an Error, as it must, and caught it; but the edit had been noted: what the
// step did from there on was booked as given, and the ledger was 38 J off for ever.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

using Edit = void (*)(World&, BodyId);

constexpr Edit edits[] = {[](World& world, BodyId) { world.add(Body{.radius = 0.1}); },
                          [](World& world, BodyId body) { world.remove(body); },
                          [](World& world, BodyId body) { world.set_position(body, {}, 0); },
                          [](World& world, BodyId) { world.configure({}); }};

/// A world that falls and is pushed; from 0.5 s on it is asked to change in every step, and says no.
World run_with(const Solver& solver, Edit edit) {
    World world({.gravity = {0, -10}, .solver = solver});
    const BodyId body = world.add(Body{.position = {0, 5}, .velocity = {3, 0}, .mass = 1, .radius = 0.3});
    const auto push = [&world, body, edit](const Snapshot& now, std::span<Vec2> force, std::span<double>) {
        force[0].x += 1;
        if (!edit || now.time < 0.5) return;
        EXPECT_THROW(edit(world, body), Error);
    };
    const auto pushes = world.add(UserForce{.name = "push", .add = push});
    run(world, 1, 1.0 / 60);
    world.remove(pushes);  // which refers to a world that is moved now
    return world;
}

TEST(RefusedEdit, LeavesTheLedgerAsItWas) {
    for (const Solver& solver : {Solver(Impulse{}), Solver(SoftStep{})}) {
        const World untouched = run_with(solver, nullptr);
        for (const Edit edit : edits) {
            const World world = run_with(solver, edit);
            EXPECT_EQ(state_hash(world), state_hash(untouched));
            EXPECT_EQ(energy(world).initial_total, energy(untouched).initial_total);
            EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-11) << "J, rounding: 60 steps of some 50 J, each to 1e-16";
        }
    }
}

}  // namespace
}  // namespace carom
