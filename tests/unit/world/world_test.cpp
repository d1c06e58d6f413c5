// A world is a value; its accounts close under whatever is done to it.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "error_of.hpp"

using namespace carom;
using test::error_of;

namespace {

/// Everything at once: springs, drag, attraction, walls, a driven body, collisions with friction.
World busy(const Integrator& integrator, const Solver& solver) {
    World world({.gravity = {0, -9.81}, .integrator = integrator, .solver = solver});
    world.add(Rectangle{.low = {0, 0}, .high = {4, 4}, .bottom = {0.8, 0.3}});
    std::vector<BodyId> discs;
    for (int i = 0; i < 6; ++i)
        discs.push_back(world.add(Body{.position = {0.5 + 0.5 * i, 1 + 0.3 * i},
                                       .velocity = {1.0 - i, 0.5},
                                       .radius = 0.2,
                                       .restitution = 0.9,
                                       .friction = 0.3}));
    world.add(
        Spring{.a = discs[0], .b = discs[3], .anchor_a = {0.1, 0}, .stiffness = 30, .rest_length = 1, .damping = 0.2});
    world.add(TorsionSpring{.a = discs[1], .b = discs[2], .stiffness = 2});
    world.add(Drag{.linear = 0.1, .wind = {0.5, 0}});
    world.add(Attraction{.strength = 0.1, .softening = 0.1});
    const BodyId crank = world.add(Body{.kind = Kind::driven, .position = {2, 3}, .radius = 0.1});
    world.drive(crank, [](double t) { return Pose{{2 + 0.5 * std::sin(t), 3}, t}; });
    world.add(Spring{.a = crank, .b = discs[5], .stiffness = 10, .rest_length = 0.5});
    return world;
}

const Integrator integrators[] = {SymplecticEuler{}, Verlet{}, Pefrl{}, Rk4{}};
const Solver solvers[] = {Impulse{}, Impulse{.time_of_impact = false}, NoContact{}};

}  // namespace

TEST(World, IsMadeOfEmptyBraces) {
    const World world({}), another{{}};
    EXPECT_EQ(world.settings().gravity, Vec2{});
    EXPECT_EQ(another.size(), 0U);
}

TEST(World, CopiedIsASnapshot) {
    for (const Integrator& integrator : integrators)
        for (const Solver& solver : solvers) {
            World world = busy(integrator, solver);
            run(world, 0.5, 1.0 / 120);
            World copy = world;
            const auto then = state_hash(world);
            run(world, 0.5, 1.0 / 120);
            EXPECT_EQ(state_hash(copy), then) << "the copy moved with the original";
            run(copy, 0.5, 1.0 / 120);
            EXPECT_EQ(state_hash(copy), state_hash(world));
            EXPECT_EQ(energy(copy).residual, energy(world).residual);
            EXPECT_EQ(copy.collisions(), world.collisions());
            EXPECT_EQ(copy.time(), world.time());
        }
}

TEST(World, AssignedIsUndo) {
    World world = busy(Verlet{}, Impulse{});
    const World before = world;
    run(world, 0.3, 1.0 / 120);
    const auto first = state_hash(world);
    world = before;
    EXPECT_EQ(world.time(), 0);
    run(world, 0.3, 1.0 / 120);
    EXPECT_EQ(state_hash(world), first);
}

TEST(World, IsMovedWithItsBodies) {
    World world = busy(Verlet{}, Impulse{});
    const auto hash = state_hash(world);
    const World moved = std::move(world);
    EXPECT_EQ(state_hash(moved), hash);
}

TEST(World, GoesOnWithoutABodyThatWasRemoved) {
    World world = busy(Verlet{}, Impulse{});
    run(world, 0.2, 1.0 / 120);
    const BodyId gone = world.ids()[3], other = world.ids()[5];
    const Vec2 x = world.position(other);
    world.remove(gone);
    EXPECT_EQ(world.position(other), x);
    run(world, 0.2, 1.0 / 120);
    EXPECT_EQ(world.size(), 6u);
    EXPECT_EQ(world.springs().size(), 1u);  // its spring went with it
    EXPECT_TRUE(std::isfinite(energy(world).total()));
}

TEST(World, ForgetsTheForcesOfARemovedBodyAtOnce) {
    World world;
    const BodyId a = world.add(Body{}), b = world.add(Body{.position = {1, 0}});
    world.add(Spring{.a = a, .b = b});
    world.add(Drag{.body = b});
    world.add(ConstantForce{.body = b});
    world.remove(b);
    EXPECT_EQ(world.springs().size(), 0u);
    EXPECT_EQ(world.drags().size(), 0u);
    EXPECT_EQ(world.constant_forces().size(), 0u);
}

TEST(World, GivesABodyTheMassOfItsShapes) {
    // A hammer: a handle of 0.04 × 0.4 m at 800 kg/m² and a head of 0.2 × 0.1 m at 7800 kg/m² on top of it.
    const double handle = 0.04 * 0.4 * 800, head = 0.2 * 0.1 * 7800, mass = handle + head;
    const double middle = head * 0.25 / mass;
    const auto box = [](double m, double w, double h, double off) { return m * ((w * w + h * h) / 12 + off * off); };
    World world;
    const BodyId id =
        world.add({.position = {1, 2},
                   .shapes = {{.geometry = Box{.width = 0.04, .height = 0.4}, .density = 800.},
                              {.geometry = Box{.width = 0.2, .height = 0.1, .centre = {0, 0.25}}, .density = 7800.}}});
    const Body body = world.body(id);
    EXPECT_NEAR(body.mass, mass, 1e-12 * mass);
    EXPECT_NEAR(*body.moment_of_inertia, box(handle, 0.04, 0.4, middle) + box(head, 0.2, 0.1, 0.25 - middle),
                1e-12 * mass);
    // It lies where it was put, and turns about its centre of mass.
    EXPECT_NEAR(body.position.y + std::get<Box>(body.shapes[0].geometry).centre.y, 2, 1e-14);
    EXPECT_NEAR(body.position.y, 2 + middle, 1e-14);
    // And another world's equal one does so with the same bits.
    World other;
    const Body again = other.body(other.add(body));
    EXPECT_EQ(again.position, body.position);
    EXPECT_EQ(again.mass, body.mass);
    EXPECT_EQ(again.moment_of_inertia, body.moment_of_inertia);
}

TEST(World, RefusesToCollideShapesByASolverForDiscs) {
    World world;
    world.add({.shapes = {{.geometry = Box{}}}, .name = "crate"});
    EXPECT_NO_THROW(world.step(0.1)) << "alone it meets nothing";
    world.add(HalfPlane{});
    EXPECT_EQ(error_of([&] { world.step(0.1); }),
              "body 'crate' has shapes, and the solver 'impulse' collides discs alone; use 'softstep'");
    world.configure({.solver = NoContact{}});
    EXPECT_NO_THROW(world.step(0.1));

    World two({.solver = Impulse{.disc_collisions = false}});
    two.add({.shapes = {{}}});
    two.add({.position = {5, 0}, .radius = 1});
    EXPECT_NO_THROW(two.step(0.1));
    two.configure({});
    EXPECT_EQ(error_of([&] { two.step(0.1); }),
              "body number 0 has shapes, and the solver 'impulse' collides discs alone; use 'softstep'");
}

TEST(World, TellsTimeWithoutDrift) {
    World world;
    world.add(Body{});
    for (int n = 0; n < 1'000'000; ++n) world.step(0.1);
    EXPECT_EQ(world.time(), 1e5);  // 1e6 times 0.1 as a double is 1e5 + 5.6e-12, which is less than half an ulp
    EXPECT_EQ(world.steps(), 1'000'000u);
}

TEST(World, RunsToTheEndAndNoFarther) {
    World world;
    world.add(Body{.velocity = {1, 0}});
    int seen = 0;
    run(world, 1, 0.3, [&](const World&) { ++seen; });
    EXPECT_EQ(seen, 4);  // the last one is 0.1 s
    EXPECT_NEAR(world.time(), 1, 1e-15);
    run(world, 1, 0.1);
    EXPECT_EQ(world.steps(), 14u);
    run(world, 0, 0.1);
    EXPECT_EQ(world.steps(), 14u);
}

TEST(World, RefusesStepsThatAreNone) {
    World world;
    EXPECT_EQ(error_of([&] { world.step(0); }), "World::step: dt must be a number > 0 in s, got 0");
    EXPECT_EQ(error_of([&] { world.step(NAN); }), "World::step: dt must be a number > 0 in s, got nan");
    EXPECT_EQ(error_of([&] { run(world, -1, 0.1); }), "run: duration must be a number >= 0 in s, got -1");
    EXPECT_EQ(world.steps(), 0u);
}

TEST(World, SaysWhereAndWhenARunWentWrong) {
    World world;
    world.add(Body{});
    world.add(Body{.name = "rocket"});
    world.add(ForceField{.body = world.find("rocket"), .force = [](Vec2, Vec2, double, double t) {
                             return t > 0.45 ? Vec2{INFINITY, 0} : Vec2{1, 0};
                         }});
    const std::string error = error_of([&] { run(world, 1, 0.1); });
    EXPECT_NE(error.find("t = 0.5 s: body 'rocket'"), std::string::npos) << error;
    try {
        World again = world;
        again.step(0.1);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.cause(), Error::Cause::run);
    }
}

TEST(World, SaysThatASpinWentWrong) {
    World world;
    world.add(Body{.radius = 1, .name = "top"});
    world.add(UserForce{.name = "brake", .add = [](const Snapshot&, std::span<Vec2>, std::span<double> torque) {
                            torque[0] = INFINITY;
                        }});
    const std::string error = error_of([&] { world.step(0.1); });
    EXPECT_NE(error.find("body 'top' is at (0, 0) m with velocity (0, 0) m/s, turned by "), std::string::npos) << error;
}

TEST(World, SaysThatAttractionHasNoBoundUnderEveryMethod) {
    for (const Integrator& method : {Integrator(Euler{}), Integrator(SymplecticEuler{}), Integrator(Rk4{})}) {
        World world({.integrator = method});
        for (int k = 0; k < 2; ++k) world.add(Body{.position = {1, 1}});
        world.add(Attraction{.strength = 1});
        const std::string error = error_of([&] { world.step(0.1); });
        EXPECT_NE(error.find("an attraction without softening has no bound"), std::string::npos) << error;
    }
}

TEST(World, RefusesLongStepsIfAskedTo) {
    World world({.long_step = LongStep::refuse});
    const BodyId a = world.add(Body{.kind = Kind::fixed}), b = world.add(Body{.position = {1, 0}});
    world.add(Spring{.a = a, .b = b, .stiffness = 100, .rest_length = 1});
    EXPECT_NEAR(world.stable_step(), 0.18, 1e-15);  // 0.9 · 2/ω, ω = 10 /s
    const std::string error = error_of([&] { world.step(0.2); });
    EXPECT_NE(error.find("at most 0.18 s"), std::string::npos) << error;
    EXPECT_NE(error.find("verlet"), std::string::npos) << error;
    EXPECT_EQ(world.steps(), 0u);
    EXPECT_NO_THROW(world.step(0.17));
}

TEST(Accounts, CloseForAllIntegratorsAtASmallStep) {
    for (const Integrator& integrator : integrators) {
        World world = busy(integrator, Impulse{});
        run(world, 1, 1e-4);
        const Energy e = energy(world);
        EXPECT_GT(e.heat.damping, 0.01);
        EXPECT_GT(e.heat.drag, 0.1);
        EXPECT_GT(e.heat.impact, 0.1);
        EXPECT_GT(std::abs(e.work.driven), 0.01);
        // Some 200 J. First order for symplectic Euler: ω h = 1e-3. The others: what impacts leave of order two.
        const double tolerance = std::holds_alternative<SymplecticEuler>(integrator) ? 0.2 : 2e-3;
        EXPECT_NEAR(e.residual, 0, tolerance) << integrator.index();
    }
}

TEST(Accounts, OfVerletCloseToSecondOrder) {
    const auto residual = [](double dt) {
        World world = busy(Verlet{}, NoContact{});
        run(world, 1, dt);
        return std::abs(energy(world).residual);
    };
    EXPECT_NEAR(residual(1.0 / 200) / residual(1.0 / 800), 16, 6);
}

TEST(Accounts, TakeEditsAsGiven) {
    World world = busy(Verlet{}, Impulse{});
    run(world, 0.3, 1e-3);
    const double residual = energy(world).residual;
    const auto unchanged = [&](const char* after) {
        EXPECT_NEAR(energy(world).residual, residual, 1e-10) << after;  // 100 J, some roundings
    };
    const BodyId extra = world.add(Body{.position = {3, 3}, .velocity = {5, 5}, .mass = 3, .radius = 0.1});
    unchanged("adding a body");
    world.add(Spring{.a = extra, .b = world.ids()[0], .stiffness = 20});
    unchanged("adding a stretched spring");
    world.set_velocity(extra, {-7, 2}, 4);
    unchanged("setting a velocity");
    world.set_position(extra, {3.5, 2}, 1);
    unchanged("setting a position");
    Settings settings = world.settings();
    settings.gravity = {1, -3};
    world.configure(settings);
    unchanged("changing gravity");
    world.remove(world.ids()[1]);
    unchanged("removing a body");
}

TEST(World, FeelsAnEditAtOnce) {
    // Verlet keeps the forces of a step's end for the next one; after an edit they are others.
    const auto on_a_spring = [](Vec2 position, Vec2 velocity) {
        World world;
        const BodyId a = world.add(Body{.kind = Kind::fixed}),
                     b = world.add(Body{.position = position, .velocity = velocity});
        world.add(Spring{.a = a, .b = b, .stiffness = 10, .rest_length = 1});
        return world;
    };
    World edited = on_a_spring({2, 0}, {});
    edited.step(0.1);
    edited.set_position(edited.ids()[1], {0, 3}, 0);
    World fresh = on_a_spring({0, 3}, edited.velocity(edited.ids()[1]));
    edited.step(0.1);
    fresh.step(0.1);
    EXPECT_EQ(state_hash(edited), state_hash(fresh));
}

TEST(Accounts, StartWithWhatWasPutIn) {
    World world({.gravity = {0, -10}});
    world.add(Body{.position = {0, 3}, .velocity = {2, 0}, .angular_velocity = 3, .mass = 2, .radius = 1});
    const Energy e = energy(world);
    EXPECT_EQ(e.kinetic, 4);
    EXPECT_EQ(e.rotational, 4.5);  // ½ · (½ m r²) · 9
    EXPECT_EQ(e.gravity, 60);
    EXPECT_EQ(e.initial_total, 68.5);
    EXPECT_EQ(e.residual, 0);
}

TEST(Accounts, DoNotNoticeBeingLookedAt) {
    World watched = busy(Verlet{}, Impulse{}), alone = watched;
    for (int n = 0; n < 50; ++n) {
        watched.step(0.01);
        energy(watched);
        watched.stable_step();
        alone.step(0.01);
    }
    EXPECT_EQ(state_hash(watched), state_hash(alone));
}

TEST(Freedom, OfABodyKeepsItsVelocityToTheLastBit) {
    for (const Integrator& integrator : integrators) {
        World world({.integrator = integrator});
        const BodyId body = world.add(Body{.velocity = {1e6, -3.7}, .angular_velocity = 1e5, .radius = 0.1});
        run(world, 10, 1.0 / 60);
        EXPECT_EQ(world.velocity(body), (Vec2{1e6, -3.7}));
        EXPECT_EQ(world.angular_velocity(body), 1e5);
    }
}

TEST(Driven, BodiesFollowTheirCurveAndTheirWorkIsBooked) {
    World world;
    const BodyId hand = world.add(Body{.kind = Kind::driven}), load = world.add(Body{.position = {1, 0}});
    world.drive(hand, [](double t) { return Pose{{std::sin(t), 0}, 2 * t}; });
    world.add(Spring{.a = hand, .b = load, .stiffness = 40, .rest_length = 1});
    run(world, 3, 1e-3);
    EXPECT_EQ(world.position(hand).x, std::sin(world.time()));
    EXPECT_NEAR(world.velocity(hand).x, std::cos(3), 1e-11);  // by differences: 1e-12 of the curve's scale
    EXPECT_NEAR(world.angular_velocity(hand), 2, 1e-11);
    EXPECT_GT(std::abs(energy(world).work.driven), 0.1);
    EXPECT_NEAR(energy(world).residual, 0, 1e-4);  // Verlet at ω h = 6e-3
}

/// Of place, height and angle each was differenced by itself: a script that moves a lift was called 304 times a step.
TEST(Driven, BodiesAskTheirCurveOnceForATime) {
    World world({.solver = SoftStep{}});
    const BodyId lift = world.add(Body{.kind = Kind::driven, .radius = 1});
    int asked = 0;
    world.drive(lift, [&asked](double t) {
        ++asked;
        return Pose{{std::sin(t), std::cos(t)}, t};
    });
    world.step(1.0 / 60);
    asked = 0;
    world.step(1.0 / 60);
    EXPECT_LE(asked, 112);  // 7 times of it, 4 times in each substep
}

TEST(Driven, ByACurveThatLeadsNowhereIsRefusedAndNothingChanges) {
    World world;
    const BodyId hand = world.add(Body{.kind = Kind::driven, .position = {1, 2}});
    EXPECT_EQ(error_of([&] { world.drive(hand, [](double) {
                                 return Pose{{std::nan(""), 0}, 0};
                             }); }),
              "World::drive: the curve must be finite, got (nan, 0) m and 0 rad at t = 0 s");
    EXPECT_EQ(error_of([&] { world.drive(hand, [](double) -> Pose { throw Error("no curve"); }); }), "no curve");
    EXPECT_FALSE(world.follows_curve(hand));
    world.step(0.1);
    EXPECT_EQ(world.position(hand), (Vec2{1, 2}));
}

TEST(World, RefusesAHalfPlaneWhoseNormalHasNoDirectionInNumbers) {
    World world;
    for (const double size : {1e-200, 1e200})  // whose square is 0 or infinite: nobody stood on it
        EXPECT_NE(error_of([&] {
                      world.add(HalfPlane{.normal = {0, size}});
                  }).find("between 1e-150 and 1e150"),
                  std::string::npos);
}

TEST(World, SoftStepKnowsNoPeriodicBox) {
    World world({.solver = SoftStep{}});
    world.add(Periodic{{0, 0}, {4, 4}});
    EXPECT_EQ(error_of([&] { world.step(0.1); }),
              "the solver 'softstep' knows no periodic box; use 'impulse', or walls");
}

TEST(World, PutAPlaceBelowABoxOnItsUpperEdge) {
    World world;
    world.add(Periodic{{0, -2}, {1, 3}});
    for (const double x : {-1e-18, -5e-17, 0.0, 1.0, 2.0, -3.0, 1 - 0x1p-53, 1e17}) {
        const Vec2 in = world.wrapped({x, 3 + x});
        EXPECT_TRUE(in.x >= 0 && in.x < 1) << x;
        EXPECT_TRUE(in.y >= -2 && in.y < 3) << x;
    }
    EXPECT_EQ(world.wrapped({-1e-18, 3}), (Vec2{0, -2}));
    EXPECT_EQ(world.wrapped({-0.25, 3.5}), (Vec2{0.75, -1.5}));
}

TEST(Run, OfAnInstantMadeNoStep) {
    for (const double duration : {1e-11, 1e-300}) {
        World world;
        world.add(Body{.velocity = {1, 0}});
        run(world, duration, 1.0 / 60);
        EXPECT_EQ(world.steps(), 1u);
        EXPECT_EQ(world.time(), duration);
        EXPECT_EQ(steps_of(duration, 1.0 / 60), 1u);
    }
    EXPECT_EQ(steps_of(0, 1), 0u);
}

TEST(Run, CountedStepsOfNoDuration) {
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(error_of([] { steps_of(10, 0); }), "run: step must be a number > 0 in s, got 0");
    EXPECT_EQ(error_of([] { steps_of(10, -1); }), "run: step must be a number > 0 in s, got -1");
    EXPECT_NE(error_of([=] { steps_of(nan, 1); }), "no error");
    EXPECT_NE(error_of([=] { steps_of(infinity, 1); }), "no error");
    EXPECT_EQ(error_of([] { steps_of(1e16, 1); }), "run: duration must be at most 1e+15 steps of 1 s, got 1e+16 s");
}

// A run of 10¹² steps and more had one too many for every 10¹².
TEST(Run, CountedMoreStepsThanThereAre) {
    for (const double steps : {3.0, 3e8, 1e12, 3e12, 1e13, 4e13})
        for (const double step : {1.0, 0.1, 1.0 / 3, 1e-6, 7.0})
            EXPECT_EQ(steps_of(steps * step, step), static_cast<std::uint64_t>(steps)) << steps << " " << step;
    EXPECT_EQ(steps_of(1e12 + 0.5, 1), 1000000000001u);
    EXPECT_EQ(steps_of(10.25, 1), 11u);
    EXPECT_EQ(steps_of(10, 0.3), 34u);
}

TEST(Driven, WallsDoWorkOnAGas) {
    // A heavy piston at constant velocity u: a disc at rest leaves with 2u, the work is ½ m (2u)².
    World world;
    world.add(Body{.kind = Kind::driven, .velocity = {3, 0}, .radius = 1});
    const BodyId disc = world.add(Body{.position = {5, 0}, .mass = 2, .radius = 0.5});
    run(world, 2, 1.0 / 60);
    EXPECT_NEAR(world.velocity(disc).x, 6, 1e-14);
    EXPECT_NEAR(energy(world).work.driven, 36, 1e-12);
    EXPECT_NEAR(energy(world).residual, 0, 1e-12);
}

// Whoever embeds the engine keeps his own things by the ids of bodies.
TEST(Ids, OfNoBodyAreNamedByTheFieldThatHasThem) {
    World world({.solver = SoftStep{}});
    const BodyId here = world.add(Body{.radius = 1}), gone = world.add(Body{});
    world.remove(gone);
    const std::string stale = "BodyId is stale: body 1 (generation 1) was removed from this world",
                      never = "BodyId must come from World::add of this world, got one that no body ever had";
    EXPECT_EQ(error_of([&] { world.add(Joint{.type = RevoluteJoint{}}); }), "Joint.b: " + never);
    EXPECT_EQ(error_of([&] { world.add(Joint{.name = "pin", .a = gone, .b = here}); }), "Joint 'pin'.a: " + stale);
    EXPECT_EQ(error_of([&] { world.add(Spring{.a = here}); }), "Spring.b: " + never);
    EXPECT_EQ(error_of([&] { world.add(ConstantForce{}); }), "ConstantForce.body: " + never);
    EXPECT_EQ(error_of([&] { world.add(Drag{.body = gone}); }), "Drag.body: " + stale);
}

TEST(World, NamesTheBodyThatCannotBeMovedSo) {
    World world;
    const BodyId rock = world.add(Body{.kind = Kind::fixed, .name = "rock"}),
                 lift = world.add(Body{.kind = Kind::driven});
    const auto push = [&](BodyId id) { return error_of([&] { world.apply_impulse(id, {1, 0}, {}); }); };
    EXPECT_EQ(push(rock), "World::apply_impulse: body 'rock' must be dynamic");
    EXPECT_EQ(push(lift), "World::apply_impulse: body number 1 must be dynamic");
    EXPECT_EQ(error_of([&] { world.apply_angular_impulse(rock, 1); }),
              "World::apply_angular_impulse: body 'rock' must be dynamic");
    EXPECT_EQ(error_of([&] {
                  world.set_velocity(rock, {1, 0}, 0);
              }),
              "World::set_velocity: body 'rock' is fixed and does not move");
}

TEST(Ids, AreKeysOfMaps) {
    World world;
    std::map<BodyId, int> ordered;
    std::unordered_map<BodyId, int> hashed;
    std::unordered_map<ShapeId, int> of_shapes;
    const auto note = [&](BodyId id, int number) {
        ordered[id] = hashed[id] = number;
        for (std::uint32_t shape : {0, 1}) of_shapes[{id, shape}] = 2 * number + static_cast<int>(shape);
    };
    const BodyId first = world.add(Body{});
    note(first, 0);
    world.remove(first);
    const BodyId second = world.add(Body{}), third = world.add(Body{});  // one of them in the first one's place
    note(second, 1), note(third, 2);
    EXPECT_EQ(ordered.size(), 3);
    EXPECT_EQ(hashed.size(), 3);
    EXPECT_EQ(of_shapes.size(), 6);
    EXPECT_EQ(hashed.at(first), 0);
    EXPECT_EQ(ordered.at(third), 2);
    EXPECT_EQ((of_shapes.at({second, 1})), 3);
    const std::unordered_set<JointId> joints{{1}, {2}, {1}};
    const std::set<ForceId<Spring>> springs{{2}, {1}, {2}};
    const std::unordered_set<WallId<HalfPlane>> walls{{1}, {1}};
    EXPECT_EQ(joints.size() + springs.size() + walls.size(), 2 + 2 + 1);
}
