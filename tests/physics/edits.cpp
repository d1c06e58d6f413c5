// A world that is changed while it runs: what comes of it is what the laws say of the world as it is then, and the
// books close over every change.

#include "error_of.hpp"
#include "physics/contacts.hpp"

namespace carom::test {
namespace {

/// Rounding of so many steps of numbers of this size.
void expect_books_close(const World& world, double size) {
    const Momentum left = momentum_balance(world).unaccounted();
    EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-12 * size);
    EXPECT_NEAR(left.linear.x, 0, 1e-12 * size);
    EXPECT_NEAR(left.linear.y, 0, 1e-12 * size);
    EXPECT_NEAR(left.angular, 0, 1e-12 * size);
}

template <class Change>
void change(World& world, BodyId id, Change make) {
    Body body = world.body(id);
    make(body);
    world.set(id, body);
}

TEST(SetBody, ForcesMoveItByItsNewMass) {
    World world;
    const BodyId id = world.add(Body{.mass = 1});
    world.add(ConstantForce{.body = id, .force = {6, 0}});
    run(world, 1, 0.01);
    change(world, id, [](Body& b) { b.mass = 3; });
    run(world, 1, 0.01);
    EXPECT_NEAR(world.velocity(id).x, 6 + 2, 1e-12);                // F t/m before and after
    EXPECT_NEAR(world.position(id).x, 3 + 6 + 1, 1e-12);            // ½ a t² + v t + ½ a' t²
    EXPECT_NEAR(energy(world).initial_total, 0.5 * 2 * 36, 1e-12);  // two more kilograms at 6 m/s were given
    expect_books_close(world, 100);
}

TEST(SetBody, BooksCloseOverEveryChange) {
    World world = floor_world(0.5);
    std::vector<BodyId> ids;
    for (int i = 0; i < 4; ++i) ids.push_back(world.add(disc({0.9 * i, 2}, 0.4, 0.3, 0.5)));
    world.add(
        Spring{.a = ids[0], .b = ids[1], .anchor_a = {0.1, 0.1}, .stiffness = 50, .rest_length = 1, .damping = 1});
    world.add(Attraction{.strength = 0.1, .softening = 0.5});
    world.add(ConstantForce{.body = ids[2], .force = {1, 2}, .torque = 0.1});
    world.add(Joint{.a = ids[2], .b = ids[3], .type = DistanceJoint{}});
    pass(world, 0.5);
    change(world, ids[0], [](Body& b) { b.mass = 7, b.moment_of_inertia = 0.3; });
    pass(world, 0.5);
    change(world, ids[1], [](Body& b) { b.radius = 0.2, b.velocity = {3, -1}, b.position.y += 0.5; });
    change(world, ids[2], [](Body& b) { b.kind = Kind::driven; });
    pass(world, 0.5);
    change(world, ids[2], [](Body& b) { b.kind = Kind::fixed, b.velocity = {}, b.angular_velocity = 0; });
    pass(world, 0.5);
    change(world, ids[2], [](Body& b) { b.kind = Kind::dynamic, b.charge = 2, b.name = "third"; });
    pass(world, 0.5);
    expect_books_close(world, 1000);  // some 100 J and as much that came and went, in 150 steps of 4 substeps
    EXPECT_EQ(world.find("third"), ids[2]);
}

// A pendulum does not know its mass: one that gets another goes on as if nothing had happened.
TEST(SetBody, APendulumOfAnotherMassGoesOnAsBefore) {
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    const BodyId bob = world.add(disc({1, 0}, 0.1));
    const JointId pin = world.add(Joint{.b = bob, .at = Vec2{}, .type = RevoluteJoint{}});
    pass(world, 1);
    World other = world;
    change(other, bob, [](Body& b) { b.mass = 5, b.moment_of_inertia.reset(); });
    pass(world, 3), pass(other, 3);
    EXPECT_NEAR(length(world.position(bob) - other.position(bob)), 0, 1e-9);  // what is left of a solve for a joint
    EXPECT_NEAR(length(other.reaction(pin).force), 5 * length(world.reaction(pin).force), 1e-6);
    expect_books_close(other, 100);
}

// A plate hangs by a pin in its corner. When a second one is welded to it, its centre is elsewhere, and the pin is
// where it was: in the same point of the first plate.
TEST(SetBody, WhatHoldsOnToItsShapesHoldsTheSamePoint) {
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    Body plate = box({0.5, -0.5}, 1, 1, 0);
    plate.shapes[0].density = 1;
    const BodyId id = world.add(plate);
    const JointId pin = world.add(Joint{.b = id, .at = Vec2{}, .type = RevoluteJoint{}});
    const BodyId wall = world.add(Body{.kind = Kind::fixed, .position = {3, 0}});
    world.add(Spring{.a = wall, .b = id, .anchor_b = {0.5, 0.5}, .stiffness = 5});
    pass(world, 0.3);
    const double stretched = energy(world).spring;
    change(world, id, [](Body& b) {
        b.shapes.push_back({.geometry = Box{.width = 1, .height = 1, .centre = {0, -1}}, .density = 1.});
        b.moment_of_inertia.reset();
    });
    EXPECT_NEAR(world.body(id).mass, 2, 1e-12);
    EXPECT_NEAR(*world.body(id).moment_of_inertia, 2 * (1 + 4) / 12.0, 1e-12);  // of a plate of 1 m × 2 m
    EXPECT_NEAR(energy(world).spring, stretched, 1e-12);
    world.step(frame);
    EXPECT_LT(world.reaction(pin).gap, 1e-9);  // what a solve for a joint leaves; it would be half a metre
    pass(world, 3);
    EXPECT_LT(world.reaction(pin).gap, 1e-9);
    expect_books_close(world, 100);
}

TEST(SetBody, WhoRestsOnWhatBecomesSlipperySlides) {
    constexpr double slope = 0.3;
    World world({.gravity = {g * std::sin(slope), -g * std::cos(slope)}, .solver = SoftStep{}});
    const BodyId plank = world.add([] {
        Body body = box({0, -0.5}, 100, 1, 1);
        body.kind = Kind::fixed;
        return body;
    }());
    const BodyId crate = world.add(box({0, 0.5}, 1, 1, 1));
    pass(world, 5);
    ASSERT_TRUE(world.asleep(crate));
    change(world, plank, [](Body& b) { b.friction = 0; });
    const double from = world.position(crate).x;
    pass(world, 1);
    // The first step still feels friction's force of the last one, which is taken back in the same step.
    EXPECT_NEAR(world.velocity(crate).x, g * std::sin(slope), 1e-3 * g);
    EXPECT_NEAR(world.position(crate).x - from, 0.5 * g * std::sin(slope), 0.02 * g);
    expect_books_close(world, 100);
}

TEST(SetBody, WhatLosesItsSupportFalls) {
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    Body support = box({0, -0.5}, 1, 1, 0.5);
    support.kind = Kind::fixed;
    const BodyId id = world.add(support), crate = world.add(box({0, 0.5}, 1, 1, 0.5));
    pass(world, 5);
    ASSERT_TRUE(world.asleep(crate));
    World narrow = world, loose = world, ghost = world;
    change(narrow, id, [](Body& b) { b.shapes[0].geometry = Box{.width = 0.1, .height = 0.1}; });
    change(loose, id, [](Body& b) { b.kind = Kind::dynamic; });
    change(ghost, id, [](Body& b) { b.shapes[0].sensor = true; });
    for (World* each : {&narrow, &loose, &ghost}) {
        const double height = each->position(crate).y;
        pass(*each, 0.3);
        EXPECT_NEAR(height - each->position(crate).y, 0.5 * g * 0.09, 1e-3);  // free fall, but for the first substeps
    }
}

TEST(SetBody, WhoSleepsOnAnotherFallsWhenThatIsMadeSmaller) {
    World world = floor_world(0.5);
    add_stack(world, 2);
    const BodyId below = world.ids()[0], above = world.ids()[1];
    pass(world, 10);
    ASSERT_TRUE(world.asleep(above));
    change(world, below, [](Body& b) { b.shapes[0].geometry = Box{.width = 0.1, .height = 0.1}; });
    const double height = world.position(above).y;
    pass(world, 0.3);
    EXPECT_NEAR(height - world.position(above).y, 0.5 * g * 0.09, 1e-3);
}

TEST(SetBody, WhatIsDrivenNoMoreFliesOn) {
    World world;
    const BodyId id = world.add(Body{.kind = Kind::driven});
    world.drive(id, [](double t) { return Pose{{2 * t, 0}, 0}; });
    run(world, 1, 0.01);
    change(world, id, [](Body& b) { b.mass = 4; });
    EXPECT_TRUE(world.follows_curve(id));
    change(world, id, [](Body& b) { b.kind = Kind::dynamic; });
    EXPECT_FALSE(world.follows_curve(id));
    world.add(ConstantForce{.body = id, .force = {0, 8}});
    run(world, 1, 0.01);
    EXPECT_NEAR(world.position(id).x, 4, 1e-9);  // the velocity is a difference of the curve
    EXPECT_NEAR(world.position(id).y, 1, 1e-12);
}

TEST(SetBody, AnExactGasGoesOnWithAHeavierDisc) {
    World world({.solver = Events{}});
    world.add(Rectangle{.low = {0, 0}, .high = {4, 4}});
    for (int i = 0; i < 9; ++i)
        world.add(Body{.position = {0.7 + i % 3, 0.7 + i / 3}, .velocity = {1.0 - i, 0.3 * i}, .radius = 0.2});
    run(world, 2, 0.1);
    const BodyId id = world.ids()[4];
    change(world, id, [](Body& b) { b.mass = 6, b.radius = 0.1; });
    const double kinetic = energy(world).kinetic;
    run(world, 5, 0.1);
    EXPECT_NEAR(energy(world).kinetic, kinetic, 1e-12 * kinetic);
    EXPECT_GT(world.collisions(), 50u);
    expect_books_close(world, 1000);
}

TEST(SetBody, AnErrorLeavesAllAsItWas) {
    World world({.solver = SoftStep{}});
    const BodyId a = world.add(Body{.velocity = {1, 0}, .radius = 0.1, .name = "a"});
    const BodyId b = world.add(Body{.position = {2, 0}, .radius = 0.1, .name = "b"});
    world.add(Joint{.name = "pin", .b = a, .at = Vec2{}, .type = RevoluteJoint{}});
    const auto hash = state_hash(world);
    const auto error = [&](BodyId id, auto make) { return error_of([&] { change(world, id, make); }); };
    EXPECT_EQ(error(b, [](Body& body) { body.name = "a"; }),
              "Body 'a'.name must be unique, and there is a body 'a' already");
    EXPECT_EQ(error(b, [](Body& body) { body.mass = 0; }), "Body 'b'.mass must be a number > 0 in kg, got 0");
    EXPECT_EQ(error(a, [](Body& body) { body.kind = Kind::fixed; }),
              "Body 'a'.velocity must be 0 for a fixed body (a driven one keeps a velocity)");
    EXPECT_EQ(error(a, [](Body& body) { body.kind = Kind::driven; }),
              "Body.kind must be dynamic: Joint 'pin' holds the body and no other dynamic one");
    EXPECT_EQ(error(b, [](Body& body) { body.shapes = {{}}; }),
              "Body 'b' is wrong: Body.radius must be 0 for a body with shapes, got 0.1 m");
    EXPECT_EQ(state_hash(world), hash);
    EXPECT_EQ(world.find("b"), b);
    world.remove(b);
    EXPECT_NE(error_of([&] { world.set(b, Body{}); }).find("stale"), std::string::npos);
    EXPECT_EQ(error_of([&] { change(world, a, [](Body& body) { body.name = "c"; }); }), "no error");
    EXPECT_EQ(world.find("c"), a);
    EXPECT_NE(error_of([&] { world.find("a"); }).find("there is no body 'a'"), std::string::npos);
}

TEST(SetBody, ARestoredWorldGoesOnWithTheSameBits) {
    World start = floor_world(0.5);
    for (int i = 0; i < 3; ++i) start.add(disc({0.3 * i, 0.5 + i}, 0.4, 0.3, 0.5));
    const BodyId driven = start.add(Body{.kind = Kind::driven, .position = {5, 0}, .radius = 0.3});
    start.drive(driven, [](double t) { return Pose{{5, t}, 0}; });
    World world = start;
    pass(world, 1);
    change(world, start.ids()[1], [](Body& b) { b.mass = 3, b.radius = 0.2; });
    change(world, driven, [](Body& b) { b.kind = Kind::dynamic; });
    pass(world, 1);
    restore_from(world, start);
    pass(world, 2), pass(start, 2);
    EXPECT_EQ(state_hash(start), state_hash(world));
    EXPECT_EQ(energy(start).residual, energy(world).residual);
    EXPECT_FALSE(start.follows_curve(driven));
}

TEST(Forces, OneThatIsTakenAwayTakesItsEnergyWithIt) {
    World world;
    const BodyId a = world.add(Body{.kind = Kind::fixed}), b = world.add(Body{.position = {3, 0}, .mass = 2});
    const auto strong = world.add(Spring{.a = a, .b = b, .stiffness = 8, .rest_length = 1});
    const auto weak = world.add(Spring{.a = a, .b = b, .stiffness = 2});
    const double before = energy(world).total();
    EXPECT_EQ(before, 0.5 * 8 * 4 + 0.5 * 2 * 9);
    world.remove(strong);
    EXPECT_NEAR(energy(world).total(), 9, 1e-12);
    EXPECT_NEAR(energy(world).initial_total, 9, 1e-12);
    EXPECT_EQ(world.springs().size(), 1u);
    EXPECT_FALSE(world.contains(strong));
    Spring other = world.force(weak);
    other.stiffness = 8;
    world.set(weak, other);
    EXPECT_NEAR(energy(world).initial_total, 36, 1e-12);
    // ω = 2 /s: after a quarter of a period it passes the centre, to the second order of Verlet with ω h = 0.002.
    constexpr double pi = 3.14159265358979324;
    run(world, pi / 4, 0.001);
    EXPECT_NEAR(world.position(b).x, 0, 1e-5);
    EXPECT_NEAR(world.velocity(b).x, -6, 1e-5);
    expect_books_close(world, 100);
}

TEST(Forces, KeepTheirIdsAndLoseThemOnce) {
    World world;
    std::vector<BodyId> bodies;
    for (int i = 0; i < 4; ++i) bodies.push_back(world.add(Body{.position = {1.0 * i, 0}}));
    std::vector<ForceId<Spring>> springs;
    for (int i = 0; i < 3; ++i)
        springs.push_back(world.add(Spring{.a = bodies[i], .b = bodies[i + 1], .stiffness = 10.0 + i}));
    const auto drag = world.add(Drag{.body = bodies[3]});
    const auto pull = world.add(Attraction{.strength = 1, .softening = 1});
    world.remove(springs[0]);
    EXPECT_EQ(world.force(springs[2]).stiffness, 12);
    world.remove(bodies[3]);
    EXPECT_FALSE(world.contains(springs[2]));
    EXPECT_FALSE(world.contains(drag));
    EXPECT_TRUE(world.contains(springs[1]));
    EXPECT_EQ(world.springs().size(), 1u);
    EXPECT_EQ(world.force_id<Spring>(0), springs[1]);
    const auto next = world.add(Spring{.a = bodies[0], .b = bodies[2], .stiffness = 20});
    EXPECT_EQ(world.force(next).stiffness, 20);
    EXPECT_NE(next, springs[2]);
    world.remove(pull);
    EXPECT_TRUE(world.attractions().empty());
    EXPECT_EQ(error_of([&] { world.remove(springs[2]); }),
              "ForceId is stale: Spring 3 was removed from this world, or a body of it");
    EXPECT_EQ(error_of([&] { world.remove(pull); }), "ForceId is stale: Attraction 1 was removed from this world");
    EXPECT_EQ(error_of([&] { world.force(ForceId<Drag>{7}); }),
              "ForceId must come from World::add of this world, got one that no Drag ever had");
    EXPECT_EQ(error_of([&] { world.set(next, Spring{.a = bodies[0], .b = bodies[0]}); }),
              "Spring.b must be another body than a");
    EXPECT_EQ(error_of([&] { world.force_id<Spring>(2); }), "place must be below 2, the number of Springs, got 2");
    EXPECT_EQ(world.force(next).b, bodies[2]);
}

// F t = m v: a thrust for half a second, doubled for another half, and gone.
TEST(Forces, AThrustForSomeTimeGivesItsImpulse) {
    World world = floor_world(0);
    const BodyId id = world.add(box({0, 0.5}, 1, 1, 0, 2));
    const BodyId far = world.add(box({50, 0.5}, 1, 1, 0.5));
    pass(world, 5);
    ASSERT_TRUE(world.asleep(id) && world.asleep(far));
    const auto thrust = world.add(ConstantForce{.body = id, .force = {4, 0}});
    EXPECT_FALSE(world.asleep(id));
    EXPECT_TRUE(world.asleep(far)) << "nothing was done to it";
    pass(world, 0.5);
    EXPECT_NEAR(world.velocity(id).x, 1, 1e-9);
    ConstantForce twice = world.force(thrust);
    twice.force.x = 8;
    world.set(thrust, twice);
    pass(world, 0.5);
    world.remove(thrust);
    pass(world, 1);
    EXPECT_NEAR(world.velocity(id).x, 3, 1e-9);
    expect_books_close(world, 100);
}

TEST(Walls, WhoRestsOnOneThatIsTakenAwayFalls) {
    World world({.gravity = {0, -g}, .solver = SoftStep{}});
    const auto below = world.add(HalfPlane{.point = {0, -1}});
    const auto floor = world.add(HalfPlane{});
    const BodyId crate = world.add(box({0, 0.5}, 1, 1, 0.5));
    pass(world, 5);
    ASSERT_TRUE(world.asleep(crate));
    // The wall below is taken away: the floor has another number now, and bears the crate as before.
    World other = world;
    const double height = other.position(crate).y;
    other.remove(below);
    for (int step = 0; step < 10; ++step) {
        other.step(frame);
        EXPECT_TRUE(other.events().begins.empty() && other.events().ends.empty() && other.events().impacts.empty());
        EXPECT_NEAR(other.position(crate).y, height, 1e-9);
    }
    ASSERT_EQ(other.contacts().size(), 2u);
    EXPECT_EQ(other.contacts()[0].shapes.a.shape, 0u);
    // A room put around it all comes before the half-planes.
    other.add(Rectangle{.low = {-10, -10}, .high = {10, 10}});
    other.step(frame);
    EXPECT_TRUE(other.events().begins.empty() && other.events().ends.empty() && other.events().impacts.empty());
    EXPECT_EQ(other.contacts()[0].shapes.a.shape, 4u);

    world.remove(floor);
    EXPECT_FALSE(world.contains(floor));
    EXPECT_TRUE(world.contains(below));
    world.step(frame);
    ASSERT_EQ(world.events().ends.size(), 1u);
    EXPECT_EQ(world.events().ends[0].a.shape, 1u);
    pass(world, 0.2);
    EXPECT_NEAR(height - world.position(crate).y, 0.5 * g * std::pow(0.2 + frame, 2), 1e-3);
    expect_books_close(world, 100);
}

TEST(Walls, OneThatIsChangedIsTheWallThatItIsNow) {
    World world({.gravity = {0, -g}});
    const auto floor = world.add(HalfPlane{});
    const auto room = world.add(Rectangle{.low = {-5, -5}, .high = {5, 5}});
    const BodyId ball = world.add(disc({0, 1.1}, 0.1, 0, 1));
    EXPECT_EQ(world.wall(room).high.x, 5);
    HalfPlane softer = world.wall(floor);
    softer.side.restitution = 0.5;
    world.set(floor, softer);
    double highest = 0;
    run(world, 2 * std::sqrt(2 / g), 0.001, [&](const World& w) {
        if (w.collisions() == 1) highest = std::max(highest, w.position(ball).y);
    });
    EXPECT_NEAR(highest, 0.1 + 0.25, 1e-5);  // e² of the height; the apex lies between steps of a millisecond
    EXPECT_EQ(error_of([&] {
                  world.set(room, Rectangle{.low = {0, 0}, .high = {0, 1}});
              }),
              "Rectangle.high must lie above and right of low (0, 0) [m], got (0, 1)");
    world.remove(room);
    EXPECT_EQ(error_of([&] { world.wall(room); }), "WallId is stale: Rectangle 1 was removed from this world");
    expect_books_close(world, 100);
}

// J at a point: v = J/m, ω = r × J/I, and the work J·(v + v')/2 of the point is the user's.
TEST(Impulse, MovesAndTurnsByItsLaw) {
    World world;
    const BodyId id = world.add({.position = {2, 1},
                                 .velocity = {1, -1},
                                 .angular_velocity = 0.5,
                                 .mass = 2,
                                 .moment_of_inertia = 0.8,
                                 .radius = 1});
    run(world, 0.5, 0.1);
    const Vec2 x = world.position(id), J{3, 4}, r{0.5, -0.25};
    const double spin = r.x * J.y - r.y * J.x;
    const double before = energy(world).total();
    world.apply_impulse(id, J, x + r);
    EXPECT_NEAR(world.velocity(id).x, 1 + J.x / 2, 1e-14);
    EXPECT_NEAR(world.velocity(id).y, -1 + J.y / 2, 1e-14);
    EXPECT_NEAR(world.angular_velocity(id), 0.5 + spin / 0.8, 1e-14);
    EXPECT_NEAR(energy(world).work.user, energy(world).total() - before, 1e-13);
    EXPECT_NEAR(momentum_balance(world).user.linear.x, J.x, 1e-14);
    EXPECT_NEAR(momentum_balance(world).user.angular, cross(x + r, J), 1e-13);
    EXPECT_NEAR(energy(world).initial_total, before, 1e-14);
    world.apply_angular_impulse(id, -0.4);
    EXPECT_NEAR(world.angular_velocity(id), 0.5 + spin / 0.8 - 0.5, 1e-14);
    expect_books_close(world, 10);
}

TEST(Impulse, OneTooLargeForNumbersIsAnErrorAndGivesNothing) {
    World world;
    const BodyId id = world.add({.velocity = {1, 0}, .radius = 1});
    EXPECT_EQ(error_of([&] {
                  world.apply_impulse(id, {1e200, 0}, {});
              }),
              "an impulse on the body must do work that a number can hold [J], got inf");
    EXPECT_NE(error_of([&] { world.apply_angular_impulse(id, 1e300); }), "no error");
    EXPECT_EQ(world.velocity(id), (Vec2{1, 0}));
    EXPECT_EQ(world.angular_velocity(id), 0);
    EXPECT_EQ(energy(world).work.user, 0);
}

TEST(Impulse, IsNoneOfTheEditsAroundIt) {
    World world({.gravity = {0, -g}});
    const BodyId id = world.add(Body{.mass = 2}), point = world.add(Body{.position = {1, 0}, .angular_velocity = 3});
    world.apply_impulse(id, {4, 0}, {0, 0});
    change(world, id, [](Body& b) { b.mass = 4; });
    world.apply_impulse(id, {4, 0}, {0, 0});
    world.apply_impulse(point, {0, 2}, {2, 0});
    world.set_velocity(id, {7, 0}, 0);
    EXPECT_NEAR(energy(world).work.user, 0.5 * 2 * 4 + (4 * 2 + 4 * 0.5) + (0.5 * 4 + 2 * 3), 1e-12);
    EXPECT_NEAR(energy(world).initial_total, 0.5 * 2 * 4 + (0.5 * 4 * (49 - 9)), 1e-12);
    EXPECT_EQ(world.angular_velocity(point), 3) << "a point has no moment of inertia";
    run(world, 1, 0.01);
    expect_books_close(world, 1000);
}

TEST(Impulse, ServesEverySolverAndWakes) {
    for (const Solver& solver : {Solver{Impulse{}}, Solver{NoContact{}}, Solver{SoftStep{}}, Solver{Events{}}}) {
        World world({.solver = solver});
        world.add(Rectangle{.low = {-5, -5}, .high = {5, 5}});
        const BodyId id = world.add(disc({0, 0}, 0.5, 0, 1));
        Body other = disc({3, 0}, 0.5, 0, 1);
        other.velocity = {0, 1};
        world.add(other);
        run(world, 1, 0.01);
        world.apply_impulse(id, {2, 0}, world.position(id));
        run(world, 3.5, 0.01);
        EXPECT_NEAR(energy(world).kinetic, 2 + 0.5, 1e-9);
        EXPECT_NEAR(energy(world).work.user, 2, 1e-12);
        expect_books_close(world, 10);
    }
    World world = floor_world(0.5);
    const BodyId id = world.add(box({0, 0.5}, 1, 1, 0.5)),
                 fixed = world.add(Body{.kind = Kind::fixed, .position = {9, 9}});
    pass(world, 3);
    ASSERT_TRUE(world.asleep(id));
    world.apply_impulse(id, {0, 3}, world.position(id));
    EXPECT_FALSE(world.asleep(id));
    pass(world, 3 / g);
    EXPECT_NEAR(world.position(id).y, 0.5 + 9 / (2 * g), 1e-2);  // half a step of the way up is 2 cm at most
    EXPECT_EQ(error_of([&] {
                  world.apply_impulse(fixed, {1, 0}, {});
              }),
              "World::apply_impulse: body number 1 must be dynamic");
    EXPECT_EQ(error_of([&] {
                  world.apply_impulse(id, {NAN, 0}, {});
              }),
              "World::apply_impulse: impulse.x must be a finite number in N s, got nan");
}

}  // namespace
}  // namespace carom::test
