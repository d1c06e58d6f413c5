// Joints and contacts together: what hangs strikes, leans and rests.

#include "joints.hpp"
#include "overlap.hpp"

namespace carom {
namespace {

using namespace test;

/// Newton's cradle of five discs on rods: the first ones are lifted, and after every swing as many rise as far.
/// Box2D's swings half as far after the first.
class Cradle : public testing::TestWithParam<int> {};
TEST_P(Cradle, OnRodsSwingsTwentyTimes) {
    constexpr double radius = 0.1, lift = 0.6;
    World world = mechanism_world({.sleep = false});
    std::vector<BodyId> discs;
    for (int i = 0; i < 5; ++i) {
        const double x = 2 * radius * i, angle = i < GetParam() ? lift : 0;
        discs.push_back(world.add(Body{.position = {x - std::sin(angle), -std::cos(angle)}, .radius = radius}));
        world.add(Joint{.b = discs.back(), .anchor_a = {x, 0}, .type = DistanceJoint{.length = 1}});
    }
    // What the last disc has of energy gives the height in which it turns, between two steps.
    const auto height = [&] {
        const Vec2 v = world.velocity(discs[4]);
        return 1 + world.position(discs[4]).y + 0.5 * dot(v, v) / gravity;
    };
    int swings = 0;
    double farthest = 0, idle = 0, highest = 0;
    watch(world, 45, [&] {
        const double x = world.position(discs[4]).x - 0.8;
        if (x > farthest) farthest = x, highest = height();
        for (int k = GetParam(); k < 5 - GetParam(); ++k)
            idle = std::max(idle, std::abs(world.position(discs[static_cast<std::size_t>(k)]).x - 2 * radius * k));
        if (x > 0.01 || farthest < 0.1) return;
        ++swings;
        EXPECT_NEAR(highest, 1 - std::cos(lift), 1e-5 * (1 - std::cos(lift))) << "swing " << swings;
        farthest = 0;
    });
    EXPECT_GE(swings, 20);
    EXPECT_LE(idle, 1e-5);
    EXPECT_NEAR(energy(world).heat.impact, 0, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Lifted, Cradle, testing::Values(1, 2, 3));

/// A load on a rope of twenty links of 0.1 kg swings against a wall: the rope does not give way.
class HeavyLoad : public testing::TestWithParam<double> {};
TEST_P(HeavyLoad, OnARopeAgainstAWall) {
    constexpr double link = 0.2;
    const double load = GetParam();
    World world = mechanism_world({.sleep = false});
    world.add(HalfPlane{.point = {-2, 0}, .normal = {1, 0}, .side = {.restitution = 0, .friction = 0.3}});
    std::optional<BodyId> last;
    const Vec2 way{0.8, -0.6};
    for (int i = 0; i < 20; ++i) {
        Body next = rod((i + 0.5) * link * way, link, 0.1);
        next.angle = -std::asin(0.6);
        const BodyId id = world.add(next);
        world.add(Joint{.a = last, .b = id, .at = i * link * way, .type = RevoluteJoint{}});
        last = id;
    }
    const BodyId ball =
        world.add(Body{.position = 4.3 * way, .mass = load, .radius = 0.3, .restitution = 0, .friction = 0.3});
    world.add(Joint{.a = last, .b = ball, .at = 4 * way, .type = RevoluteJoint{}});
    double gap = 0, deepest = 0, made = 0;
    watch(world, 10, [&] {
        const Energy e = energy(world);
        gap = std::max(gap, gaps(world));
        deepest = std::min(deepest, world.position(ball).x - 0.3 + 2);
        made = std::max(made, e.total() + e.heat.total() - e.initial_total);
    });
    EXPECT_LE(gap, 1e-6);
    EXPECT_GE(deepest, -1e-3);
    EXPECT_GT(energy(world).heat.impact, load);
    EXPECT_LE(made, 1e-4 * load * gravity * 4);
}
INSTANTIATE_TEST_SUITE_P(Kilogrammes, HeavyLoad, testing::Values(300, 3000, 10000));

/// A chain of boxes dropped on the floor comes to rest and sleeps, all of it.
TEST(Chain, OnTheFloorSleeps) {
    World world = mechanism_world({.statics = false});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    std::optional<BodyId> last;
    for (int i = 0; i < 10; ++i) {
        const BodyId next = world.add(Body{
            .position = {0.5 + i, 0.25}, .shapes = {{.geometry = Box{1, 0.2}}}, .restitution = 0, .friction = 0.5});
        if (last) world.add(Joint{.a = last, .b = next, .at = Vec2{double(i), 0.25}, .type = RevoluteJoint{}});
        last = next;
    }
    watch(world, 8, [&] { EXPECT_LE(gaps(world), 1e-10); });
    for (const BodyId id : world.ids()) {
        EXPECT_TRUE(world.asleep(id));
        EXPECT_NEAR(world.position(id).y, 0.1, 1e-3);
    }
}

/// Whatever the size of its links (above a centimetre), a chain on the floor sinks into it by no more than 1/200 of
/// them where sweeps hold it. At a corner g h²/κ² × 5/4 would be 0.21 mm in four substeps, of which relaxing leaves
/// half: if that is more than 1/100 of a link there are eight, and a quarter is left. Links of some sizes are solved
/// precisely, and do not sink at all.
class ChainOfLinks : public testing::TestWithParam<double> {};
TEST_P(ChainOfLinks, HardlySinks) {
    const double side = GetParam();
    World world = mechanism_world({.statics = false});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    std::optional<BodyId> last;
    for (int i = 0; i < 5; ++i) {
        const BodyId next = world.add(Body{.position = {(i + 0.5) * side, side / 2},
                                           .shapes = {{.geometry = Box{side, side}}},
                                           .restitution = 0,
                                           .friction = 0.5});
        if (last) world.add(Joint{.a = last, .b = next, .at = Vec2{i * side, side / 2}, .type = RevoluteJoint{}});
        last = next;
    }
    run(world, 3, frame);
    for (const BodyId id : world.ids()) {
        EXPECT_LT(world.position(id).y, side / 2 + 1e-9 * side);
        EXPECT_GT(world.position(id).y, side / 2 - 0.005 * side);
    }
}
INSTANTIATE_TEST_SUITE_P(Metres, ChainOfLinks, testing::Values(0.012, 0.022, 0.1, 1.0));

constexpr double plank_mass = 5, plank_height = 0.1;
/// Planks of 1 m on hinges, pinned at either end of the chain, from the origin on; each turns by so much from the one
/// before [rad]. Returns its end.
Vec2 add_planks(World& world, int planks, double turn = 0, std::optional<BodyId> held = {}) {
    std::optional<BodyId> last = held;
    Vec2 end{};
    const auto pin = [&](std::optional<BodyId> a, BodyId b) {
        world.add(Joint{.a = a, .b = b, .at = end, .type = RevoluteJoint{}});
    };
    for (int i = 0; i < planks; ++i) {
        const double angle = turn * (i - 0.5 * (planks - 1));
        const Vec2 along{std::cos(angle), std::sin(angle)};
        const BodyId next = world.add(Body{
            .position = end + 0.5 * along,
            .angle = angle,
            .shapes = {{.geometry = Box{1, plank_height}, .density = plank_mass / plank_height, .restitution = 0}}});
        pin(last, next);
        last = next, end += along;
    }
    pin(held, *last);
    return end;
}
constexpr double ball_radius = 0.3;
BodyId add_ball(World& world, double mass, Vec2 under, double above) {
    const double y = ball_radius + 0.5 * plank_height + above;
    return world.add(Body{.position = under + Vec2{0, y}, .mass = mass, .radius = ball_radius, .restitution = 0});
}

/// A ball as heavy as so many planks falls on a chain of few that sags a little. What hangs so tight is slowed down
/// where it zig-zags, and the precise solve took it for moved as its masses say, or not at all: a ball of twenty planks
/// lay 20 cm deep in planks of 10 cm.
class ShallowChain : public testing::TestWithParam<double> {};
TEST_P(ShallowChain, OfFewPlanksHoldsWhatFallsOnIt) {
    for (const int planks : {4, 10})
        for (const double above : {0.01, 1.0}) {
            World world = mechanism_world({.sleep = false});
            const double turn = 0.06 / planks;
            const Vec2 end = add_planks(world, planks, turn);
            const double sag = turn * planks * planks / 8;
            add_ball(world, GetParam() * plank_mass, {0.5 * end.x + 0.1, -sag}, above);
            double deepest = 0;
            watch(world, 6, [&] {
                if (world.time() > 4) deepest = std::max(deepest, deepest_overlap(world));
            });
            // A contact of a load with so light a body is soft: it gives way by millimetres.
            EXPECT_LE(deepest, 0.1 * plank_height) << planks << ", " << above;
        }
}
INSTANTIATE_TEST_SUITE_P(Loads, ShallowChain, testing::Values(5, 10, 20));

/// What is given to a chain that is just as long as its way, of that.
constexpr double slack = 1e-5;
/// How deep a load in the middle of such a chain may hang, as part of the way: by two straight halves.
const double deepest_vertex = std::sqrt(0.5 * slack);

/// The same on planks that are just as long as the gap they span. No finite force holds these straight: a ball of ten
/// planks sank through them.
class TautPlanks : public testing::TestWithParam<double> {};
TEST_P(TautPlanks, HoldWhatFallsOnThem) {
    for (const int planks : {2, 7, 20})
        for (const double above : {0.01, 1.0}) {
            World world = mechanism_world({.sleep = false});
            const Vec2 end = add_planks(world, planks);
            const BodyId ball = add_ball(world, GetParam() * plank_mass, {0.5 * end.x + 0.1, 0}, above);
            double deepest = 0, lowest = 0;
            watch(world, 6, [&] {
                if (world.time() < 4) return;
                deepest = std::max(deepest, deepest_overlap(world));
                lowest = std::min(lowest, world.position(ball).y - ball_radius - 0.5 * plank_height);
            });
            EXPECT_LE(deepest, 0.1 * plank_height) << planks << ", " << above;
            EXPECT_GE(lowest, -deepest_vertex * planks - deepest) << planks << ", " << above;
            EXPECT_LE(gaps(world), slack * planks * (1 + 1e-3)) << planks << ", " << above;
        }
}
INSTANTIATE_TEST_SUITE_P(Loads, TautPlanks, testing::Values(1, 5, 10));

/// A chain that bears a ball of so many of its bodies as two straight lines.
void expect_held(World& world, BodyId ball, double on_straight, double way, double seconds = 4) {
    run(world, seconds, frame);
    const double y = world.position(ball).y, sag = deepest_vertex * way;
    EXPECT_GE(y, on_straight - sag - 0.1 * plank_height);
    EXPECT_LE(y, on_straight);
}

/// Also by rods from centre to centre, and by ropes, which are as much longer. (Of straight ropes a load of five knots
/// had seven hundred kilojoules booked as heat of limits, and as made by the method.)
class TautLinks : public testing::TestWithParam<DistanceJoint> {};
TEST_P(TautLinks, HoldWhatFallsOnThem) {
    constexpr int links = 12;
    constexpr double radius = 0.4, mass = 5, ball = 0.8;
    World world = mechanism_world({.sleep = false});
    std::optional<BodyId> last;
    for (int i = 1; i < links; ++i) {
        const BodyId next = world.add(Body{.position = {1.0 * i, 0}, .mass = mass, .radius = radius, .restitution = 0});
        world.add(Joint{.a = last, .b = next, .anchor_a = {}, .anchor_b = {}, .type = GetParam()});
        last = next;
    }
    world.add(Joint{.b = *last, .anchor_a = {links, 0}, .type = GetParam()});
    const double on_two = std::sqrt((radius + ball) * (radius + ball) - 0.25), load_mass = 5 * mass;
    const BodyId load =
        world.add(Body{.position = {links / 2 + 0.5, 2}, .mass = load_mass, .radius = ball, .restitution = 0});
    expect_held(world, load, on_two, links);
    EXPECT_LE(energy(world).residual, 0.05 * load_mass * gravity) << "of the energy with which it lands";
}
INSTANTIATE_TEST_SUITE_P(Types, TautLinks,
                         testing::Values(DistanceJoint{.length = 1}, DistanceJoint{.limits = {.upper = 1}}));

/// What hangs on one of its planks is no part of how long it is.
TEST(TautChains, HoldALampToo) {
    World world = mechanism_world({.sleep = false});
    const Vec2 end = add_planks(world, 10);
    const BodyId lamp = world.add(Body{.position = {3.5, -1}, .radius = 0.2, .restitution = 0});
    world.add(
        Joint{.a = world.ids()[3], .b = lamp, .anchor_a = {}, .anchor_b = {}, .type = DistanceJoint{.length = 1}});
    const BodyId ball = add_ball(world, 10 * plank_mass, {0.5 * end.x, 0}, 0.1);
    expect_held(world, ball, ball_radius + 0.5 * plank_height, end.x);
}

/// Between two places of one body that is driven they are as well.
TEST(TautChains, HoldOnALift) {
    constexpr double speed = 0.5, seconds = 4;
    World world = mechanism_world({.sleep = false});
    const BodyId lift = world.add(Body{.kind = Kind::driven, .velocity = {0, speed}});
    const Vec2 end = add_planks(world, 10, 0, lift);
    const BodyId ball = add_ball(world, 10 * plank_mass, {0.5 * end.x, 0}, 0.1);
    expect_held(world, ball, ball_radius + 0.5 * plank_height + speed * seconds, end.x, seconds);
}

/// Straight ones sag the way they are pulled, by 0.2 % of their way, and no energy comes of it but what that takes.
TEST(TautChains, SagTheWayTheyArePulled) {
    for (const Vec2 g : {Vec2{0, -gravity}, Vec2{0, gravity}}) {
        constexpr int planks = 20;
        World world = mechanism_world({.sleep = false}, g);
        add_planks(world, planks);
        world.step(frame);
        const double sag = std::sqrt(3.0 / 8 * slack) * planks,
                     way = world.positions()[planks / 2].y * (g.y > 0 ? 1 : -1);
        EXPECT_NEAR(way, sag, 1e-2 * sag);
        const double fallen = energy(world).work.correction, weight = planks * plank_mass * gravity;
        EXPECT_NEAR(fallen, -weight * 2 / 3 * sag, 1e-2 * weight * sag);
        EXPECT_NEAR(energy(world).kinetic + energy(world).potential(), fallen, 1e-2 * weight * sag);
    }
}

/// 160 planks of 5 kg with dry friction in their hinges, exactly as long as the gap they span. They hang by a hair of
/// slack, and no energy is made.
class Bridge : public testing::TestWithParam<double> {};
TEST_P(Bridge, OfAHundredAndSixtyPlanksHasNoGaps) {
    constexpr int planks = 160;
    World world = mechanism_world();
    RevoluteJoint hinge;
    if (GetParam() > 0) hinge.motor = JointMotor{.maximum = GetParam()};
    std::optional<BodyId> last;
    for (int i = 0; i < planks; ++i) {
        const BodyId next =
            world.add(Body{.position = {i + 0.5, 0}, .shapes = {{.geometry = Box{1, 0.25}, .density = 20}}});
        world.add(Joint{.a = last, .b = next, .at = Vec2{double(i), 0}, .type = hinge});
        last = next;
    }
    const Vec2 end{planks, 0};
    world.add(Joint{.a = last, .b = world.add(Body{.kind = Kind::fixed, .position = end}), .at = end, .type = hinge});
    double worst = 0, made = 0;
    watch(world, 10, [&] {
        worst = std::max(worst, gaps(world));
        made = std::max(made, energy(world).total());
    });
    EXPECT_LE(worst, slack * planks * (1 + 1e-3));  // 1.6e-3; the issue asks for 5e-3, and Box2D's have 5 m
    EXPECT_LE(made, 0);
}
INSTANTIATE_TEST_SUITE_P(DryFriction, Bridge, testing::Values(0, 200));

/// A ball of ten knots falls into a row of these on rods that is longer than its way. What a blow had left as overlap
/// was undone at 1 cm/s there, and the ball lay in the knots for seconds.
TEST(Hammock, HoldsWhatFallsIntoIt) {
    constexpr double apart = 0.4, knot = 0.1;
    for (const int knots : {6, 10, 14})
        for (const double longer : {0.02, 0.1})
            for (const double above : {1.0, 2.0}) {
                World world = mechanism_world({.sleep = false});
                const double way = (knots + 1) * apart, sag = std::sqrt(3.0 / 8 * longer) * way;
                const DistanceJoint rod{.length = apart * (1 + longer)};
                std::optional<BodyId> last;
                for (int i = 1; i <= knots; ++i) {
                    const double t = 1.0 * i / (knots + 1);
                    const BodyId next = world.add(Body{
                        .position = {t * way, -4 * sag * t * (1 - t)}, .mass = 1, .radius = knot, .restitution = 0});
                    world.add(Joint{.a = last, .b = next, .anchor_a = {}, .anchor_b = {}, .type = rod});
                    last = next;
                }
                world.add(Joint{.b = *last, .anchor_a = {way, 0}, .type = rod});
                world.add(
                    Body{.position = {0.5 * way + 0.03, 0.6 + above}, .mass = 10, .radius = 0.5, .restitution = 0});
                double deep = 0;  // s
                watch(world, 5, [&] {
                    if (deepest_overlap(world) > 0.1 * 2 * knot) deep += frame;
                });
                EXPECT_LE(deep, 0.5) << knots << ", " << longer << ", " << above;
            }
}

/// A lever bears a load of a few kilograms at its long end by what its short end presses against a stop: twenty-seven
/// times as much, and eighty. So much is no blow, and no wedge.
TEST(Lever, BearsMoreThanItWeighs) {
    for (const double arm : {0.4, 0.15, 0.05}) {
        World world = mechanism_world({.sleep = false, .statics = false});
        const BodyId lever = world.add(Body{
            .position = {2, 1}, .mass = 2, .shapes = {{.geometry = Box{5, 0.1}, .restitution = 0, .friction = 0.5}}});
        world.add(Joint{.b = lever, .at = Vec2{0, 1}, .type = RevoluteJoint{}});
        world.add(Body{.kind = Kind::fixed,
                       .position = {-arm, 1.075},
                       .shapes = {{.geometry = Disc{{}, 0.025}, .restitution = 0, .friction = 0.5}}});
        world.add(Body{.position = {4, 1.25},
                       .mass = 20,
                       .shapes = {{.geometry = Box{0.4, 0.4}, .restitution = 0, .friction = 0.5}}});
        run(world, 5, frame);
        EXPECT_LE(deepest_overlap(world), 1e-5) << arm;
        EXPECT_LE(std::abs(world.angle(lever)), 1e-4) << arm;
    }
}

/// A car on two wheels of 1 kg whose motors give 3 N m each and would turn them at any speed: it is driven by 20 N, and
/// heat is what the floor gives way. In its first substep the motors were taken for as strong as it takes to reach that
/// speed, and what the floor answered threw the car up, with 2e-2 J in the finest substeps.
TEST(DrivenWheels, StartWithoutAHop) {
    constexpr double radius = 0.3, mass = 10, torque = 3, seconds = 2;
    constexpr double pull = 2 * torque / radius, inert = mass + 2 * 1.5;
    double heat_before = 0;
    for (const int steps : {240, 960}) {
        World world = mechanism_world({.substeps = 1, .sleep = false});
        world.add(HalfPlane{.normal = {0, 1}, .side = {.friction = 1}});
        const BodyId car = world.add(Body{.position = {0, 1}, .mass = mass, .moment_of_inertia = mass / 3});
        for (const double x : {-0.8, 0.8}) {
            const BodyId wheel = world.add(Body{.position = {x, radius}, .radius = radius, .friction = 1});
            world.add(Joint{.a = car,
                            .b = wheel,
                            .at = Vec2{x, radius},
                            .type = RevoluteJoint{.motor = JointMotor{.speed = -100, .maximum = torque}}});
        }
        double highest = 0;
        for (int i = 0; i < seconds * steps; ++i) {
            world.step(1.0 / steps);
            for (std::size_t wheel : {1, 2}) highest = std::max(highest, world.positions()[wheel].y);
        }
        EXPECT_LE(highest, radius);
        EXPECT_NEAR(world.velocity(car).x, pull / inert * seconds, 240.0 / steps * 2e-3);
        const Energy::Heat heat = energy(world).heat;
        EXPECT_GE(heat.friction, 0);
        EXPECT_LE(heat.friction, 1e-3);
        // Contacts of a quarter of the substep are sixteen times as stiff.
        if (heat_before > 0) {
            EXPECT_NEAR(heat_before / heat.friction, 16, 1);
        }
        heat_before = heat.friction;
    }
}

}  // namespace
}  // namespace carom
