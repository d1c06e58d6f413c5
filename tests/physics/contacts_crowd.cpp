// Crowds that move: who is a contact is foreseen from how neighbours move, and who is struck goes another way.
#include <algorithm>

#include "physics/contacts.hpp"
#include "physics/statics.hpp"

namespace carom::test {
namespace {

// Discs in a row go for a wall at one speed, a tenth of their size apart: none comes nearer to the next one until the
// first is stopped, and they stop one after the other within a step. Who follows is seen a substep after that.
TEST(Crowd, WhoFollowsAStruckOneDoesNotRunIntoIt) {
    constexpr int discs = 80;
    constexpr double radius = 0.25, gap = 0.05, speed = 20, substep = frame / 4;
    World world({.gravity = {}, .solver = SoftStep{}});
    world.add(HalfPlane{.normal = {-1, 0}, .side = {.restitution = 0}});
    for (int i = 0; i < discs; ++i) {
        Body body = disc({-1 - (2 * radius + gap) * i, 0}, radius);
        body.velocity = {speed, 0};
        world.add(body);
    }
    double deepest = 0;
    for (int step = 0; step < 60; ++step) {
        world.step(frame);
        const auto x = world.positions();
        deepest = std::max(deepest, x[0].x + radius);
        for (int i = 1; i < discs; ++i) deepest = std::max(deepest, x[i].x + 2 * radius - x[i - 1].x);
    }
    // The way of a substep, and half as much for what those behind press before sweeps have told them.
    EXPECT_LT(deepest, 1.5 * speed * substep - gap);
    EXPECT_LT(motion(world), 1e-3 * 0.5 * discs * speed * speed);
}

// Shot that is thinner than its way in a substep: two that go along one behind the other come no nearer, and reach the
// wall in one substep, in which nobody would look who runs into whom.
TEST(Crowd, AThinOneDoesNotRunIntoTheOneBeforeIt) {
    World world({.gravity = {}, .solver = SoftStep{}});
    world.add(HalfPlane{.normal = {-1, 0}, .side = {.restitution = 0}});
    for (int i = 0; i < 60; ++i)
        world.add(disc({-1.0 - 2 * i, 50}, 0.9));  // so that it is a crowd, and slow on average
    std::vector<BodyId> shot;
    for (int i = 0; i < 2; ++i) {
        Body body = disc({-1 - 0.06 * i, 0}, 0.01);
        body.velocity = {100, 0};
        shot.push_back(world.add(body));
    }
    const auto x = [&](std::size_t i) { return world.position(shot[i]).x; };
    for (int step = 0; step < 30; ++step) {
        world.step(frame);
        ASSERT_LT(x(0), 0) << step;
        ASSERT_GT(x(0) - x(1), 0.01) << step;  // half of what they are apart when they touch
    }
}

// One that lies on a crowd is shot away, in the middle of a step, at a plate that nobody had looked for near it: of the
// many bodies it alone goes on otherwise than was foreseen.
TEST(Crowd, WhoIsShotOutOfItDoesNotPassWhatNobodyForesawThere) {
    constexpr double radius = 0.5, speed = 100, thick = 0.02, plate = 1.1, e = 0.5;
    World world({.gravity = {}, .solver = SoftStep{}});
    for (int i = 0; i < 144; ++i) world.add(disc({-1.0 * (i % 12), -1 - 1.0 * (i / 12)}, radius));
    world.add(Body{.kind = Kind::fixed,
                   .position = {plate + 0.5 * thick, 0},
                   .shapes = {{.geometry = Box{thick, 1}}},
                   .restitution = 1});
    const BodyId shot = world.add(disc({0, 0}, radius, 0, e));
    Body bullet = disc({-2 * radius - 0.2, 0}, radius, 0, e);
    bullet.velocity = {speed, 0};
    world.add(bullet);
    world.step(frame);
    // Struck after 2 ms, it goes at three quarters of the speed, and is at the plate after 8 ms more.
    EXPECT_LT(world.position(shot).x, plate - radius);
    EXPECT_LT(world.velocity(shot).x, 0);
}

// A hundred discs fly into a floor by three quarters of their size in a step, so that contacts are looked for anew
// after two substeps: who runs into those that were stopped in the meantime is found then. The worst overlap is that of
// the crash.
TEST(Crowd, FliesIntoItselfAndNotThroughWhileContactsAreLookedForInAStep) {
    World world = floor_world(0.3);
    for (int i = 0; i < 100; ++i) {
        Body body = disc({0.75 * (i % 10) + 0.1 * (i / 10 % 2), 0.5 + 0.8 * (i / 10)}, 0.25, 0.3, 0.1);
        body.velocity = {0, -22};
        world.add(body);
    }
    double deepest = 0;
    for (int n = 0; n < 60; ++n) {
        world.step(frame);
        for (std::size_t i = 0; i < world.size(); ++i) {
            deepest = std::max(deepest, 0.25 - world.positions()[i].y);
            for (std::size_t k = 0; k < i; ++k)
                deepest = std::max(deepest, 0.5 - length(world.positions()[i] - world.positions()[k]));
        }
    }
    EXPECT_LT(deepest, 0.05);
}

// A drum that turns half filled stirs 250 discs: loads that last while they move are borne by preloads and not by
// overlaps. Springs alone let the discs sink into one another by 3.5 thousandths of their size on average.
TEST(Crowd, ThatIsStirredOverlapsByLittle) {
    constexpr double radius = 0.15, half_width = 3;
    World world = floor_world(0.5);
    std::vector<Shape> walls;
    for (const Vec2 side : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}})
        walls.push_back({.geometry = Box{.width = 0.5 + (2 * half_width + 0.5) * std::abs(side.y),
                                         .height = 0.5 + (2 * half_width + 0.5) * std::abs(side.x),
                                         .centre = half_width * side}});
    world.add(
        Body{.kind = Kind::driven, .position = {0, 6}, .angular_velocity = 0.5, .shapes = walls, .friction = 0.6});
    for (int i = 0; i < 250; ++i) world.add(disc({-2.4 + 0.32 * (i % 16), 3.6 + 0.32 * (i / 16)}, radius, 0.5, 0));
    double sum = 0;
    int pressed = 0;
    run(world, 10, frame, [&](const World& now) {
        if (now.time() < 4) return;
        for (std::size_t i = 1; i < now.size(); ++i)
            for (std::size_t k = 1; k < i; ++k)
                if (const double deep = 2 * radius - length(now.positions()[i] - now.positions()[k]); deep > 0)
                    sum += deep, ++pressed;
    });
    EXPECT_LT(sum / pressed, 1e-3 * 2 * radius);
}

// Discs that fill a box to 118 % press as long as they are there: a preload that followed that without end would press
// ever more, throw them about and out of the box.
TEST(Crowd, WithoutRoomComesToRestAndStaysInside) {
    constexpr int side = 14;
    constexpr double radius = 0.5, pitch = 0.78, half = 10 - 0.5 * (25 - side) * pitch;
    World world({.gravity = {}, .solver = SoftStep{}});
    world.add(Rectangle{.low = {-half, -half}, .high = {half, half}});
    for (int i = 0; i < side * side; ++i)
        world.add(disc({0.6 - half + pitch * (i % side), 0.6 - half + pitch * (i / side)}, radius));
    run(world, 10, frame);
    for (const Vec2 place : world.positions()) EXPECT_LT(std::max(std::abs(place.x), std::abs(place.y)), half);
    EXPECT_LT(fastest(world), 1e-6);
}

// What pairs were looked for in steps before tells nobody but the clock. A world that is restored knows of none.
TEST(Crowd, GoesOnWithTheSameBitsWhetherPairsWereKnownOrNot) {
    World world = floor_world(0.4);
    for (int i = 0; i < 60; ++i) world.add(box({-1.5 - 1.5 * (i % 20), 0.5 + i / 20}, 1, 1, 0.6));
    pass(world, 3);
    const auto ids = world.ids();
    ASSERT_EQ(std::count_if(ids.begin(), ids.end(), [&](BodyId id) { return world.asleep(id); }), 60);
    world.add(
        Body{.kind = Kind::driven, .position = {-33, 0.5}, .velocity = {3, 0}, .shapes = {{.geometry = Box{1, 1}}}});
    for (int i = 0; i < 240; ++i) {
        Body body = i % 3 == 0 ? disc({0.7 * (i % 20), 1 + 0.7 * (i / 20)}, 0.3, 0.4, 0.2)
                               : box({0.7 * (i % 20), 1 + 0.7 * (i / 20)}, 0.5, 0.3 + 0.02 * (i % 7), 0.4);
        body.velocity = {0.3 * (i % 5), -2.0 * (i % 4)};
        world.add(body);
    }
    World other = world;
    for (int step = 0; step < 90; ++step) {
        restore_from(other, other);
        const double dt = step < 60 ? frame : frame / 2;
        world.step(dt), other.step(dt);
        ASSERT_EQ(state_hash(other), state_hash(world)) << step;
    }
}

// Contacts lie in the blocks of the step before while they are of the same bodies and press alike. Those of a fixed
// body may share a colour, and those of one that moves may not.
TEST(Crowd, LaysContactsOutAnewWhenAFixedBodySetsOff) {
    World world = floor_world(0.4);
    Body slab = box({0, 2}, 20, 0.5, 0.6);
    slab.kind = Kind::fixed;
    const BodyId id = world.add(slab);
    for (int i = 0; i < 60; ++i) world.add(box({-9 + 0.95 * (i % 20), 2.65 + 0.8 * (i / 20)}, 0.8, 0.8, 0.6));
    World other = world;
    pass(world, 0.2);
    Body free = world.body(id);
    free.kind = Kind::dynamic, free.velocity = {0, 2};
    world.set(id, free), other.set(id, free);
    restore_from(world, other);
    for (int step = 0; step < 30; ++step) {
        world.step(frame), other.step(frame);
        ASSERT_EQ(state_hash(other), state_hash(world)) << step;
    }
    EXPECT_NE(world.position(id).y, 2);
}

}  // namespace
}  // namespace carom::test
