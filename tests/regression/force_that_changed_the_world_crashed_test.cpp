// A force or a curve that removed or added bodies while a step asked it wrote past the end of rows.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace {

using namespace carom;

using Act = void (*)(World&);

World crowd() {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{});
    for (int i = 0; i < 20; ++i) world.add(Body{.position = {0.6 * i, 0.25}, .radius = 0.25});
    return world;
}

/// Runs a world in which something of the user's acts from 0.3 s on.
template <class Put>
void expect_refused(Put put) {
    constexpr Act acts[] = {[](World& world) { world.remove(world.ids()[0]); },
                            [](World& world) {
                                world.add(Body{.position = {0, 5}});
                            },
                            [](World& world) { world.step(0.1); },
                            [](World& world) { world.wake(world.ids()[0]); },
                            [](World& world) {
                                world.apply_impulse(world.ids()[0], {1, 0}, {});
                            },
                            [](World& world) {
                                const World other = crowd();
                                world = other;
                            },
                            [](World& world) { world = crowd(); }};
    for (const Act act : acts) {
        World world = crowd();
        put(world, [&world, act] {
            if (world.time() > 0.3) act(world);
        });
        EXPECT_THROW(run(world, 1, 1.0 / 60), Error);
        EXPECT_EQ(world.size(), world.positions().size());
        world.add(Body{.position = {0, 50}});  // between steps
    }
}

TEST(ForceThatChangesTheWorld, IsAnErrorAndNoCrash) {
    expect_refused([](World& world, auto act) {
        world.add(UserForce{.add = [act](const Snapshot&, std::span<Vec2>, std::span<double>) { act(); }});
    });
    expect_refused([](World& world, auto act) {
        world.add(ForceField{.force = [act](Vec2, Vec2, double, double) {
            act();
            return Vec2{};
        }});
    });
}

TEST(CurveThatChangesTheWorld, IsAnErrorAndNoCrash) {
    expect_refused([](World& world, auto act) {
        const BodyId driven = world.add(Body{.kind = Kind::driven, .position = {0, 9}, .radius = 0.1});
        world.drive(driven, [act](double) {
            act();
            return Pose{{0, 9}, 0};
        });
    });
}

TEST(ForceThatCopiesTheWorld, HasACopyThatMayBeChanged) {
    World world = crowd();
    std::optional<World> copy;
    world.add(ForceField{.force = [&](Vec2, Vec2, double, double) {
        if (!copy) copy.emplace(world);
        return Vec2{};
    }});
    world.step(1.0 / 60);
    EXPECT_NO_THROW(copy->add(Body{.position = {0, 5}}));
}

}  // namespace
