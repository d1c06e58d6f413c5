#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "error_of.hpp"
#include "state/nearest.hpp"

using namespace carom;
using test::error_of;

namespace {

std::string error_of_body(const Body& body) {
    return error_of([&] { World().add(body); });
}

}  // namespace

TEST(BodyIds, OutliveTheRemovalOfOthers) {
    World world;
    std::vector<BodyId> ids;
    for (int i = 0; i < 5; ++i) ids.push_back(world.add(Body{.position = {double(i), 0}, .mass = 1 + double(i)}));
    world.remove(ids[1]);
    ASSERT_EQ(world.size(), 4u);
    EXPECT_EQ(world.ids()[1], ids[4]);  // the last row filled the hole
    for (const int i : {0, 2, 3, 4}) {
        EXPECT_EQ(world.position(ids[i]).x, i);
        EXPECT_EQ(world.body(ids[i]).mass, 1 + i);
    }
    for (std::size_t row = 0; row < world.size(); ++row)
        EXPECT_EQ(world.position(world.ids()[row]), world.positions()[row]);
}

TEST(BodyIds, AreNeverTakenForTheNextTenant) {
    World world;
    const BodyId gone = world.add(Body{});
    world.remove(gone);
    const BodyId tenant = world.add(Body{.position = {3, 0}});
    EXPECT_EQ(tenant.index, gone.index);
    EXPECT_NE(tenant, gone);
    EXPECT_TRUE(world.contains(tenant));
    EXPECT_FALSE(world.contains(gone));
    EXPECT_EQ(error_of([&] { world.position(gone); }),
              "BodyId is stale: body 0 (generation 1) was removed from this world");
    EXPECT_EQ(error_of([&] { world.remove(gone); }), error_of([&] { world.position(gone); }));
    EXPECT_EQ(error_of([&] { world.add(Spring{.a = tenant, .b = gone}); }),
              "Spring.b: " + error_of([&] { world.position(gone); }));
    EXPECT_EQ(error_of([&] { world.position(BodyId{}); }),
              "BodyId must come from World::add of this world, got one that no body ever had");
}

TEST(BodyIds, SurviveAnyOrderOfAddingAndRemoving) {
    World world;
    Random random(1);
    std::vector<std::pair<BodyId, double>> alive;
    for (int n = 0; n < 3000; ++n) {
        if (alive.empty() || random.uniform() < 0.55) {
            alive.emplace_back(world.add(Body{.position = {double(n), 0}}), n);
        } else {
            const auto i = static_cast<std::size_t>(random.uniform() * double(alive.size()));
            world.remove(alive[i].first);
            alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(i));
        }
        ASSERT_EQ(world.size(), alive.size());
    }
    for (const auto& [id, x] : alive) EXPECT_EQ(world.position(id).x, x);
}

TEST(BodyIds, KeepTheirShapesWhenRowsMove) {
    World world;
    std::vector<BodyId> ids;
    for (int i = 0; i < 4; ++i) {
        Body body;
        for (int n = 0; n < i; ++n) body.shapes.push_back({.geometry = Disc{.radius = 1.0 + i}});
        ids.push_back(world.add(body));
    }
    world.remove(ids[1]);
    for (const int i : {0, 2, 3}) {
        const std::vector<Shape> shapes = world.body(ids[i]).shapes;
        ASSERT_EQ(shapes.size(), static_cast<std::size_t>(i));
        if (i > 0) {
            EXPECT_EQ(std::get<Disc>(shapes[0].geometry).radius, 1.0 + i);
        }
    }
    EXPECT_EQ(world.shapes()[1].size(), 3u);  // the last row filled the hole
}

TEST(Names, FindTheirBodyAndSuggestTheNearest) {
    World world;
    const BodyId moon = world.add(Body{.name = "moon"});
    world.add(Body{});
    EXPECT_EQ(world.find("moon"), moon);
    EXPECT_EQ(error_of([&] { world.find("mooon"); }), "there is no body 'mooon'; did you mean 'moon'?");
    EXPECT_EQ(error_of([&] { world.find("jupiter"); }), "there is no body 'jupiter'");
    EXPECT_EQ(error_of([&] { world.add(Body{.name = "moon"}); }),
              "Body 'moon'.name must be unique, and there is a body 'moon' already");
    world.remove(moon);
    EXPECT_EQ(error_of([&] { world.find("moon"); }), "there is no body 'moon'");
    EXPECT_NO_THROW(world.add(Body{.name = "moon"}));  // the name is free again
}

TEST(Names, AreComparedByLettersToChange) {
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // Levenshtein's own example
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
    EXPECT_EQ(edit_distance("abc", "abc"), 0u);
}

TEST(Validation, NamesFieldValueUnitAndWhatIsAllowed) {
    EXPECT_EQ(error_of_body({.mass = -1}), "Body.mass must be a number > 0 in kg, got -1");
    EXPECT_EQ(error_of_body({.mass = 0}), "Body.mass must be a number > 0 in kg, got 0");
    EXPECT_EQ(error_of_body({.mass = INFINITY}), "Body.mass must be a number > 0 in kg, got inf");
    EXPECT_EQ(error_of_body({.position = {0, NAN}}), "Body.position.y must be a finite number in m, got nan");
    EXPECT_EQ(error_of_body({.moment_of_inertia = -2.}),
              "Body.moment_of_inertia must be a number > 0 in kg m², got -2");
    EXPECT_EQ(error_of_body({.radius = -0.5}), "Body.radius must be a number >= 0 in m, got -0.5");
    EXPECT_EQ(error_of_body({.restitution = 1.5}), "Body.restitution must be a number from 0 to 1, got 1.5");
    EXPECT_EQ(error_of_body({.friction = -1, .name = "b"}), "Body 'b'.friction must be a number >= 0, got -1");
    EXPECT_EQ(error_of_body({.kind = Kind::fixed, .velocity = {1, 0}}),
              "Body.velocity must be 0 for a fixed body (a driven one keeps a velocity)");
    EXPECT_EQ(error_of_body({.kind = static_cast<Kind>(77)}),
              "Body.kind must be a choice that there is, got number 77");
}

TEST(Validation, ReachesIntoShapes) {
    const auto error_of_shapes = [](std::vector<Shape> shapes) {
        return error_of_body({.shapes = std::move(shapes), .name = "b"});
    };
    EXPECT_EQ(error_of_shapes({{}, {.friction = -1.}}), "Body 'b'.shapes[1].friction must be a number >= 0, got -1");
    EXPECT_EQ(error_of_shapes({{.geometry = Box{.width = 0}}}),
              "Body 'b'.shapes[0].width must be a number > 0 in m, got 0");
    EXPECT_EQ(error_of_shapes({{.geometry = Chain{.points = {{0, 0}, {1, NAN}}}}}),
              "Body 'b'.shapes[0].points[1].y must be a finite number in m, got nan");
    EXPECT_EQ(error_of_shapes({{.filter = {.category = -1}}}),
              "Body 'b'.shapes[0].filter.category must be a whole number from 0 to 2147483647, got -1");
    EXPECT_EQ(error_of_shapes({{}, {.geometry = Polygon{.points = {{0, 0}, {1, 0}}}}}),
              "Body 'b'.shapes[1] is wrong: Polygon.points must be at least 3, got 2");
    EXPECT_EQ(error_of_shapes({{.density = 1.}, {}}),
              "Body 'b' is wrong: Shape.density must be given for all shapes of a body or for none, got it for 1 of 2");
    EXPECT_EQ(error_of_body({.radius = 2, .shapes = {{}}}),
              "Body is wrong: Body.radius must be 0 for a body with shapes, got 2 m");
}

TEST(Validation, HoldsAtEveryDoor) {
    World world;
    const BodyId a = world.add(Body{}), b = world.add(Body{});
    const auto adding = [&](const auto& thing) { return error_of([&] { world.add(thing); }); };
    EXPECT_EQ(adding(Spring{.a = a, .b = b, .stiffness = -1}), "Spring.stiffness must be a number >= 0 in N/m, got -1");
    EXPECT_EQ(adding(Spring{.a = a, .b = a}), "Spring.b must be another body than a");
    EXPECT_EQ(adding(TorsionSpring{.a = a, .b = b, .damping = NAN}),
              "TorsionSpring.damping must be a number >= 0 in N m s/rad, got nan");
    EXPECT_EQ(adding(Drag{.linear = -3}), "Drag.linear must be a number >= 0 in N s/m, got -3");
    EXPECT_EQ(adding(Attraction{.softening = -1}), "Attraction.softening must be a number >= 0 in m, got -1");
    EXPECT_EQ(adding(ConstantForce{.body = a, .force = {INFINITY, 0}}),
              "ConstantForce.force.x must be a finite number in N, got inf");
    EXPECT_EQ(adding(Rectangle{.left = {.restitution = 2}}),
              "Rectangle.left.restitution must be a number from 0 to 1, got 2");
    EXPECT_EQ(adding(Rectangle{{0, 0}, {0, 1}}),
              "Rectangle.high must lie above and right of low (0, 0) [m], got (0, 1)");
    EXPECT_EQ(adding(HalfPlane{.normal = {0, 0}}), "HalfPlane.normal must not be (0, 0)");
    EXPECT_EQ(error_of([&] {
                  World({.gravity = {0, NAN}});
              }),
              "Settings.gravity.y must be a finite number in m/s², got nan");
    EXPECT_EQ(error_of([&] { World({.integrator = Adaptive{.tolerance = 0}}); }),
              "Settings.integrator.tolerance must be a number > 0, got 0");
    EXPECT_EQ(error_of([&] { World({.threads = 0}); }),
              "Settings.threads must be a whole number from 1 to 1024, got 0");
    EXPECT_EQ(error_of([&] {
                  world.set_velocity(a, {NAN, 0}, 0);
              }),
              "World::set_velocity: velocity.x must be a finite number in m/s, got nan");
}

TEST(Validation, LeavesTheWorldAsItWas) {
    World world;
    world.add(Body{.name = "only"});
    const auto before = state_hash(world);
    EXPECT_THROW(world.add(Body{.mass = -1, .name = "bad"}), Error);
    EXPECT_THROW(world.find("bad"), Error);
    EXPECT_EQ(world.size(), 1u);
    EXPECT_EQ(state_hash(world), before);
}

TEST(Body, ComesBackAsItWasGiven) {
    World world;
    const Body given{.kind = Kind::driven,
                     .position = {1, 2},
                     .angle = 3,
                     .velocity = {4, 5},
                     .angular_velocity = 6,
                     .mass = 7,
                     .moment_of_inertia = 8.,
                     .radius = 9,
                     .charge = -10,
                     .restitution = 0.11,
                     .friction = 0.12,
                     .name = "it",
                     .colour = Colour{1, 2, 3, 4}};
    const Body back = world.body(world.add(given));
    EXPECT_EQ(back.kind, given.kind);
    EXPECT_EQ(back.position, given.position);
    EXPECT_EQ(back.angle, given.angle);
    EXPECT_EQ(back.velocity, given.velocity);
    EXPECT_EQ(back.angular_velocity, given.angular_velocity);
    EXPECT_EQ(back.mass, given.mass);
    EXPECT_EQ(back.moment_of_inertia, given.moment_of_inertia);
    EXPECT_EQ(back.radius, given.radius);
    EXPECT_EQ(back.charge, given.charge);
    EXPECT_EQ(back.restitution, given.restitution);
    EXPECT_EQ(back.friction, given.friction);
    EXPECT_EQ(back.name, given.name);
    EXPECT_EQ(back.colour, given.colour);
}
