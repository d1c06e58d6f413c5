// What a world tells of its last step: closed forms, counts by brute force, and the same after a snapshot.
#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>

#include "restored.hpp"

using namespace carom;

namespace {

using Pairs = std::vector<ShapePair>;
constexpr ShapeId floor_wall{};

World soft_world(double gravity = 9.81) { return World({.gravity = {0, -gravity}, .solver = SoftStep{}}); }

/// What touches by the count of begins and ends; each begin must be new, each end of what touched.
struct Count {
    Pairs touching, seen;

    static void follow(Pairs& pairs, const Pairs& begins, const Pairs& ends) {
        for (const ShapePair& pair : begins) {
            EXPECT_EQ(std::count(pairs.begin(), pairs.end(), pair), 0);
            pairs.push_back(pair);
        }
        for (const ShapePair& pair : ends) EXPECT_EQ(std::erase(pairs, pair), 1u);
    }
    void follow(const StepEvents& events) {
        follow(touching, events.begins, events.ends);
        follow(seen, events.sensor_begins, events.sensor_ends);
    }
};

/// Discs and boxes that bounce, slide and pile up in a room with sensors.
World busy() {
    World world = soft_world();
    world.add(Rectangle{.low = {-3, 0}, .high = {3, 8}, .bottom = {0.5, 0.4}});
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Box{3, 1, {0, 1}}, .sensor = true}}});
    Random random(5);
    for (int n = 0; n < 14; ++n) {
        Body body{.position = {random.uniform(-2.5, 2.5), 0.6 + 0.5 * n}, .velocity = {random.uniform(-3, 3), 0}};
        body.restitution = n % 3 == 0 ? 0 : 0.6;
        body.friction = 0.3;
        if (n % 2 == 0)
            body.shapes = {{.geometry = Disc{{0, 0}, 0.2}}};
        else
            body.shapes = {{.geometry = Box{0.4, 0.3}}, {.geometry = Disc{{0.2, 0}, 0.1}}};
        if (n % 5 == 1) body.shapes.push_back({.geometry = Disc{{0, 0}, 0.5}, .sensor = true});
        world.add(body);
    }
    return world;
}

}  // namespace

TEST(Events, ContactsOfABodyAreThoseOfAllThatHaveIt) {
    World world = busy();
    run(world, 2, 1.0 / 60);
    std::size_t in_pairs = 0, at_walls = 0;
    const auto expect_same = [&] {
        const auto all = world.contacts();
        in_pairs = at_walls = 0;
        for (const BodyId id : world.ids()) {
            std::vector<ContactPoint> expected;
            for (const ContactPoint& point : all)
                if (point.shapes.a.body == id || point.shapes.b.body == id) expected.push_back(point);
            EXPECT_EQ(world.contacts(id), expected);
            for (const ContactPoint& point : expected) ++(point.shapes.at_wall() ? at_walls : in_pairs);
        }
        EXPECT_GT(at_walls, 0u);
        EXPECT_EQ(in_pairs + 2 * at_walls, 2 * all.size());
    };
    expect_same();
    test::restore_from(world, world);
    for (const BodyId id : world.ids()) EXPECT_TRUE(world.contacts(id).empty());
    world.step(1.0 / 60);
    expect_same();
    // Those of one that is gone are nobody's, nor its successor's under the same index.
    const BodyId gone = world.contacts().back().shapes.b.body;
    world.remove(gone);
    const BodyId next = world.add(Body{.position = {0, 30}});
    EXPECT_EQ(next.index, gone.index);
    expect_same();
    EXPECT_TRUE(world.contacts(next).empty());
    EXPECT_THROW(world.contacts(gone), Error);
    run(world, 8, 1.0 / 60);  // some sleep
    expect_same();
    world.remove(next);
    EXPECT_THROW(world.contacts(BodyId{}), Error);
}

TEST(Events, ContactsOfABodyThatAForceAsksForInAStepAreNotKept) {
    World world = busy();
    std::size_t asked = 0;
    const BodyId first = world.ids()[3];
    for (const BodyId id : world.ids())
        if (world.body(id).kind == Kind::dynamic) world.set_velocity(id, {40, 25}, 0);  // so that some are found late
    world.add(UserForce{
        .add = [&](const Snapshot&, std::span<Vec2>, std::span<double>) { asked += world.contacts(first).size(); }});
    for (int n = 0; n < 120; ++n) {
        world.step(1.0 / 60);
        std::vector<ContactPoint> expected;
        for (const ContactPoint& point : world.contacts())
            if (point.shapes.a.body == first || point.shapes.b.body == first) expected.push_back(point);
        EXPECT_EQ(world.contacts(first), expected);
    }
    EXPECT_GT(asked, 0u);
}

TEST(Events, OfABallThatBouncesOnTheFloor) {
    World world = soft_world();
    EXPECT_EQ(world.events(), StepEvents{});
    world.add(HalfPlane{});
    const BodyId ball = world.add(Body{.position = {2, 1.3}, .mass = 3, .radius = 0.3, .restitution = 0.5});
    const double time = std::sqrt(2 / 9.81), speed = std::sqrt(2 * 9.81);
    const ShapePair pair{floor_wall, {ball, 0}};
    while (world.time() + 1.0 / 60 < time) {
        world.step(1.0 / 60);
        EXPECT_EQ(world.events(), StepEvents{});
    }
    world.step(1.0 / 60);
    ASSERT_EQ(world.events().impacts.size(), 1u);
    const Impact& impact = world.events().impacts[0];
    EXPECT_EQ(impact.shapes, pair);
    EXPECT_TRUE(impact.shapes.at_wall());
    EXPECT_NEAR(impact.time, time, 1e-12);
    EXPECT_LT(length(impact.point - Vec2{2, 0}), 1e-12);
    EXPECT_EQ(impact.normal, (Vec2{0, 1}));
    EXPECT_NEAR(impact.approach, speed, 1e-12);
    EXPECT_NEAR(impact.impulse, 3 * 1.5 * speed, 1e-11);
    EXPECT_EQ(world.events().begins, Pairs{pair});
    EXPECT_TRUE(world.events().ends.empty());
    world.step(1.0 / 60);
    EXPECT_EQ(world.events().ends, Pairs{pair});
    EXPECT_TRUE(world.events().begins.empty() && world.events().impacts.empty());
}

TEST(Events, OfWhatFallsAndStays) {
    for (const double restitution : {0.0, 0.3}) {
        World world = soft_world();
        const BodyId ground = world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Box{20, 1, {0, -0.5}}}}});
        const BodyId crate = world.add(
            Body{.position = {0, 1.5}, .mass = 2, .shapes = {{.geometry = Box{}}}, .restitution = restitution});
        Count count;
        std::vector<Impact> impacts;
        for (int n = 0; n < 240; ++n) {
            world.step(1.0 / 60);
            count.follow(world.events());
            impacts.insert(impacts.end(), world.events().impacts.begin(), world.events().impacts.end());
        }
        EXPECT_EQ(count.touching, (Pairs{{{ground, 0}, {crate, 0}}}));
        ASSERT_FALSE(impacts.empty());
        const double h = 1.0 / 240, speed = std::sqrt(2 * 9.81);
        EXPECT_NEAR(impacts[0].approach, speed, 9.81 * h);
        EXPECT_NEAR(impacts[0].time, std::sqrt(2 / 9.81), h);
        EXPECT_NEAR(impacts[0].impulse, 2 * (1 + restitution) * speed, 0.05 * 2 * speed);
        EXPECT_LT(std::abs(impacts[0].point.y), 1e-3);
        EXPECT_LT(length(impacts[0].normal - Vec2{0, 1}), 1e-12);
        EXPECT_LT(impacts.back().time, 3) << "what rests strikes no more";
        EXPECT_TRUE(restitution > 0 || impacts.size() == 1);
    }
}

TEST(Events, OfTwoBodiesAreInTheOrderOfTheirIndices) {
    World world = soft_world(0);
    const BodyId left = world.add(Body{.position = {-1, 0}, .velocity = {3, 0}, .mass = 2, .radius = 0.5});
    const BodyId right = world.add(Body{.position = {1, 0}, .velocity = {-1, 0}, .mass = 3, .radius = 0.5});
    std::vector<Impact> impacts;
    for (int n = 0; n < 60; ++n) {
        world.step(1.0 / 60);
        impacts.insert(impacts.end(), world.events().impacts.begin(), world.events().impacts.end());
    }
    ASSERT_EQ(impacts.size(), 1u);
    EXPECT_EQ(impacts[0].shapes, (ShapePair{{left, 0}, {right, 0}}));
    EXPECT_NEAR(impacts[0].time, 0.25, 1e-12);
    EXPECT_NEAR(impacts[0].approach, 4, 1e-12);
    EXPECT_NEAR(impacts[0].impulse, 2 * 4 * 2 * 3 / 5.0, 1e-12);  // (1 + e) times approach times reduced mass
    EXPECT_LT(length(impacts[0].point - Vec2{0.25, 0}), 1e-9);
    EXPECT_LT(length(impacts[0].normal - Vec2{1, 0}), 1e-9);
}

TEST(Events, AreOfShapes) {
    World world = soft_world();
    const BodyId ground = world.add(
        Body{.kind = Kind::fixed, .shapes = {{.geometry = Box{2, 1, {-3, -0.5}}}, {.geometry = Box{2, 1, {3, -0.5}}}}});
    const BodyId plank =
        world.add(Body{.position = {0, 0.09}, .shapes = {{.geometry = Box{8, 0.2}}}, .restitution = 0});
    Count count;
    for (int n = 0; n < 60; ++n) world.step(1.0 / 60), count.follow(world.events());
    EXPECT_EQ(count.touching, (Pairs{{{ground, 0}, {plank, 0}}, {{ground, 1}, {plank, 0}}}));
    world.remove(plank);
    world.step(1.0 / 60);
    EXPECT_EQ(world.events().ends, count.touching);
    world.step(1.0 / 60);
    EXPECT_EQ(world.events(), StepEvents{});
}

TEST(Events, OfWhatSlidesEndWhereTheGroundEnds) {
    World world = soft_world();
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Box{4, 1, {0, -0.5}}}}});
    world.add(Body{.position = {0.03, 0.2}, .velocity = {4, 0}, .radius = 0.2, .restitution = 0});
    for (int n = 0; n < 60; ++n) {
        const double x = world.positions()[1].x;
        world.step(1.0 / 60);
        EXPECT_EQ(world.events().begins.size(), n == 0 ? 1u : 0u);
        EXPECT_EQ(world.events().ends.size(), x > 2 && x < 2.06 ? 1u : 0u) << x;
    }
}

TEST(Events, OfSensors) {
    for (const Solver& solver : {Solver{SoftStep{}}, Solver{NoContact{}}}) {
        World world({.solver = solver});
        Shape gate{.geometry = Box{1, 4}, .sensor = true};
        const BodyId fixed = world.add(Body{.kind = Kind::fixed, .shapes = {gate}});
        const BodyId ball = world.add(Body{.position = {-2, 0}, .velocity = {1, 0}, .radius = 0.25});
        gate.filter.mask = 2;  // sees nothing of category 1
        world.add(Body{.kind = Kind::fixed, .shapes = {gate}});
        gate.filter.mask = 1;  // and a sensor sees no sensor
        world.add(Body{.kind = Kind::fixed, .shapes = {gate, {.geometry = Disc{.centre = {0, 1.5}}}}});
        const BodyId last = world.ids()[3];
        const ShapePair pair{{fixed, 0}, {ball, 0}};
        Count count;
        for (int n = 1; n <= 80; ++n) {
            world.step(0.05);
            count.follow(world.events());
            const double x = -2 + 0.05 * n;
            if (std::abs(std::abs(x) - 0.75) < 1e-9) continue;  // just touching, or just not
            // The disc of the last body lies in the first gate all the time, both being fixed.
            EXPECT_EQ(count.seen.size(), std::abs(x) < 0.75 ? 3u : 1u) << x;
            EXPECT_EQ(std::count(count.seen.begin(), count.seen.end(), pair), std::abs(x) < 0.75) << x;
            EXPECT_EQ(count.seen[0], (ShapePair{{fixed, 0}, {last, 1}}));
        }
        EXPECT_TRUE(count.touching.empty());
    }
}

TEST(Events, OfASensorThatMovesPastWhatIsFixed) {
    World world = soft_world(0);
    const BodyId post = world.add(Body{.kind = Kind::fixed, .radius = 0.5});
    const BodyId eye = world.add(Body{.kind = Kind::driven,
                                      .position = {-3, 0},
                                      .velocity = {1, 0},
                                      .shapes = {{.geometry = Disc{}, .sensor = true}}});
    Count count;
    for (int n = 1; n <= 60; ++n) {
        world.step(0.1);
        count.follow(world.events());
        const double x = std::abs(-3 + 0.1 * n);
        if (std::abs(x - 1) < 1e-9) continue;
        EXPECT_EQ(count.seen, x < 1 ? (Pairs{{{eye, 0}, {post, 0}}}) : Pairs{}) << x;
    }
}

// Few ask for what is near each, many are swept.
TEST(Events, OfASensorAreTheSameAmongManyOthers) {
    const auto room = [](int others) {
        World world({.gravity = {0, -10}, .solver = SoftStep{}});
        Random random(2);
        for (int n = 0; n < 60; ++n) {
            const Shape shape{.geometry = Box{.width = random.uniform(0.3, 1)}, .sensor = n % 3 == 0};
            world.add(Body{.kind = n % 2 == 0 ? Kind::dynamic : Kind::fixed,
                           .position = {random.uniform(-3, 3), random.uniform(-3, 3)},
                           .shapes = {shape},
                           .restitution = 0});
        }
        for (int n = 0; n < others; ++n)
            world.add(Body{
                .kind = Kind::fixed, .position = {100.0 + 2 * n, 0}, .shapes = {{.geometry = Box{}, .sensor = true}}});
        return world;
    };
    World few = room(0), many = room(500);
    std::size_t seen = 0;
    for (int n = 0; n < 60; ++n) {
        few.step(1.0 / 60), many.step(1.0 / 60);
        EXPECT_EQ(few.events().sensor_begins, many.events().sensor_begins) << n;
        EXPECT_EQ(few.events().sensor_ends, many.events().sensor_ends) << n;
        seen += few.events().sensor_begins.size() + few.events().sensor_ends.size();
    }
    EXPECT_GT(seen, 20u);
}

TEST(Events, OfABusyRoomAddUp) {
    World world = busy();
    Count count;
    std::uint64_t impacts = 0, most = 0;
    for (int n = 0; n < 240; ++n) {
        const std::uint64_t before = world.collisions();
        const double start = world.time();
        world.step(1.0 / 60);
        const StepEvents& events = world.events();
        count.follow(events);
        impacts += events.impacts.size();
        most = std::max<std::uint64_t>(most, events.impacts.size());
        EXPECT_GE(events.impacts.size(), world.collisions() - before);
        double last = start - 1e-12;
        for (const Impact& impact : events.impacts) {
            EXPECT_GE(impact.time, last);
            EXPECT_LE(impact.time, world.time() + 1e-12);
            EXPECT_GT(impact.impulse, 0);
            EXPECT_GE(impact.approach, 0);
            EXPECT_EQ(std::count(count.touching.begin(), count.touching.end(), impact.shapes), 1);
            last = impact.time;
        }
        // What touches lies against one another, and what sensors see is what a question finds.
        for (const auto& [a, b] : count.touching)
            EXPECT_LT(a.body.generation == 0 ? 0 : world.closest_points(a.body, b.body)->distance, 0.12);
        std::size_t seen = 0;
        for (const BodyId id : world.ids()) {
            const Body body = world.body(id);
            for (std::uint32_t k = 0; k < body.shapes.size(); ++k)
                if (body.shapes[k].sensor)
                    for (const ShapeId& found :
                         world.shapes_touching(body.shapes[k].geometry, {body.position, body.angle}, {.except = id})) {
                        ++seen;
                        EXPECT_EQ(std::count(count.seen.begin(), count.seen.end(), ShapePair{{id, k}, found}), 1);
                    }
        }
        EXPECT_EQ(seen, count.seen.size());
    }
    EXPECT_GT(impacts, 100u);
    EXPECT_GT(most, 2u);
    EXPECT_GT(count.touching.size(), 5u);
}

TEST(Events, AreTheSameAfterASnapshot) {
    World world = busy();
    for (int n = 0; n < 120; ++n) {
        world.step(1.0 / 60);
        if (n % 10 != 0) continue;
        World copy = world, again = busy();
        EXPECT_EQ(copy.events(), world.events());
        test::restore_from(world, again);
        EXPECT_EQ(again.events(), StepEvents{});
        World future = world;
        for (int k = 0; k < 12; ++k) {
            future.step(1.0 / 60), copy.step(1.0 / 60), again.step(1.0 / 60);
            ASSERT_EQ(copy.events(), future.events()) << n << " " << k;
            ASSERT_EQ(again.events(), future.events()) << n << " " << k;
        }
    }
}

TEST(Events, OfContactsEndUnderASolverThatHasNone) {
    World world = soft_world();
    world.add(HalfPlane{});
    const BodyId disc = world.add(Body{.position = {0, 0.5}, .radius = 0.5, .restitution = 0});
    for (int n = 0; n < 10; ++n) world.step(1.0 / 60);
    world.configure({.solver = NoContact{}});
    world.step(1.0 / 60);
    EXPECT_EQ(world.events().ends, (Pairs{{floor_wall, {disc, 0}}}));
    world.step(1.0 / 60);
    EXPECT_EQ(world.events(), StepEvents{});
}
