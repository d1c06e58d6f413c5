// Questions to a world: where bodies are, under every solver and whatever was done to it before.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cstring>

#include "error_of.hpp"
#include "restored.hpp"

using namespace carom;
using test::error_of;

namespace {

const Solver askable[] = {Impulse{.time_of_impact = false}, SoftStep{}, NoContact{}};

using Names = std::vector<std::string>;
Names names(const World& world, const std::vector<ShapeId>& shapes) {
    Names all;
    for (const ShapeId& s : shapes) all.push_back(world.body(s.body).name + "/" + std::to_string(s.shape));
    return all;
}

bool same(const Hit& a, const Hit& b) {
    return a.body == b.body && a.shape == b.shape && a.point == b.point && a.normal == b.normal &&
           a.fraction == b.fraction;
}

/// A world of the same bodies that was never asked anything. Its ids are numbered by rows.
World anew(const World& world) {
    World other(world.settings());
    for (const BodyId id : world.ids()) other.add(world.body(id));
    return other;
}

BodyId some_body(const World& world, Random& random) {
    return world.ids()[static_cast<std::size_t>(random.uniform(0, static_cast<double>(world.size())))];
}

Body random_body(Random& random) {
    Body body{
        .position = {random.uniform(-4, 4), random.uniform(-4, 4)}, .angle = random.uniform(-3, 3), .restitution = 0};
    body.velocity = {random.uniform(-1, 1), random.uniform(-1, 1)};
    body.kind = random.uniform() < 0.3 ? Kind::fixed : Kind::dynamic;
    if (body.kind == Kind::fixed) body.velocity = {};
    if (random.uniform() < 0.4)
        body.radius = random.uniform(0, 0.5);
    else
        body.shapes = {{.geometry = Box{.width = random.uniform(0.1, 1)}},
                       {.geometry = Capsule{}, .sensor = random.uniform() < 0.3}};
    return body;
}

/// Both answer every question in the same way, but for the ids.
void expect_same_answers(const World& asked, const World& fresh, Random& random) {
    const auto same_body = [&](BodyId a, BodyId b) { return asked.body(a).position == fresh.body(b).position; };
    for (int n = 0; n < 5; ++n) {
        const Vec2 at{random.uniform(-5, 5), random.uniform(-5, 5)}, way{random.uniform(-9, 9), 1};
        const auto hits = asked.cast_ray_through(at, way), others = fresh.cast_ray_through(at, way);
        ASSERT_EQ(hits.size(), others.size());
        for (std::size_t i = 0; i < hits.size(); ++i) {
            EXPECT_TRUE(same_body(hits[i].body, others[i].body));
            EXPECT_EQ(hits[i].fraction, others[i].fraction);
        }
        const auto first = asked.cast_ray(at, way);
        ASSERT_EQ(first.has_value(), !hits.empty());
        EXPECT_TRUE(!first || same(*first, hits[0]));
        const auto found = asked.shapes_touching(Box{2, 2}, {at, 1}),
                   found_anew = fresh.shapes_touching(Box{2, 2}, {at, 1});
        ASSERT_EQ(found.size(), found_anew.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(same_body(found[i].body, found_anew[i].body));
    }
}

}  // namespace

TEST(Queries, OfPointsAndDiscsUnderEverySolver) {
    for (const Solver& solver : askable) {
        World world({.solver = solver});
        const BodyId disc = world.add(Body{.position = {3, 1}, .angle = 2, .radius = 1, .name = "disc"});
        world.add(Body{.position = {1, 1}, .name = "point"});
        const auto hit = world.cast_ray({0, 1}, {4, 0});  // no ray meets a point
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->body, disc);
        EXPECT_EQ(hit->shape, 0u);
        EXPECT_NEAR(hit->fraction, 0.5, 1e-15);
        EXPECT_LT(length(hit->point - Vec2{2, 1}), 1e-14);
        EXPECT_LT(length(hit->normal - Vec2{-1, 0}), 1e-14);
        EXPECT_EQ(names(world, world.shapes_at({3.6, 1.6})), Names{"disc/0"});
        EXPECT_EQ(names(world, world.shapes_at({3.8, 1.8})), Names{});
        EXPECT_EQ(names(world, world.shapes_at({1, 1})), Names{"point/0"});
        EXPECT_EQ(names(world, world.shapes_in_box({0, 0}, {2.1, 2})), (Names{"disc/0", "point/0"}));
        const auto cast = world.cast_shape(Disc{.radius = 0.5}, {{-2, 1}, 0}, {5, 0});
        EXPECT_NEAR(cast->fraction, 0.5, 1e-9);  // the point, at x = 1
        EXPECT_NEAR(world.closest_points(disc, world.find("point"))->distance, 1, 1e-15);
    }
}

TEST(Queries, NameTheShape) {
    World world({.solver = SoftStep{}});
    const Shape head{.geometry = Box{.width = 1, .height = 2, .centre = {3, 0}}};
    const BodyId hammer = world.add(Body{.kind = Kind::fixed,
                                         .position = {1, 0},
                                         .angle = 1.5707963267948966,
                                         .shapes = {{.geometry = Box{.width = 5, .height = 0.2}}, head},
                                         .name = "hammer"});
    world.add(Body{.position = {1, 8}, .shapes = {{.geometry = Box{}, .sensor = true}}, .name = "door"});
    const auto hit = world.cast_ray({1.5, 9}, {0, -10});  // the head is at (1, 3), 2 m wide
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->body, hammer);
    EXPECT_EQ(hit->shape, 1u);
    EXPECT_NEAR(hit->point.y, 3.5, 1e-15);
    EXPECT_EQ(names(world, world.shapes_in_box({0, 2}, {2, 8})), (Names{"hammer/0", "hammer/1"}));
    EXPECT_EQ(names(world, world.shapes_in_box({0, 2}, {2, 8}, {.sensors = true})),
              (Names{"hammer/0", "hammer/1", "door/0"}));
    EXPECT_EQ(world.cast_ray({1, 9}, {0, -10}, {.sensors = true})->body, world.find("door"));
    EXPECT_FALSE(world.cast_ray({1, 9}, {0, -10}, {.except = hammer}));
    EXPECT_FALSE(world.closest_points(hammer, world.find("door")));
    EXPECT_NEAR(world.closest_points(hammer, world.find("door"), {.sensors = true})->distance, 4, 1e-15);
}

TEST(Queries, AreRightAfterEveryEdit) {
    for (const Solver& solver : askable) {
        Random random(7);
        World world({.gravity = {0, -1}, .solver = solver});
        for (int n = 0; n < 200; ++n) {
            const double what = random.uniform();
            if (world.size() < 4 || what < 0.3) {
                Body body = random_body(random);
                if (std::holds_alternative<Impulse>(solver)) body.shapes.clear();
                world.add(body);
            } else if (what < 0.5) {
                world.remove(some_body(world, random));
            } else if (what < 0.6) {
                Body body = random_body(random);
                if (std::holds_alternative<Impulse>(solver)) body.shapes.clear();
                world.set(some_body(world, random), body);
            } else if (what < 0.7) {
                world.set_position(some_body(world, random), {random.uniform(-4, 4), 1}, 0.5);
            } else if (what < 0.8) {
                const World copy = world;  // the copy lives on when the original moves
                world.step(0.01);
                expect_same_answers(copy, anew(copy), random);
            } else {
                world.step(0.01);
            }
            expect_same_answers(world, anew(world), random);
        }
    }
}

TEST(Queries, SeeWhereACurveHasPutABody) {
    World world({.solver = NoContact{}});
    const BodyId lift = world.add(Body{.kind = Kind::driven, .radius = 0.5});
    EXPECT_EQ(world.shapes_at({0, 0}).size(), 1u);
    world.drive(lift, [](double t) { return Pose{{5 + t, 0}, 0}; });
    EXPECT_EQ(world.shapes_at({0, 0}).size(), 0u);
    EXPECT_EQ(world.shapes_at({5, 0}).size(), 1u);
    world.step(1);
    EXPECT_EQ(world.shapes_at({5, 0}).size(), 0u);
    EXPECT_EQ(world.shapes_at({6, 0}).size(), 1u);
    world.drive(lift, {});
    world.set_position(lift, {9, 0}, 0);
    EXPECT_EQ(world.shapes_at({9, 0}).size(), 1u);
    EXPECT_EQ(world.shapes_at({6, 0}).size(), 0u);
}

/// Who is inside of another one and would collide, the deepest first.
TEST(Queries, OverlapsAreOfThoseThatCollide) {
    World world({.solver = SoftStep{}});
    world.add(HalfPlane{.point = {0, -9}});
    world.add(HalfPlane{});
    const std::vector<Shape> square{{.geometry = Box{1, 1}}};
    const BodyId a = world.add(Body{.position = {0, 0.4}, .shapes = square}),
                 b = world.add(Body{.position = {0.75, 0.5}, .shapes = square}),
                 joined = world.add(Body{.position = {0.75, 1.45}, .shapes = square});
    world.add(Joint{.a = b, .b = joined, .type = WeldJoint{}});
    for (int k = 0; k < 2; ++k) world.add(Body{.kind = Kind::fixed, .position = {9, 1}, .shapes = square});
    world.add(Body{.position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}, .sensor = true}}});
    world.add(Body{.position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}, .filter = {.mask = 0}}}});
    world.add(Body{.position = {20, 0.5}, .radius = 0.5});  // touches the ground
    const auto found = world.overlaps();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].shapes, (ShapePair{{a, 0}, {b, 0}}));
    EXPECT_NEAR(found[0].depth, 0.25, 1e-15);
    EXPECT_NEAR(found[0].part, 0.25, 1e-15);
    EXPECT_EQ(found[1].shapes, (ShapePair{{{}, 1}, {a, 0}}));
    EXPECT_NEAR(found[1].depth, 0.1, 1e-15);
}

/// A wall has the number that it has in events.
TEST(Queries, FindWallsIfTheyAreSought) {
    World world({.solver = SoftStep{}});
    world.add(Rectangle{.low = {-4, -3}, .high = {4, 3}});
    world.add(HalfPlane{.point = {0, -2}});
    const BodyId ball = world.add(Body{.position = {2, 0}, .radius = 1}),
                 outside = world.add(Body{.kind = Kind::fixed, .position = {6, 0}, .radius = 1});
    EXPECT_FALSE(world.cast_ray({0, 0}, {0, -9}));
    const auto floor = world.cast_ray({0, 0}, {0, -4}, {.filter = Filter{.mask = 0}, .walls = true});
    ASSERT_TRUE(floor);
    EXPECT_TRUE(floor->at_wall());
    EXPECT_EQ((ShapeId{floor->body, floor->shape}), (ShapeId{{}, 4}));
    EXPECT_EQ(floor->fraction, 0.5);
    EXPECT_EQ(floor->point, (Vec2{0, -2}));
    EXPECT_EQ(floor->normal, (Vec2{0, 1}));
    EXPECT_EQ(world.cast_ray({0, 0}, {9, 0}, {.walls = true})->body, ball);
    EXPECT_FALSE(world.cast_ray({0, 0}, {9, 0}, {.walls = true})->at_wall());
    const auto through = world.cast_ray_through({0, 0}, {8, 0}, {.walls = true});
    ASSERT_EQ(through.size(), 3u);
    EXPECT_EQ(through[0].body, ball);
    EXPECT_TRUE(through[1].at_wall());
    EXPECT_EQ(through[1].shape, 1u);
    EXPECT_EQ(through[1].fraction, 0.5);
    EXPECT_EQ(through[2].body, outside);
    EXPECT_FALSE(world.cast_shape(Box{}, {{0, 0}, 0}, {0, 9}));
    const auto ceiling = world.cast_shape(Box{}, {{0, 0}, 0}, {0, 5}, {.walls = true});
    ASSERT_TRUE(ceiling);
    EXPECT_EQ((ShapeId{ceiling->body, ceiling->shape}), (ShapeId{{}, 3}));
    EXPECT_EQ(ceiling->fraction, 0.5);
    EXPECT_EQ(world.cast_shape(Box{}, {{0, 0}, 0}, {5, 0}, {.walls = true})->body, ball);
    EXPECT_TRUE(world.shapes_at({0, -2.5}, {.walls = true}).empty());
    world.remove(world.wall_id<HalfPlane>(0));
    EXPECT_EQ(world.cast_ray({0, 0}, {0, -4}, {.walls = true})->shape, 2u);
}

TEST(Queries, FindRoundWalls) {
    World world({.solver = Events{}});
    world.add(Stadium{.a = {-1, 0}, .b = {1, 0}, .radius = 1});
    world.add(Body{.position = {-1, 0}, .radius = 0.1});
    const auto end = world.cast_ray({0.5, 0}, {3, 0}, {.walls = true});
    ASSERT_TRUE(end);
    EXPECT_TRUE(end->at_wall());
    EXPECT_EQ(end->shape, 0u);
    EXPECT_NEAR(end->fraction, 0.5, 1e-15);
    EXPECT_NEAR(world.cast_shape(Disc{.radius = 0.5}, {{0.5, 0}, 0}, {2, 0}, {.walls = true})->fraction, 0.5, 1e-15);
}

TEST(Queries, BoundsOfABodyAreThoseOfAllItsShapes) {
    World world({.solver = SoftStep{}});
    const BodyId point = world.add(Body{.position = {7, 8}}), disc = world.add(Body{.position = {1, 2}, .radius = 0.5});
    const BodyId many = world.add(
        Body{.kind = Kind::fixed,
             .position = {10, 0},
             .angle = 1.5707963267948966,
             .shapes = {{.geometry = Box{.width = 4, .height = 2}}, {.geometry = Disc{{3, 0}, 0.5}, .sensor = true}}});
    const auto expect_box = [&](BodyId id, Vec2 low, Vec2 high) {
        EXPECT_LT(length(world.bounds(id).low - low), 1e-14);
        EXPECT_LT(length(world.bounds(id).high - high), 1e-14);
    };
    expect_box(point, {7, 8}, {7, 8});
    expect_box(disc, {0.5, 1.5}, {1.5, 2.5});
    expect_box(many, {9, -2}, {11, 3.5});
    world.set_position(disc, {0, 0}, 0);
    expect_box(disc, {-0.5, -0.5}, {0.5, 0.5});
    world.remove(point);
    expect_box(many, {9, -2}, {11, 3.5});
    EXPECT_EQ(error_of([&] { world.bounds(point); }),
              "BodyId is stale: body 0 (generation 1) was removed from this world");
}

/// The frame of a body is that of what the world tells of its shapes, about their centre of mass.
TEST(Queries, PointsOfABodyHaveAPlaceInTheWorld) {
    World world({.solver = SoftStep{}});
    const std::vector<Shape> shapes{{.geometry = Box{.width = 2, .height = 1, .centre = {1, 0}}}};
    const BodyId moves = world.add(Body{.position = {3, 4}, .angle = 1.5707963267948966, .shapes = shapes}),
                 stays = world.add(Body{.kind = Kind::fixed, .position = {3, 4}, .shapes = shapes});
    EXPECT_LT(length(world.position(moves) - Vec2{3, 5}), 1e-15);
    EXPECT_EQ(world.position(stays), (Vec2{3, 4}));
    const Pose pose = world.pose(moves);
    EXPECT_EQ(pose.position, world.position(moves));
    EXPECT_EQ(pose.angle, world.angle(moves));
    EXPECT_LT(length(to_world(pose, {1, 0.5}) - Vec2{2.5, 6}), 1e-15);  // a corner
    EXPECT_LT(length(to_body(pose, {2.5, 6}) - Vec2{1, 0.5}), 1e-15);
    EXPECT_EQ(to_body({{1, 2}, 0}, to_world({{1, 2}, 0}, {3, 4})), (Vec2{3, 4}));
    world.remove(moves);
    EXPECT_EQ(error_of([&] { world.pose(moves); }),
              "BodyId is stale: body 0 (generation 1) was removed from this world");
}

TEST(Queries, OfARestoredWorld) {
    const auto make = [] {
        World world({.solver = SoftStep{}});
        world.add(Body{.velocity = {1, 0}, .radius = 0.5});
        return world;
    };
    World world = make(), again = make();
    world.step(1);
    Body wide = world.body(world.ids()[0]);
    wide.radius = 2;
    world.set(world.ids()[0], wide);
    EXPECT_EQ(again.shapes_at({0, 0}).size(), 1u);
    test::restore_from(world, again);
    EXPECT_EQ(again.shapes_at({-0.9, 0}).size(), 1u);
    EXPECT_EQ(again.shapes_at({-1.1, 0}).size(), 0u);
    EXPECT_EQ(again.shapes_at({2.9, 0}).size(), 1u);
}

TEST(Queries, ChangeNothing) {
    for (const Solver& solver : askable) {
        const auto run_it = [&](bool asks) {
            Random random(3);
            World world({.gravity = {0, -9.81}, .solver = solver});
            world.add(HalfPlane{});
            const auto ask = [&] {
                if (asks) world.cast_ray({0, 5}, {1, -9}), world.shapes_in_box({-1, -1}, {1, 1});
            };
            for (int n = 0; n < 8; ++n) {
                world.add(Body{.position = {random.uniform(-1, 1), 0.3 + 0.7 * n},
                               .velocity = {random.uniform(-1, 1), 0},
                               .mass = random.uniform(0.1, 3),
                               .radius = 0.3});
                ask();
            }
            for (int n = 0; n < 60; ++n) world.step(1.0 / 60), ask();
            const Energy e = energy(world);
            std::string bits(reinterpret_cast<const char*>(&e), sizeof e);
            return bits + std::to_string(state_hash(world));
        };
        EXPECT_EQ(run_it(true), run_it(false));
    }
}

TEST(Queries, SayWhatIsWrong) {
    World world;
    const BodyId a = world.add(Body{.radius = 1}), b = world.add(Body{.position = {3, 0}, .radius = 1});
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(error_of([&] {
                  world.cast_ray({none, 0}, {1, 0});
              }),
              "World::cast_ray: origin.x must be a finite number in m, got nan");
    EXPECT_EQ(error_of([&] { world.cast_ray({0, 0}, {0, 0}); }), "World::cast_ray: way must not be (0, 0)");
    // It met nothing.
    EXPECT_EQ(error_of([&] {
                  world.cast_ray({-5, 0}, {1e300, 0});
              }),
              "World::cast_ray: way must be shorter than 1e154 m, got (1e+300, 0)");
    EXPECT_EQ(error_of([&] {
                  world.cast_ray_through({0, 0}, {1, HUGE_VAL});
              }),
              "World::cast_ray_through: way.y must be a finite number in m, got inf");
    EXPECT_EQ(error_of([&] {
                  world.cast_ray({0, 0}, {1, 0}, {.filter = Filter{.category = -1}});
              }),
              "World::cast_ray: sought.filter.category must be a whole number from 0 to 2147483647, got -1");
    EXPECT_EQ(error_of([&] {
                  world.cast_shape(Disc{.radius = -1}, {}, {1, 0});
              }),
              "World::cast_shape: shape.radius must be a number > 0 in m, got -1");
    EXPECT_EQ(error_of([&] {
                  world.cast_shape(Disc{}, {{0, 0}, none}, {1, 0});
              }),
              "World::cast_shape: angle must be a finite number in rad, got nan");
    EXPECT_EQ(error_of([&] {
                  world.shapes_touching(Segment{{1, 1}, {1, 1}}, {});
              }),
              "Segment.b must be another point than a, got (1, 1)");
    EXPECT_EQ(error_of([&] {
                  world.shapes_in_box({0, 1}, {1, 0});
              }),
              "World::shapes_in_box: high must not lie left of or below low (0, 1) [m], got (1, 0)");
    EXPECT_EQ(error_of([&] {
                  world.shapes_at({0, none});
              }),
              "World::shapes_at: point.y must be a finite number in m, got nan");
    EXPECT_EQ(error_of([&] { world.closest_points(a, a); }), "World::closest_points: b must be another body than a");
    world.remove(b);
    const std::string stale = "BodyId is stale: body 1 (generation 1) was removed from this world";
    EXPECT_EQ(error_of([&] { world.closest_points(a, b); }), stale);
    EXPECT_EQ(error_of([&] { world.shapes_at({0, 0}, {.except = b}); }), "World::shapes_at: sought.except: " + stale);
}
