#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cstring>

#include "error_of.hpp"
#include "restored.hpp"

namespace carom {
namespace {

using test::error_of;
using test::saved;

void restore(World& world, const std::string& bytes) {
    Loader from(bytes);
    world.restore(from);
    EXPECT_TRUE(from.at_end());
}

/// Something of everything: springs with damping, drag, a driven body on a curve, discs that collide, walls, a field.
World busy_world(const Integrator& method) {
    World world({.gravity = {0, -9.81}, .integrator = method});
    const auto hook = world.add(Body{.kind = Kind::driven, .position = {0, 3}, .name = "hook"});
    world.drive(hook, [](double t) { return Pose{{0.2 * t * (1 - t), 3}, 0}; });
    const auto ball = world.add(Body{.position = {1, 3}, .radius = 0.2, .restitution = 0.8, .friction = 0.3});
    world.add(Body{.position = {-1, 1}, .velocity = {2, 0}, .radius = 0.3, .restitution = 0.9, .name = "disc"});
    world.add(Body{.position = {1.5, 1}, .velocity = {-2, 1}, .radius = 0.3});
    world.add(Spring{.a = hook, .b = ball, .stiffness = 30, .rest_length = 0.5, .damping = 0.1});
    world.add(Drag{.linear = 0.02, .wind = {0.5, 0}});
    world.add(ForceField{.force = [](Vec2 x, Vec2, double, double t) { return Vec2{-x.x, 0.1 * t}; }});
    world.add(Rectangle{.low = {-2, 0}, .high = {2, 5}});
    return world;
}

void expect_same_future(World a, World b, int steps) {
    for (int i = 0; i < steps; ++i) a.step(0.01), b.step(0.01);
    EXPECT_EQ(state_hash(a), state_hash(b));
    const Energy x = energy(a), y = energy(b);
    EXPECT_EQ(std::memcmp(&x, &y, sizeof x), 0);
    EXPECT_EQ(a.collisions(), b.collisions());
    EXPECT_EQ(a.steps(), b.steps());
    EXPECT_EQ(a.time(), b.time());
}

const Integrator methods[] = {Euler{},      SymplecticEuler{}, Verlet{},   Pefrl{},
                              Rk4{},        RungeKutta{},      Adaptive{}, Adaptive{.pair = Pair::dormand_prince54},
                              GaussRadau{}, Implicit{}};

TEST(Snapshots, GoOnWithTheSameBitsUnderEveryIntegrator) {
    for (const Integrator& method : methods) {
        for (const int before : {0, 1, 37, 80}) {
            World world = busy_world(method);
            for (int i = 0; i < before; ++i) world.step(0.01);
            World again = busy_world(method);
            restore(again, saved(world));
            EXPECT_EQ(state_hash(again), state_hash(world));
            expect_same_future(world, again, 60);
        }
    }
}

// Who compares what two computers have saved compares bytes: what lay between the numbers of a record was whatever the
// memory had before.
TEST(Snapshots, OfACopyHaveTheSameBytes) {
    World world({.solver = Events{}});
    world.add(Rectangle{.high = {10, 10}});
    for (int k = 0; k < 20; ++k)
        world.add(Body{.position = {1.0 + 2 * (k % 4), 1.0 + 2 * (k / 4)},
                       .velocity = {1.0 + k % 3, 1.0 - k % 5},
                       .radius = 0.2,
                       .restitution = 0.5});
    World copy = world;
    for (World* one : {&world, &copy}) run(*one, 1, 0.1);
    EXPECT_EQ(saved(world), saved(copy));
}

TEST(Snapshots, KeepBodiesThatCameAndIdsThatWent) {
    World world = busy_world(Verlet{});
    const BodyId gone = world.find("disc");
    world.remove(gone);
    const BodyId fresh = world.add(Body{.position = {0, 4}, .radius = 0.1, .name = "fresh"});
    for (int i = 0; i < 10; ++i) world.step(0.01);
    World again = busy_world(Verlet{});
    restore(again, saved(world));
    EXPECT_FALSE(again.contains(gone));
    EXPECT_EQ(again.find("fresh"), fresh);
    EXPECT_THROW(again.find("disc"), Error);
    const BodyId next = again.add(Body{}), other = world.add(Body{});
    EXPECT_EQ(next, other);
    expect_same_future(world, again, 30);
}

/// A shape of every kind.
std::vector<Shape> all_shapes() {
    const std::vector<Vec2> triangle{{0, 0}, {1, 0}, {0.3, 0.8}};
    return {{.geometry = Disc{.centre = {0.1, 0}, .radius = 0.3}, .restitution = 0.25},
            {.geometry = Capsule{}, .friction = 0.1 + 0.2},
            {.geometry = Box{.angle = 0.3, .rounding = 0.1}, .sensor = true},
            {.geometry = Polygon{.points = triangle, .rounding = 0.01}, .rolling_resistance = 0.1},
            {.geometry = Hull{.points = triangle}, .surface_speed = -1},
            {.geometry = Segment{}, .filter = {.category = 4, .mask = 3, .group = -2}},
            {.geometry = Chain{.points = triangle, .closed = true}}};
}

TEST(Snapshots, KeepShapesBitByBit) {
    const auto plain = [] {
        World world({.solver = NoContact{}});
        world.add(Body{.name = "first"});
        return world;
    };
    World world = plain();
    world.add(Body{.angular_velocity = 1, .shapes = all_shapes()});
    world.add(Body{.shapes = {{.geometry = Box{}, .density = 3.}}});
    world.step(0.01);
    const std::string bytes = saved(world);
    World again = plain();
    restore(again, bytes);
    EXPECT_EQ(saved(again), bytes);
    ASSERT_EQ(again.shapes()[1].size(), all_shapes().size());
    EXPECT_EQ(std::get<Chain>(again.shapes()[1].back().geometry).closed, true);
    EXPECT_EQ(again.shapes()[2].front().density, 3.);
    expect_same_future(world, again, 30);

    for (std::size_t n = 0; n < bytes.size(); ++n) {
        std::string wrong = bytes;
        wrong[n] = static_cast<char>(~wrong[n]);
        World victim = plain();
        Loader from(wrong);
        try {
            victim.restore(from);
            victim.step(0.01);
        } catch (const Error&) {
        }
    }
}

TEST(Snapshots, RefuseShapesThatAreNone) {
    World world;
    world.add(Body{.shapes = {{.geometry = Disc{.radius = 0.375}}}});
    std::string bytes = saved(world);
    const double radius = 0.375, none = -0.375;
    const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&radius), sizeof radius));
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, sizeof none, reinterpret_cast<const char*>(&none), sizeof none);
    Loader from(bytes);
    EXPECT_EQ(error_of([&] { world.restore(from); }), "a body.shapes[0].radius must be a number > 0 in m, got -0.375");
}

TEST(Snapshots, OfWorldsThatWereNeverStepped) {
    const World world = busy_world(GaussRadau{});
    World again = busy_world(GaussRadau{});
    again.step(0.1);
    restore(again, saved(world));
    expect_same_future(world, again, 30);
}

TEST(Snapshots, SavingChangesNothing) {
    World world = busy_world(Adaptive{}), other = world;
    for (int i = 0; i < 40; ++i) {
        world.step(0.01), other.step(0.01);
        saved(world);
    }
    expect_same_future(world, other, 40);
}

TEST(Snapshots, BytesCutAnywhereAreAnErrorAndTheWorldStays) {
    World world = busy_world(Adaptive{});
    for (int i = 0; i < 10; ++i) world.step(0.01);
    const std::string bytes = saved(world);
    World again = busy_world(Adaptive{});
    again.step(0.01);
    const auto before = state_hash(again);
    for (std::size_t n = 0; n < bytes.size(); n += 7) {
        Loader from(std::string_view(bytes).substr(0, n));
        EXPECT_THROW(again.restore(from), Error) << n;
    }
    EXPECT_EQ(state_hash(again), before);
    // Bytes that are not what they were: another state or an Error, and never a wild access.
    for (std::size_t n = 0; n < bytes.size(); n += 3) {
        std::string wrong = bytes;
        wrong[n] = static_cast<char>(~wrong[n]);
        World victim = again;
        Loader from(wrong);
        try {
            victim.restore(from);
        } catch (const Error&) {
        }
    }
}

TEST(Runs, GoOnWhereTheyWereLeft) {
    World whole = busy_world(Verlet{});
    run(whole, 1.005, 0.01);
    for (const std::uint64_t left : {0, 1, 50, 99, 100, 101}) {
        World half = busy_world(Verlet{});
        std::uint64_t done = 0;
        struct Stop {};
        try {
            run(half, 1.005, 0.01, [&](const World&) {
                if (++done == left) throw Stop{};
            });
        } catch (Stop) {
        }
        if (left == 0) half = busy_world(Verlet{}), done = 0;
        run(half, 1.005, 0.01, {}, done);
        EXPECT_EQ(half.steps(), 101u);
        EXPECT_EQ(state_hash(half), state_hash(whole)) << left;
    }
}

}  // namespace
}  // namespace carom
