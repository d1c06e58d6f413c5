// What stood by forces that were found, and is touched: it begins in balance and goes on as an elastic pile.

#include <gtest/gtest.h>

#include <algorithm>

#include "../arch.hpp"
#include "statics.hpp"

namespace carom::test {
namespace {

// Soft contacts give way before they bear; those of who stood bear what was found without. A pyramid of 30 rows sank
// by 5.4 mm when it was woken.
TEST(Stirred, WhoIsWokenKeepsItsPlace) {
    World world = statics_world(0.6);
    add_pyramid(world, 30, 1.0);
    pass(world, 0.1);
    const std::vector<Vec2> before = copy_of(world.positions());
    world.wake(world.ids().front());
    world.step(frame);
    EXPECT_FALSE(world.asleep(world.ids().front()));
    pass(world, 2);
    // Forces balance to 1e-12 of up to 30 weights, and springs of 1e5 N/m give way by that at most.
    EXPECT_LE(moved(world, before), 1e-12);
    EXPECT_EQ(fastest(world), 0);  // and it stands again
}

// A box of a tenth of the others' mass falls on the top: what is left of that is a fiftieth of what the pyramid sank
// by before.
TEST(Stirred, WhoIsTouchedDoesNotSink) {
    World world = statics_world(0.6);
    add_pyramid(world, 30, 1.0);
    const std::vector<Vec2> before = copy_of(world.positions());
    world.add(box({14.5, 31.15}, 0.3, 0.3, 0.6, 0.1));
    pass(world, 5);
    EXPECT_NEAR(world.positions().back().y, 30.15, 1e-3);
    EXPECT_LE(moved(world, before), 2e-4);
    EXPECT_EQ(fastest(world), 0);
    EXPECT_LE(std::abs(energy(world).unaccounted()), 1e-11 * energy(world).initial_total);
}

// An arch a hair thicker than Milankovitch's has no force to spare. It stands when it is woken, too.
TEST(Stirred, AnArchThatIsWokenStands) {
    World world = statics_world(0.9);
    add_half_circle(world, 0.1076, 120);
    pass(world, 0.1);
    const std::vector<Vec2> before = copy_of(world.positions());
    world.wake(world.ids()[60]);
    pass(world, 3);
    EXPECT_LE(moved(world, before), 1e-12);  // as above
}

/// A pyramid of eight rows of bricks, so many that sweeps solve it, with a slab in the place of the others.
BodyId add_loaded_wall(World& world, double load) {
    for (int row = 0; row < 8; ++row)
        for (int k = 0; k < 20 - row; ++k) world.add(box({k + 0.5 * row, 0.5 + row}, 1, 1, 0.6));
    return world.add(box({9.5, 8.5}, 14, 1, 0.6, load));
}

// What a load pressed springs together by is not held up by them when the load is gone.
TEST(Stirred, WhoIsRelievedDoesNotFloat) {
    World world = statics_world(0.6);
    const BodyId slab = add_loaded_wall(world, 160);
    pass(world, 0.1);
    EXPECT_EQ(fastest(world), 0);
    std::vector<Vec2> before = copy_of(world.positions());
    before.pop_back();
    world.set_velocity(slab, {0, 30}, 0);
    double highest = 0, lowest = 0;
    const auto look = [&](const World& now) {
        highest = lowest = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const double rise = now.positions()[i].y - before[i].y;
            highest = std::max(highest, rise), lowest = std::min(lowest, rise);
        }
        EXPECT_LE(highest, 2e-3);  // at first they leap, as springs of 1e5 N/m do from which 90 N are taken
    };
    run(world, 5, frame, look);
    EXPECT_GT(world.position(slab).y, 20);
    EXPECT_LE(highest, 1e-5);
    EXPECT_GE(lowest, -1e-3);  // the wave that runs down to the floor leaves a little
}

// A pile that settled under a load and stands without it is pressed in no further by the next one: what its springs
// bear less than before is no licence to overlap.
TEST(Stirred, LoadsThatComeAndGoLeaveNothing) {
    World world = statics_world(0.6);
    world.remove(add_loaded_wall(world, 160));
    const BodyId top = world.ids()[130];
    pass(world, 0.1);
    for (int i = 0; i < 6; ++i) {
        const BodyId slab = world.add(box({9.5, world.position(top).y + 1.01}, 14, 1, 0.6, 160));
        pass(world, 5);
        world.remove(slab);
        pass(world, 0.1);
        world.wake(world.ids().front());
        pass(world, 3);
    }
    // Settled without statics it is at 7.4991.
    EXPECT_GT(world.position(top).y, 7.4985);
}

// Eight fixed bodies in a row fill a chunk that a step leaves out while others sleep.
TEST(Stirred, AFloorOfBodiesIsLikeAnyOther) {
    const auto time_to_stand = [](int fixed) {
        World world({.gravity = {0, -g}, .solver = SoftStep{}});
        for (int i = 0; i < fixed; ++i) {
            Body stone = box({-9 + 128.0 / fixed * (i + 0.5), -0.5}, 128.0 / fixed, 1, 0.6);
            stone.kind = Kind::fixed;
            world.add(stone);
        }
        BodyId slab = add_loaded_wall(world, 500);
        const std::size_t first = static_cast<std::size_t>(fixed), top = world.size() - 2;
        const BodyId brick = world.ids()[first];
        world.add(box({60, 0.5}, 1, 1, 0.6));  // sleeps throughout
        pass(world, 0.1);
        int steps = 0;
        for (int i = 0; i < 8; ++i) {
            world.remove(slab);
            world.set_velocity(brick, {0.001, 0}, 0);
            do world.step(frame), ++steps;
            while (!world.asleep(brick) && steps < 10000);
            slab = world.add(box({9.5, world.positions()[top].y + 1}, 14, 1, 0.6, 500));
            pass(world, 3);
        }
        return steps * frame / 8;
    };
    // With one fixed body it is 0.85 s; with a chunk of them twice as long where they counted as put down.
    for (const int fixed : {1, 7, 8, 16}) EXPECT_LE(time_to_stand(fixed), 1.2) << fixed;
}

// Springs that bear without an overlap are of who was not moved since.
TEST(Stirred, WhoIsLiftedByAHairFalls) {
    World world = statics_world(0.6);
    add_pyramid(world, 20, 1.0);
    pass(world, 0.1);
    const BodyId top = world.ids()[world.size() - 1];
    const Vec2 place = world.position(top);
    world.set_position(top, place + Vec2{0, 1e-4}, 0);
    pass(world, 3);
    EXPECT_LE(std::abs(world.position(top).y - place.y), 1e-5);
}

// The preload is part of what a checkpoint holds.
TEST(Stirred, ARestoredRunIsStirredAsTheOther) {
    World world = statics_world(0.6);
    add_pyramid(world, 20, 1.0);
    pass(world, 0.1);
    world.wake(world.ids().front());
    pass(world, 0.1);
    World other = statics_world(0.6);
    add_pyramid(other, 20, 1.0);
    restore_from(world, other);
    for (World* w : {&world, &other}) {
        w->apply_impulse(w->ids().back(), {0.1, 0}, w->position(w->ids().back()));
        pass(*w, 0.5);
    }
    EXPECT_GT(fastest(world), 0);
    EXPECT_EQ(state_hash(world), state_hash(other));
}

}  // namespace
}  // namespace carom::test
