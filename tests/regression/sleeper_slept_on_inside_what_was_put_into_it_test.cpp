// A fixed or driven body that was put into a crate that slept, grown into it, made solid around it or newly added
// there did not wake it: the crate slept on in it for good, with no contact and no begin.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <functional>

namespace carom::test {
namespace {

constexpr double dt = 1.0 / 60;

Body block(Kind kind, Vec2 position) {
    return {.kind = kind, .position = position, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.3};
}

struct Sleeping {
    World world{{.gravity = {0, -9.81}, .solver = SoftStep{}}};
    BodyId crate, fixed, driven;
    Sleeping() {
        world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.3}});
        crate = world.add(block(Kind::dynamic, {0, 0.5}));
        fixed = world.add(block(Kind::fixed, {3, 0.5}));
        driven = world.add(block(Kind::driven, {-3, 0.5}));
        run(world, 2, dt);
        EXPECT_TRUE(world.asleep(crate));
    }
    void change(const std::function<void(Body&)>& edit) {
        Body body = world.body(fixed);
        edit(body);
        world.set(fixed, body);
    }
};

TEST(SleeperSleptOnInsideWhatWasPutIntoIt, IsWokenAndPushedOut) {
    const auto go_there = [](Body& b) { b.position = {0.7, 0.5}; };
    const std::pair<const char*, std::function<void(Sleeping&)>> ways[] = {
        {"set_position",
         [](Sleeping& s) {
             s.world.set_position(s.fixed, {0.7, 0.5}, 0);
         }},
        {"set", [&](Sleeping& s) { s.change(go_there); }},
        {"grown", [](Sleeping& s) { s.change([](Body& b) {
                                        b.shapes = {{.geometry = Box{5.6, 1}}};
                                    }); }},
        {"added",
         [](Sleeping& s) {
             s.world.add(block(Kind::fixed, {0.7, 0.5}));
         }},
        {"a sensor before",
         [&](Sleeping& s) {
             s.change([&](Body& b) { go_there(b), b.shapes[0].sensor = true; });
             s.world.step(dt);
             EXPECT_TRUE(s.world.asleep(s.crate));
             s.change([](Body& b) { b.shapes[0].sensor = false; });
         }},
        {"filtered before",
         [&](Sleeping& s) {
             s.change([&](Body& b) { go_there(b), b.shapes[0].filter.mask = 2; });
             s.world.step(dt);
             EXPECT_TRUE(s.world.asleep(s.crate));
             s.change([](Body& b) { b.shapes[0].filter.mask = 1; });
         }},
        {"driven",
         [](Sleeping& s) {
             s.world.set_position(s.driven, {0.7, 0.5}, 0);
         }},
    };
    for (const auto& [name, way] : ways) {
        SCOPED_TRACE(name);
        Sleeping s;
        way(s);
        s.world.step(dt);
        EXPECT_FALSE(s.world.asleep(s.crate));
        EXPECT_EQ(s.world.events().begins.size(), 1u);
        EXPECT_EQ(s.world.events().wakes, std::vector{s.crate});
        run(s.world, 5, dt);
        EXPECT_TRUE(s.world.asleep(s.crate));
        for (const Overlap& o : s.world.overlaps()) EXPECT_LT(o.depth, 1e-3);
    }
}

TEST(SleeperSleptOnInsideWhatWasPutIntoIt, SleepsOnBesideWhatDoesNotTouchIt) {
    Sleeping s;
    s.world.set_position(s.fixed, {1.001, 0.5}, 0);
    s.world.add(block(Kind::fixed, {-1.001, 0.5}));
    s.change([](Body& b) { b.shapes[0].filter.mask = 2, b.position = {0.5, 0.5}; });
    s.world.step(dt);
    EXPECT_TRUE(s.world.asleep(s.crate));
    EXPECT_TRUE(s.world.events().wakes.empty());
}

TEST(SleeperSleptOnInsideWhatWasPutIntoIt, AWorldSavedBetweenGoesOnLikeIt) {
    Sleeping s;
    s.world.set_position(s.fixed, {0.7, 0.5}, 0);
    World copy = s.world;
    s.world.step(dt), copy.step(dt);
    EXPECT_FALSE(copy.asleep(s.crate));
    EXPECT_EQ(copy.position(s.crate), s.world.position(s.crate));
}

}  // namespace
}  // namespace carom::test
