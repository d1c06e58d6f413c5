// A steady step asks the system for no memory. AddressSanitizer has its own operator new, which must not be replaced.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CAROM_ASAN 1
#endif
#endif
#ifndef CAROM_ASAN

#include <algorithm>
#include <carom/carom.hpp>
#include <cstdlib>
#include <new>

#include "gtest/gtest.h"

namespace {
std::size_t asked = 0;
}

[[gnu::noinline]] void* operator new(std::size_t bytes) {
    ++asked;
    if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace carom {
namespace {

/// How often 60 steps ask for memory, after steps in which all that grows has grown.
std::size_t asked_by(World& world, int before) {
    constexpr double dt = 1.0 / 60;
    for (int k = 0; k < before; ++k) world.step(dt);
    const std::size_t start = asked;
    for (int k = 0; k < 60; ++k) world.step(dt);
    return asked - start;
}

/// With friction: without it a pyramid slides apart, and after ten seconds it falls.
World pyramid(bool sleep) {
    SoftStep soft;
    soft.sleep = sleep;
    World world({.gravity = {0, -9.81}, .solver = soft});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
    for (int row = 0; row < 10; ++row)
        for (int k = 0; k < 10 - row; ++k)
            world.add(Body{.position = {k + 0.5 * row, row + 0.5},
                           .shapes = {{.geometry = Box{1, 1}, .density = 1}},
                           .restitution = 0,
                           .friction = 0.6});
    return world;
}

}  // namespace

TEST(Allocation, NoneInAStepOfAPyramid) {
    for (const bool sleep : {false, true}) {
        World world = pyramid(sleep);
        EXPECT_EQ(asked_by(world, 600), 0u) << sleep;
    }
}

TEST(Allocation, NoneWhereADiscRollsBesideSleepers) {
    World world = pyramid(true);
    for (int k = 0; k < 300; ++k) world.step(1.0 / 60);
    world.add(Body{.position = {-200, 0.5}, .velocity = {3, 0}, .radius = 0.5, .restitution = 0, .friction = 0.6});
    EXPECT_EQ(asked_by(world, 60), 0u);
    EXPECT_TRUE(world.asleep(world.ids()[0]));
}

/// A shooter in a level of tiles: of its shapes nothing is made anew. Ten thousand of them took 3 ms for each bullet.
TEST(Allocation, NoneOfALevelToWhichABodyIsAdded) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    Body level{.kind = Kind::fixed};
    for (int k = 0; k < 1000; ++k) level.shapes.push_back({.geometry = Box{.centre = {double(k), -0.5}}});
    world.add(level);
    const BodyId target = world.add(Body{.position = {9, 3}, .shapes = {{.geometry = Box{}}}});
    std::size_t most = 0;
    for (int k = 0; k < 10; ++k) {
        const BodyId bullet = world.add(Body{.position = {0, 9}, .velocity = {30, 0}, .radius = 0.1});
        const auto push = world.add(ConstantForce{.body = target, .force = {1, 0}});
        const std::size_t start = asked;
        world.step(1.0 / 60);
        if (k > 2) most = std::max(most, asked - start);
        world.remove(push);
        world.remove(bullet);
    }
    EXPECT_LT(most, 100u);
}

/// A level that is dug: its tiles are checked, weighed and cut into pieces, and not each of them by name.
TEST(Allocation, FiveForATileOfALevelThatIsSet) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    Body level{.kind = Kind::fixed};
    for (int k = 0; k < 1000; ++k) level.shapes.push_back({.geometry = Box{.centre = {double(k), -0.5}}});
    const BodyId id = world.add(level);
    world.step(1.0 / 60);
    const std::size_t start = asked;
    world.set(id, level);
    world.step(1.0 / 60);
    EXPECT_LT(asked - start, 5100u);
}

TEST(Allocation, NoneInAStepOfARope) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    std::optional<BodyId> last;
    for (int k = 0; k < 20; ++k) {
        const BodyId next = world.add(Body{.position = {k + 0.5, 0}, .radius = 0.1});
        world.add(Joint{.a = last, .b = next, .at = Vec2{double(k), 0}, .type = RevoluteJoint{}});
        last = next;
    }
    EXPECT_EQ(asked_by(world, 120), 0u);
}

TEST(Allocation, NoneInAStepOfSpringsAndOfAnExactGas) {
    World springs;
    std::optional<BodyId> last;
    for (int k = 0; k < 20; ++k) {
        const BodyId next = springs.add(Body{.position = {k + 0.5, 0}});
        if (last) springs.add(Spring{.a = *last, .b = next, .stiffness = 10, .rest_length = 0.9});
        last = next;
    }
    EXPECT_EQ(asked_by(springs, 120), 0u);

    World gas({.solver = Events{}});
    gas.add(Rectangle{.low = {0, 0}, .high = {20, 20}});
    for (int k = 0; k < 100; ++k)
        gas.add(Body{.position = {2.0 * (k % 10) + 1, 2.0 * (k / 10) + 1},
                     .velocity = {k % 7 - 3.0, k % 5 - 2.0},
                     .radius = 0.4});
    EXPECT_EQ(asked_by(gas, 120), 0u);
}

}  // namespace carom

#endif
