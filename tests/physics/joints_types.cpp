// Each type of joint: its motion, its forces, and where its energy goes.

#include "joints.hpp"
#include "reference/truth.hpp"

namespace carom {
namespace {

using namespace test;

double mechanical(const World& world) {
    return energy(world).kinetic + energy(world).rotational + energy(world).spring;
}

TEST(Springs, OfJointsLoseNothingWithoutDamping) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(Body{.position = {1.5, 0}, .mass = 1});
    world.add(Joint{.b = b, .type = DistanceJoint{.length = 1, .spring = JointSpring{.stiffness = 100}}});
    const double start = total(world);
    EXPECT_NEAR(start, 12.5, 1e-12);
    watch(world, 60, [&] { EXPECT_NEAR(total(world), start, 1e-10 * start); });
}

/// A soft one in gravity, which swings as well: nothing is lost on the average.
TEST(Springs, ThatSwingKeepTheirEnergy) {
    World world = mechanism_world();
    const BodyId b = world.add(Body{.position = {1, 0}, .mass = 1});
    world.add(Joint{.b = b, .type = DistanceJoint{.length = 1, .spring = JointSpring{.stiffness = 200}}});
    const double start = total(world);
    watch(world, 60, [&] { EXPECT_NEAR(total(world), start, 1e-3 * gravity); });
}

/// So stiff that an explicit method would need a thousand times as many substeps.
TEST(Springs, ThatAreStiffLoseNothing) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(Body{.position = {1.001, 0}, .mass = 1});
    world.add(Joint{.b = b, .type = DistanceJoint{.length = 1, .spring = JointSpring{.stiffness = 1e10}}});
    const double start = total(world);
    // An Ångström, to which lengths are solved for, is 1e-7 of the amplitude.
    watch(world, 10, [&] { EXPECT_NEAR(total(world), start, 1e-6 * start); });
}

TEST(Springs, OfHingesLoseNothing) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(rod({0.5, 0}, 1));
    world.add(
        Joint{.b = b, .at = Vec2{}, .type = RevoluteJoint{.rest_angle = -1, .spring = JointSpring{.stiffness = 20}}});
    const double start = total(world);
    EXPECT_NEAR(start, 10, 1e-12);
    watch(world, 60, [&] { EXPECT_NEAR(total(world), start, 1e-3 * start); });
}

/// x = A e^(−ζωt) cos(...): the energy falls with e^(−2ζωt).
TEST(Springs, ByFrequencyAndDampingRatioDecayAsTheyShould) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(Body{.position = {1.2, 0}, .mass = 3});
    world.add(Joint{.b = b,
                    .type = DistanceJoint{.length = 1, .spring = JointSpring{.frequency = 1, .damping_ratio = 0.05}}});
    const double omega = 2 * pi, k = 3 * omega * omega, c = 2 * 0.05 * 3 * omega;
    const Joint made = world.joints()[0];
    EXPECT_NEAR(std::get<DistanceJoint>(made.type).spring->stiffness, k, 1e-10);
    EXPECT_NEAR(std::get<DistanceJoint>(made.type).spring->damping, c, 1e-10);
    const double rate = 0.05 * omega, wd = omega * std::sqrt(1 - 0.05 * 0.05);
    watch(world, 2, [] {});
    const double x = 0.2 * std::exp(-rate * 2) * (std::cos(wd * 2) + rate / wd * std::sin(wd * 2));
    EXPECT_NEAR(world.position(b).x, 1 + x, 1e-4);
    EXPECT_NEAR(energy(world).heat.joint_damping, 0.5 * k * 0.04 - mechanical(world), 1e-4);
}

TEST(Motors, TurnWithTheirTorqueAndThenAtTheirSpeed) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(Body{.mass = 2, .radius = 1});  // I = 1
    world.add(Joint{.b = b, .type = RevoluteJoint{.motor = JointMotor{.speed = 5, .maximum = 2}}});
    run(world, 1, frame);
    EXPECT_NEAR(world.angular_velocity(b), 2, 1e-9);
    EXPECT_NEAR(world.angle(b), 1, 1e-2);
    watch(world, 2, [] {});
    EXPECT_NEAR(world.angular_velocity(b), 5, 1e-9);
    EXPECT_NEAR(energy(world).work.motor, 12.5, 1e-9);
    EXPECT_NEAR(energy(world).residual, 0, 1e-9);
}

TEST(Motors, OfSpeedZeroAreFriction) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(Body{.angular_velocity = 3, .mass = 2, .radius = 1});
    world.add(Joint{.b = b, .type = RevoluteJoint{.motor = JointMotor{.maximum = 1}}});
    run(world, 1, frame);
    EXPECT_NEAR(world.angular_velocity(b), 2, 1e-9);
    watch(world, 3, [] {});
    EXPECT_EQ(world.angular_velocity(b), 0);
    EXPECT_NEAR(world.angle(b), 4.5, 1e-3);  // ω²/(2τ/I)
    EXPECT_NEAR(energy(world).heat.joint_friction, 4.5, 1e-9);
}

TEST(Limits, StopAHingeWhereTheyAre) {
    World world = mechanism_world();
    const BodyId b = world.add(rod({0.5, 0}, 1));
    world.add(Joint{.b = b, .at = Vec2{}, .type = RevoluteJoint{.limits = {-0.5, 0.5}}});
    double least = 0;
    watch(world, 3, [&] { least = std::min(least, world.angle(b)); });
    EXPECT_NEAR(least, -0.5, 1e-9);
    EXPECT_NEAR(world.angle(b), -0.5, 1e-9);
    EXPECT_NEAR(energy(world).heat.limit, 0.5 * gravity * std::sin(0.5),
                0.03);  // the weight works on for the rest of the substep
    // The stop bears the torque of the weight.
    EXPECT_NEAR(world.reaction(world.joint_ids()[0]).torque, 0.5 * gravity * std::cos(0.5), 1e-6);
}

TEST(Limits, MakeARopeThatGoesSlackAndTaut) {
    World world = mechanism_world();
    const BodyId b = world.add(Body{.position = {0.5, 0}, .mass = 1});
    world.add(Joint{.b = b, .type = DistanceJoint{.limits = {.upper = 1}}});
    double most = 0;
    watch(world, 10, [&] { most = std::max(most, length(world.position(b))); });
    EXPECT_NEAR(most, 1, 1e-9);
    EXPECT_GT(energy(world).heat.limit, 0.1);
}

TEST(Slides, GoDownTheirAxis) {
    World world = mechanism_world();
    const BodyId b = world.add(rod({0, 0}, 1));
    world.add(Joint{.b = b, .type = PrismaticJoint{.axis = {3, -4}, .limits = {.upper = 2}}});
    run(world, 0.5, frame);
    EXPECT_NEAR(length(world.position(b)), 0.5 * 0.8 * gravity * 0.25, 1e-9);
    EXPECT_NEAR(world.reaction(world.joint_ids()[0]).force.y, 0.6 * 0.6 * gravity, 1e-8);
    watch(world, 2, [] {});
    EXPECT_NEAR(world.position(b).x, 1.2, 1e-9);
    EXPECT_NEAR(world.position(b).y, -1.6, 1e-9);
    EXPECT_EQ(world.angle(b), 0);
    EXPECT_NEAR(energy(world).heat.limit, 1.6 * gravity, 0.05);  // the weight works on for the rest of the substep
}

TEST(Slides, AreMovedByMotors) {
    World world = mechanism_world();
    const BodyId b = world.add(rod({0, 0}, 1, 2));
    world.add(Joint{.b = b, .type = PrismaticJoint{.axis = {0, 1}, .motor = JointMotor{.speed = 0.5, .maximum = 100}}});
    watch(world, 4, [] {});
    EXPECT_NEAR(world.velocity(b).y, 0.5, 1e-8);
    EXPECT_NEAR(energy(world).work.motor, 2 * gravity * world.position(b).y + 0.25, 1e-2);
    EXPECT_NEAR(world.reaction(world.joint_ids()[0]).force.y, 2 * gravity, 1e-6);
}

/// Box2D's sags by 15.6 m.
TEST(Welds, CarryACantileverOfTwentyBoxes) {
    World world = mechanism_world({.statics = false});
    std::optional<BodyId> last;
    for (int i = 0; i < 20; ++i) {
        const BodyId next = world.add(Body{.position = {i + 0.5, 0}, .shapes = {{.geometry = Box{1, 1}}}});
        world.add(Joint{.a = last, .b = next, .at = Vec2{double(i), 0}, .type = WeldJoint{}});
        last = next;
    }
    double sag = 0;
    watch(world, 10, [&] { sag = std::min(sag, world.position(*last).y); });
    EXPECT_GE(sag, -1e-9);  // the issue asks for 1e-3
    EXPECT_NEAR(world.reaction(world.joint_ids()[0]).torque, 20 * gravity * 10, 1e-6);
}

TEST(Wheels, CarryACarOnTheirSprings) {
    World world = mechanism_world();
    const BodyId car = world.add(Body{.position = {0, 1}, .mass = 10, .shapes = {{.geometry = Box{2, 0.5}}}});
    for (const double x : {-0.8, 0.8}) {
        const BodyId wheel = world.add(Body{.kind = Kind::fixed, .position = {x, 0.5}, .radius = 0.3});
        world.add(Joint{.a = car,
                        .b = wheel,
                        .at = Vec2{x, 0.5},
                        .type = WheelJoint{.spring = JointSpring{.stiffness = 2000, .damping = 300}}});
    }
    const double mass = world.masses()[0];
    watch(world, 5, [] {});
    EXPECT_NEAR(world.position(car).y, 1 - mass * gravity / 4000, 1e-6);
    EXPECT_NEAR(world.position(car).x, 0, 1e-9);
}

/// truth.json, mech.atwood: acceleration and tension; acceleration with a disc of 1 kg as pulley.
TEST(Pulleys, MakeAtwoodsMachine) {
    World world = mechanism_world();
    const BodyId a = world.add(Body{.position = {-1, 0}, .mass = 3}),
                 b = world.add(Body{.position = {1, 0}, .mass = 2});
    world.add(Joint{.a = a, .b = b, .type = PulleyJoint{.ground_a = {-1, 2}, .ground_b = {1, 2}}});
    watch(world, 0.5, [] {});
    EXPECT_NEAR(world.velocity(b).y, 0.5 * truth("mech.atwood")[0].get<double>(), 1e-12);
    EXPECT_NEAR(world.position(a).y, -0.125 * truth("mech.atwood")[0].get<double>(), 1e-12);
    EXPECT_NEAR(world.reaction(world.joint_ids()[0]).force.y, truth("mech.atwood")[1].get<double>(), 1e-9);
}
TEST(Gears, MakeAtwoodsMachineWithAHeavyPulley) {
    World world = mechanism_world();
    const BodyId pulley = world.add(Body{.position = {0, 2}, .mass = 1, .radius = 0.5});
    const BodyId a = world.add(Body{.position = {-0.5, 0}, .mass = 3}),
                 b = world.add(Body{.position = {0.5, 0}, .mass = 2});
    world.add(Joint{.b = pulley, .at = Vec2{0, 2}, .type = RevoluteJoint{}});
    world.add(Joint{.a = a, .b = pulley, .type = GearJoint{.ratio = 0.5, .axis_a = Vec2{0, -1}}});
    world.add(Joint{.a = b, .b = pulley, .type = GearJoint{.ratio = 0.5, .axis_a = Vec2{0, 1}}});
    watch(world, 0.5, [] {});
    EXPECT_NEAR(std::abs(world.velocity(a).y), 0.5 * truth("mech.atwood")[2].get<double>(), 1e-12);
    EXPECT_NEAR(world.velocity(b).y, 0.5 * truth("mech.atwood")[2].get<double>(), 1e-12);
}

TEST(Gears, KeepTheirRatio) {
    World world = mechanism_world({}, {});
    const BodyId a = world.add(Body{.position = {0, 0}, .mass = 1, .radius = 1});
    const BodyId b = world.add(Body{.position = {3, 0}, .mass = 4, .radius = 2});
    world.add(Joint{.b = a, .at = Vec2{0, 0}, .type = RevoluteJoint{.motor = JointMotor{.speed = 1}}});
    world.add(Joint{.b = b, .at = Vec2{3, 0}, .type = RevoluteJoint{}});
    world.add(Joint{.a = a, .b = b, .type = GearJoint{.ratio = 2}});
    watch(world, 100, [] {});
    EXPECT_NEAR(world.angle(a), 100, 1e-6);
    EXPECT_NEAR(world.angle(a) + 2 * world.angle(b), 0, 1e-9);
}

TEST(DryFriction, IsTheSameInEveryDirection) {
    for (const double angle : {0.0, 0.7, 2.0}) {
        World world = mechanism_world({}, {});
        const Vec2 way{std::cos(angle), std::sin(angle)};
        const BodyId b = world.add(Body{.velocity = 3 * way, .angular_velocity = 2, .mass = 2, .radius = 1});
        world.add(Joint{.b = b, .type = FrictionJoint{.maximum_force = 4, .maximum_torque = 1}});
        watch(world, 3, [] {});
        EXPECT_NEAR(dot(world.position(b), way), 2.25, 1e-3) << angle;  // v²/(2F/m)
        EXPECT_NEAR(cross(world.position(b), way), 0, 1e-9) << angle;
        EXPECT_EQ(length(world.velocity(b)), 0) << angle;
        EXPECT_NEAR(energy(world).heat.joint_friction, 9 + 2, 1e-9) << angle;
    }
}

TEST(MotorJoints, HoldAVelocity) {
    World world = mechanism_world();
    const BodyId b = world.add(Body{.mass = 1, .radius = 1});
    world.add(Joint{.b = b, .type = MotorJoint{.velocity = {1, 0.5}, .angular_velocity = 2, .maximum_force = 50}});
    watch(world, 2, [] {});
    EXPECT_NEAR(world.velocity(b).x, 1, 1e-6);
    EXPECT_NEAR(world.velocity(b).y, 0.5, 1e-6);
    EXPECT_NEAR(world.angular_velocity(b), 2, 1e-9);
}

TEST(Handles, PullABodyToTheHandAndNoHarderThanTheyMay) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(Body{.mass = 1, .radius = 1});
    const JointId hand = world.add(Joint{.b = b, .anchor_a = {3, 4}, .type = DragHandle{.maximum = 10}});
    world.step(frame);
    EXPECT_NEAR(length(world.reaction(hand).force), 10, 1e-9);
    Joint stronger = world.joint(hand);
    std::get<DragHandle>(stronger.type).maximum.reset();
    world.set(hand, stronger);
    watch(world, 5, [] {});
    EXPECT_NEAR(world.position(b).x, 3, 1e-3);
    EXPECT_NEAR(world.position(b).y, 4, 1e-3);
    Joint moved = world.joint(hand);
    moved.anchor_a = {0, 0};
    world.set(hand, moved);
    watch(world, 5, [] {});
    EXPECT_NEAR(length(world.position(b)), 0, 1e-3);
}

// A hand at the point that it grips pulls nowhere yet. Its spring was made for a pull along x, or along the rounding of
// the two places, so that a stick held at its end hung on one four times as stiff when the world was turned by 90°.
TEST(Handles, AreAsStiffWhicheverWayAStickIsTurned) {
    const auto stiffness = [](double angle) {
        World world = mechanism_world();
        const BodyId stick = world.add(
            Body{.position = {1, 2}, .angle = angle, .shapes = {{.geometry = Box{.width = 1, .height = 0.1}}}});
        const Vec2 end = world.position(stick) + 0.5 * Vec2{std::cos(angle), std::sin(angle)};
        const Joint hand = world.joint(world.add(Joint{.b = stick, .at = end, .type = DragHandle{}}));
        return std::get<DragHandle>(hand.type).spring->stiffness;
    };
    for (const double angle : {0.1, 0.7, 1.2, pi / 2, 3.0})
        EXPECT_NEAR(stiffness(angle) / stiffness(0), 1, 1e-12) << angle;
}

/// A hand of 5 N has 5 N times the way to give, less what its spring lacks of them at its end. It had been said to
/// store ½ k C², a thousand times as much here, and the rest was the method's.
TEST(Handles, StoreWhatTheyCanGive) {
    constexpr double most = 5, far = 10;
    World world = mechanism_world({}, {});
    const JointSpring spring{.stiffness = 1000, .damping = 5};
    world.add(Joint{.b = world.add(Body{.mass = 1, .radius = 0.1}),
                    .anchor_a = {far, 0},
                    .type = DragHandle{.spring = spring, .maximum = most}});
    EXPECT_NEAR(energy(world).spring, most * far - 0.5 * most * most / spring.stiffness, 1e-12);
    run(world, 1, frame);
    // From rest at 5 m/s² for 1 s.
    EXPECT_NEAR(energy(world).kinetic, most * 2.5, 1e-9);
    EXPECT_NEAR(energy(world).residual, 0, 1e-9);
    EXPECT_NEAR(energy(world).heat.joint_damping, 0, 1e-9);
}

TEST(Filters, LetTwoBodiesPass) {
    for (const bool joined : {false, true}) {
        World world = mechanism_world({}, {});
        const BodyId a = world.add(Body{.velocity = {1, 0}, .radius = 0.5}),
                     b = world.add(Body{.position = {3, 0}, .radius = 0.5});
        if (joined) world.add(Joint{.a = a, .b = b, .type = FilterJoint{}});
        run(world, 5, frame);
        EXPECT_NEAR(world.position(a).x, joined ? 5 : 2, 1e-9);
    }
}

TEST(Breaking, HappensAtTheForceThatWasGiven) {
    World world = mechanism_world({.sleep = false});
    const BodyId b = world.add(Body{.position = {1, 0}, .mass = 1});
    // T = 3 m g sin(angle below the horizontal): 2 m g at sin = 2/3
    const JointId rope = world.add(Joint{.b = b, .type = DistanceJoint{}, .break_force = 2 * gravity});
    int broke = 0;
    double depth = 0;
    watch(world, 2, [&] {
        if (!world.events().broken.empty()) {
            EXPECT_EQ(world.events().broken, std::vector{rope});
            ++broke, depth = -world.position(b).y;
        }
    });
    EXPECT_EQ(broke, 1);
    EXPECT_NEAR(depth, 2.0 / 3, 0.05);
    EXPECT_FALSE(world.contains(rope));
    EXPECT_THROW(world.reaction(rope), Error);
    EXPECT_TRUE(world.joints().empty());
}

/// A linkage that is redundant, and one that cannot be.
TEST(Redundant, JointsHoldAsOneDoes) {
    World world = mechanism_world();
    const BodyId b = world.add(rod({0.5, 0}, 1));
    for (int i = 0; i < 3; ++i) world.add(Joint{.b = b, .at = Vec2{}, .type = RevoluteJoint{}});
    World one = mechanism_world();
    const BodyId c = one.add(rod({0.5, 0}, 1));
    one.add(Joint{.b = c, .at = Vec2{}, .type = RevoluteJoint{}});
    watch(world, 5, [] {});
    run(one, 5, frame);
    EXPECT_NEAR(world.angle(b), one.angle(c), 1e-6);
    EXPECT_LE(gaps(world), 1e-8);
}
TEST(Redundant, RingOfWeldsFallsAsOne) {
    World world = mechanism_world();
    std::vector<BodyId> ring;
    for (int i = 0; i < 12; ++i) ring.push_back(world.add(rod({std::cos(pi / 6 * i), std::sin(pi / 6 * i)}, 0.5)));
    for (std::size_t i = 0; i < 12; ++i) {
        const double angle = pi / 6 * (static_cast<double>(i) + 0.5);
        world.add(Joint{
            .a = ring[i], .b = ring[(i + 1) % 12], .at = Vec2{std::cos(angle), std::sin(angle)}, .type = WeldJoint{}});
    }
    world.set_velocity(ring[0], {0, 0}, 3);
    watch(world, 2, [] {});
    EXPECT_LE(gaps(world), 1e-7);
}
TEST(Contradictory, RodsSettleInTheMiddle) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(Body{.position = {1, 0}, .mass = 1});
    world.add(Joint{.b = b, .type = DistanceJoint{.length = 1}});
    world.add(Joint{.b = b, .type = DistanceJoint{.length = 1.2}});
    watch(world, 2, [] {});
    EXPECT_NEAR(length(world.position(b)), 1.1, 1e-6);
    EXPECT_LE(length(world.velocity(b)), 1e-6);
}

class BigRatios : public testing::TestWithParam<double> {};
TEST_P(BigRatios, AreKept) {
    World world = mechanism_world();
    add_chain(world, 10, 0.5, GetParam());
    double worst = 0;
    watch(world, 5, [&] { worst = std::max(worst, gaps(world)); });
    EXPECT_LE(worst, 1e-7);  // of 5 m
}
INSTANTIATE_TEST_SUITE_P(Loads, BigRatios, testing::Values(1e-8, 1e4, 1e6, 1e8));

TEST(Gaps, AreClosedWithoutASpeed) {
    World world = mechanism_world({}, {});
    const BodyId b = world.add(Body{.position = {1, 0}, .mass = 1});
    world.add(Joint{.b = b, .type = DistanceJoint{}});
    world.set_position(b, {1.5, 0}, 0);
    run(world, 1, frame);
    EXPECT_NEAR(length(world.position(b)), 1, 1e-9);
    EXPECT_NEAR(length(world.velocity(b)), 0, 1e-9);
}

/// A hand far away, of so many newtons at most.
DragHandle weak_hand(double most, double stiffness = 1000) {
    return {.spring = JointSpring{.stiffness = stiffness, .damping_ratio = 0}, .maximum = most};
}
// As a constant force, which half kicks follow to rounding: of some hundred joules.
TEST(Handle, AtItsLargestForcePullsAsHardWhicheverWayItsBodyGoes) {
    for (const double v : {10.0, -10.0})
        for (const double stiffness : {10.0, 1000.0, 1e5}) {
            World world = mechanism_world({}, {});
            const BodyId b = world.add(Body{.position = {20, 0}, .velocity = {v, 0}, .mass = 1});
            world.add(Joint{.b = b, .type = weak_hand(1, stiffness)});
            run(world, 1, frame);
            EXPECT_NEAR(world.position(b).x, 20 + v - 0.5, 1e-9) << v << ", " << stiffness << " N/m";
            EXPECT_NEAR(world.velocity(b).x, v - 1, 1e-9);
            EXPECT_LE(std::abs(energy(world).residual), 1e-10);
        }
}
// A thousandth of a newton on a kilogram for a second: no more than that may change.
TEST(Handle, AtItsLargestForceLeavesItsMechanismItsMotion) {
    for (const double v : {10.0, -10.0}) {
        World world = mechanism_world({}, {});
        const BodyId a = world.add(Body{.position = {20, 0}, .velocity = {v, 1.5}, .mass = 1});
        const BodyId b = world.add(Body{.position = {21, 0}, .velocity = {v, -1.5}, .mass = 1});
        world.add(Joint{.a = a, .b = b, .type = DistanceJoint{}});
        world.add(Joint{.b = b, .type = weak_hand(1e-3)});
        run(world, 1, frame);
        EXPECT_NEAR(length(world.velocity(a) - world.velocity(b)), 3, 1e-3) << v;
        EXPECT_LE(std::abs(energy(world).residual), 1e-6);
    }
}

// Its damping acted at either body's own anchor, and turned the pair: 6 % of their angular momentum in a second, at
// every step.
TEST(Handle, BetweenTwoBodiesMakesNoSpin) {
    for (const double damping : {0.0, 1.9}) {
        World world = mechanism_world({}, {});
        const BodyId stick =
            world.add(Body{.angular_velocity = -2.7, .shapes = {{.geometry = Capsule{{-0.4, 0}, {0.4, 0}, 0.15}}}});
        const BodyId ball = world.add(Body{.position = {1.46, 0}, .radius = 0.4});
        world.add(Joint{.a = stick,
                        .b = ball,
                        .at = Vec2{0.78, 0.02},
                        .type = DragHandle{.spring = JointSpring{.stiffness = 4, .damping = damping}}});
        const double before = momentum_balance(world).total.angular;
        run(world, 2, frame);
        EXPECT_NEAR(momentum_balance(world).total.angular, before, 1e-13);  // rounding
        EXPECT_GE(length(world.velocity(ball)), 0.1);                       // it pulled
        EXPECT_LE(std::abs(energy(world).residual), 1e-4);                  // of second order
    }
}
// The mass that a frequency is for was another one with a bound that was never reached: 19 times the stiffness.
TEST(Handle, HasOneStiffnessForAFrequencyWhateverDampsOrBoundsIt) {
    const auto stiffness = [](double ratio, std::optional<double> maximum) {
        World world = mechanism_world({}, {});
        const Body box{.shapes = {{.geometry = Box{0.6, 0.3}}}};
        Body other = box;
        other.position = {2, 0};
        const JointSpring spring{.frequency = 1, .damping_ratio = ratio};
        const DragHandle handle{.spring = spring, .maximum = maximum};
        const JointId id = world.add(Joint{.a = world.add(box), .b = world.add(other), .type = handle});
        return std::get<DragHandle>(world.joint(id).type).spring->stiffness;
    };
    EXPECT_GT(stiffness(0, {}), 0);
    EXPECT_EQ(stiffness(0, {}), stiffness(0, 1e9));
    EXPECT_EQ(stiffness(0, {}), stiffness(1, {}));
}
// Its axes turned with a body that spins, which for the spring alone is of no use: 13 times the error in energy.
TEST(Handle, WithoutDampingKeepsEnergyAsARodDoes) {
    const auto error_of = [](const JointType& type) {
        World world = mechanism_world({}, {});
        const Body box{.angular_velocity = 7, .shapes = {{.geometry = Box{0.6, 0.3}}}};
        const BodyId first = world.add(box);
        Body other = box;
        other.position = {3, 0}, other.velocity = {-0.4, 1}, other.angular_velocity = -3;
        world.add(
            Joint{.a = first, .b = world.add(other), .anchor_a = {0.2, 0.1}, .anchor_b = {-0.2, -0.1}, .type = type});
        double most = 0;
        run(world, 5, frame, [&](const World& w) { most = std::max(most, std::abs(energy(w).residual)); });
        return most;
    };
    const JointSpring spring{.stiffness = 60};
    // Of the same force along another curve of places: twice what a distance of 1 mm makes is of its kind.
    EXPECT_LE(error_of(DragHandle{.spring = spring}), 2 * error_of(DistanceJoint{.length = 1e-3, .spring = spring}));
}

}  // namespace
}  // namespace carom
