// Joints in a world: what is refused, snapshots, sleep, contacts, the ledger.

#include <string>

#include "joints.hpp"

namespace carom {
namespace {

using namespace test;

std::string error_of(const std::function<void()>& f) {
    try {
        f();
    } catch (const Error& e) {
        return e.what();
    }
    return "none";
}

TEST(BadJoints, AreRefusedByName) {
    World world = mechanism_world();
    const BodyId floor = world.add(Body{.kind = Kind::fixed}), wall = world.add(Body{.kind = Kind::fixed});
    const BodyId a = world.add(Body{.radius = 1}), b = world.add(Body{.position = {3, 0}});
    const auto refused = [&](const Joint& joint) { return error_of([&] { world.add(joint); }); };
    const auto says = [](const std::string& error, const char* words) {
        EXPECT_NE(error.find(words), std::string::npos) << error;
    };
    says(refused({.a = floor, .b = wall, .type = WeldJoint{}}), "must hold a dynamic body");
    says(refused({.b = wall, .type = WeldJoint{}}), "must hold a dynamic body");
    says(refused({.a = a, .b = a, .type = WeldJoint{}}), "must be another body than a");
    says(refused({.name = "rod", .a = a, .b = b, .anchor_b = {-3, 0}, .type = DistanceJoint{}}),
         "Joint 'rod'.length must be > 0 m");
    says(refused({.a = a, .b = b, .type = DistanceJoint{.length = 1, .limits = {.upper = 2}}}), "a rope has");
    says(refused({.a = a, .b = b, .type = DistanceJoint{.limits = {.upper = -1}}}), "limits.upper must be");
    says(refused({.a = a, .b = b, .type = RevoluteJoint{.limits = {1, -1}}}), "limits.upper must be at least lower");
    says(refused({.a = a, .b = b, .type = PrismaticJoint{.axis = {0, 0}}}), "axis must not be (0, 0)");
    says(refused({.a = a, .b = b, .type = GearJoint{.ratio = 0}}), "ratio must not be 0");
    says(refused({.a = a, .b = b, .type = RevoluteJoint{.spring = JointSpring{.stiffness = -1}}}), "stiffness");
    says(refused({.a = a, .b = b, .type = RevoluteJoint{.spring = JointSpring{.stiffness = 1, .frequency = 1}}}),
         "either a stiffness");
    says(refused({.a = a, .b = b, .type = RevoluteJoint{.spring = JointSpring{.damping_ratio = 1}}}),
         "needs a frequency");
    says(refused({.b = b, .type = RevoluteJoint{.spring = JointSpring{.frequency = 1}}}), "neither body can turn");
    says(refused({.a = a, .b = b, .type = WeldJoint{}, .break_force = 0}), "break_force must be");
    says(refused({.a = a, .b = b, .anchor_a = {NAN, 0}, .type = WeldJoint{}}), "anchor_a");
    world.add(Joint{.name = "pin", .a = a, .b = b, .type = RevoluteJoint{}});
    says(refused({.name = "pin", .a = a, .b = b, .type = RevoluteJoint{}}), "must be unique");
    says(error_of([&] { world.find_joint("pim"); }), "did you mean 'pin'");
    says(error_of([&] { world.reaction({}); }), "no joint ever had");
    EXPECT_EQ(world.joints().size(), 1u);
    World textbook;
    textbook.add(Joint{.b = textbook.add(Body{}), .type = RevoluteJoint{}});
    says(error_of([&] { textbook.step(frame); }), "joints need the solver 'softstep'");
}

/// A point has no moment of inertia: on a hinge beside it it hung in the air for ever, and nothing was said.
TEST(BadJoints, ThatHoldAPointStill) {
    World world = mechanism_world();
    const BodyId bob = world.add(Body{.position = {1, 0}, .name = "bob"}), other = world.add(Body{.position = {2, 0}});
    const BodyId disc = world.add(Body{.position = {0, 5}, .radius = 1});
    const BodyId crank = world.add(Body{.kind = Kind::driven, .position = {0, 9}});
    const auto joined = [&](const Joint& joint) { return error_of([&] { world.remove(world.add(joint)); }); };
    const auto still = [&](const Joint& joint) {
        EXPECT_NE(joined(joint).find("has no moment of inertia: a "), std::string::npos) << joined(joint);
    };
    const auto fine = [&](const Joint& joint) { EXPECT_EQ(joined(joint), "none"); };
    still({.name = "pin", .b = bob, .at = Vec2{0, 0}, .type = RevoluteJoint{}});
    EXPECT_TRUE(joined({.name = "pin", .b = bob, .at = Vec2{0, 0}, .type = RevoluteJoint{}})
                    .starts_with("Joint 'pin'.b must be a body that turns, and 'bob' has no moment of inertia"));
    still({.a = bob, .b = other, .at = Vec2{1, 0}, .type = RevoluteJoint{}});
    still({.a = bob, .b = other, .at = Vec2{2, 0}, .type = RevoluteJoint{}});
    still({.a = disc, .b = bob, .at = Vec2{0, 5}, .type = RevoluteJoint{}});
    still({.a = crank, .b = bob, .at = Vec2{0, 9}, .type = RevoluteJoint{}});
    still({.b = bob, .at = Vec2{0, 0}, .type = WheelJoint{}});
    still({.b = bob, .at = Vec2{0, 0}, .type = WeldJoint{.spring = JointSpring{.stiffness = 1}}});
    still({.a = disc, .b = bob, .at = Vec2{1, 0}, .type = WeldJoint{}});
    still({.a = bob, .b = disc, .at = Vec2{1, 0}, .type = WeldJoint{}});

    const BodyId spun = world.add(Body{.position = {0, -5}, .angular_velocity = 1});  // and goes on
    fine({.b = spun, .at = Vec2{1, 0}, .type = RevoluteJoint{}});
    fine({.b = bob, .at = Vec2{1, 0}, .type = RevoluteJoint{}});
    fine({.b = bob, .at = Vec2{1 + 1e-12, 0}, .type = RevoluteJoint{}});  // rounding
    fine({.a = disc, .b = bob, .at = Vec2{1, 0}, .type = RevoluteJoint{}});
    fine({.a = disc, .b = bob, .at = Vec2{0.5, 3}, .type = RevoluteJoint{}});  // a gondola that stays upright
    fine({.a = crank, .b = bob, .at = Vec2{0.5, 3}, .type = RevoluteJoint{}});
    fine({.b = disc, .at = Vec2{0, 0}, .type = RevoluteJoint{}});
    fine({.b = bob, .at = Vec2{0, 0}, .type = PrismaticJoint{}});
    fine({.b = bob, .type = DistanceJoint{}});
    fine({.b = bob, .at = Vec2{0, 0}, .type = WeldJoint{}});
    fine({.a = bob, .b = other, .at = Vec2{0, 0}, .type = WeldJoint{}});

    // As it was when the joint was made, or is made later.
    const JointId pin = world.add(Joint{.b = disc, .at = Vec2{0, 0}, .type = RevoluteJoint{}});
    EXPECT_NE(error_of([&] {
                  world.set(disc, Body{.position = {0, 5}});
              }).find("no moment of inertia"),
              std::string::npos);
    EXPECT_EQ(error_of([&] { world.set(disc, Body{.position = {0, 5}, .moment_of_inertia = 1}); }), "none");
    const Joint hinge = world.joint(world.add(Joint{.b = bob, .at = Vec2{1, 0}, .type = RevoluteJoint{}}));
    Joint moved = hinge;
    moved.at = Vec2{0, 0}, moved.anchor_a = moved.anchor_b = {};
    EXPECT_NE(error_of([&] { world.set(pin, moved); }).find("no moment of inertia"), std::string::npos);
}

/// A motor without a maximum turns whatever hangs on it, and a mass of 1e8 kg stops nothing from being finite.
TEST(BadJoints, ThatAreNotRefusedAreFinite) {
    World world = mechanism_world();
    const BodyId heavy = world.add(Body{.position = {5, 0}, .mass = 1e8, .moment_of_inertia = 1e8});
    world.add(Joint{.b = heavy, .at = Vec2{}, .type = RevoluteJoint{.motor = JointMotor{.speed = 1}}});
    watch(world, 2, [] {});
    EXPECT_NEAR(world.angle(heavy), 2, 1e-2);
}

World mobile() {
    World world = mechanism_world();
    const auto links = add_chain(world, 6, 0.4, 3);
    world.add(Joint{.name = "spring",
                    .b = links[3],
                    .anchor_a = {0, -3},
                    .type = DistanceJoint{.spring = JointSpring{.stiffness = 30}}});
    world.add(Joint{.name = "thread", .b = links[5], .anchor_a = {3, 0}, .type = DistanceJoint{}, .break_force = 60});
    world.add(Joint{.a = links[1], .b = links[4], .type = DistanceJoint{.limits = {.lower = 0.6, .upper = 1.1}}});
    world.add(Joint{.a = links[2], .b = links[3], .type = FrictionJoint{.maximum_torque = 0.2}});
    return world;
}

TEST(Snapshots, OfMechanismsGoOnWithTheSameBits) {
    World world = mobile();
    run(world, 2.5, frame);
    World copy = world, other = mobile();
    restore_from(world, other);
    EXPECT_EQ(other.joints().size(), world.joints().size());
    run(world, 2, frame), run(copy, 2, frame), run(other, 2, frame);
    EXPECT_EQ(state_hash(copy), state_hash(world));
    EXPECT_EQ(state_hash(other), state_hash(world));
    EXPECT_TRUE(saved(other) == saved(world));
}

/// The factor of a sheet's matrix lives on from step to step while that moves as good as not, and is made anew after a
/// snapshot.
TEST(Snapshots, OfASheetGoOnWithTheSameBits) {
    for (const double w : {1e-5, 1e-3, 1.0}) {
        const auto sheet = [w] { return hinged_sheet(12, [](int column) { return column == 0; }, w, {}); };
        World world = sheet(), other = sheet();
        run(world, 0.25, frame);
        restore_from(world, other);
        run(world, 0.25, frame), run(other, 0.25, frame);
        EXPECT_EQ(state_hash(other), state_hash(world)) << w << " rad/s";
        EXPECT_LE(gaps(world), 264 * 0.5e-9) << "1e-9 of its size is what a hinge may gape before it is put right";
    }
}

/// Which way of a taut bridge is tried, and where it begins, follows from how it went in the substeps before; and the
/// slack of one that is pinned to what is fixed from where that is.
class TautBridges : public testing::TestWithParam<Kind> {};
TEST_P(TautBridges, GoOnWithTheSameBits) {
    const auto bridge = [] {
        World world = mechanism_world();
        std::optional<BodyId> last;
        for (int i = 0; i <= 40; ++i) {
            const BodyId plank = world.add(Body{.kind = i < 40 ? Kind::dynamic : GetParam(),
                                                .position = {i + 0.5, 0},
                                                .shapes = {{.geometry = Box{1, 0.25}, .density = 20}}});
            world.add(Joint{.a = last, .b = plank, .at = Vec2{1.0 * i, 0}, .type = RevoluteJoint{}});
            last = plank;
        }
        return world;
    };
    World world = bridge(), other = bridge();
    for (int i = 0; i < 20; ++i) {
        run(world, 3 * frame, frame);
        restore_from(world, other);
        run(world, 2 * frame, frame), run(other, 2 * frame, frame);
        ASSERT_EQ(state_hash(other), state_hash(world)) << i;
        ASSERT_LE(gaps(world), GetParam() == Kind::fixed ? 40 * 1.001e-5 : 1e-7);
    }
}
INSTANTIATE_TEST_SUITE_P(Snapshots, TautBridges, testing::Values(Kind::fixed, Kind::driven));

/// One that hangs still is corrected now and then by the factor that it has, which a snapshot does not know; for long
/// nothing becomes of what it is let be between these times.
TEST(Snapshots, OfASheetThatHangsStillGoOnWithTheSameBits) {
    const auto sheet = [] { return hinged_sheet(20, [](int column) { return column == 9 || column == 10; }); };
    World world = sheet(), other = sheet();
    run(world, 0.5, frame);
    for (int i = 0; i < 20; ++i) {
        restore_from(world, other);
        run(world, 3 * frame, frame), run(other, 3 * frame, frame);
        EXPECT_EQ(state_hash(other), state_hash(world)) << i;
    }
    watch(world, 5, [] {});
    EXPECT_LE(gaps(world), 759 * 1e-11);
    EXPECT_LE(energy(world).kinetic, 1e-16);
}

TEST(Snapshots, KnowWhatBroke) {
    World world = mobile();
    int steps = 0;
    while (world.contains(world.joint_ids().empty() ? JointId{} : JointId{9}) && ++steps < 600) world.step(frame);
    ASSERT_FALSE(world.contains(JointId{9}));
    const std::string bytes = saved(world);
    World other = mobile();
    Loader loader(bytes);
    other.restore(loader);
    EXPECT_FALSE(other.contains(JointId{9}));
    run(world, 1, frame), run(other, 1, frame);
    EXPECT_EQ(state_hash(other), state_hash(world));
}

TEST(Removal, OfABodyTakesItsJoints) {
    World world = mechanism_world();
    const auto links = add_chain(world, 3, 1);
    run(world, 0.5, frame);
    world.remove(links[1]);
    EXPECT_EQ(world.joints().size(), 1u);
    const double before = world.velocity(links[2]).y;
    watch(world, 0.5, [] {});
    EXPECT_NEAR(world.velocity(links[2]).y, before - 0.5 * gravity, 1e-9);
}

/// Whatever a joint holds sleeps with it, and wakes with it.
// Mechanisms of other shapes before, between and after others come and go; whoever is not among them goes on with the
// same bits, though the order in which his joints are solved is not looked for again.
TEST(Edits, OfOtherMechanismsChangeNoBit) {
    const auto start = [](World& world) {
        std::vector<BodyId> kept;
        const auto add = [&](Vec2 at, int rods, bool is_star = false) {
            std::vector<BodyId> chain;
            for (int i = 0; i < rods; ++i) {
                chain.push_back(world.add(rod(at + Vec2{i + 0.5, 0}, 1)));
                const std::size_t to = is_star ? 0 : chain.size() - 2;
                world.add(Joint{.a = i > 0 ? std::optional(chain[to]) : std::nullopt,
                                .b = chain.back(),
                                .at = at + Vec2{double(i), 0},
                                .type = RevoluteJoint{}});
            }
            return chain;
        };
        std::vector<BodyId> gone = add({0, 10}, 3);
        for (const BodyId id : add({0, 0}, 7)) kept.push_back(id);
        for (const BodyId id : add({0, 20}, 4)) gone.push_back(id);
        for (const BodyId id : add({20, 0}, 7, true)) kept.push_back(id);
        return std::pair(kept, gone);
    };
    World world = mechanism_world(), edited = mechanism_world();
    const auto [kept, gone] = start(world);
    start(edited);
    run(world, 0.5, frame), run(edited, 0.5, frame);
    for (const BodyId id : gone) edited.remove(id);
    run(world, 0.5, frame), run(edited, 0.5, frame);
    add_chain(edited, 2, 3);
    run(world, 0.5, frame), run(edited, 0.5, frame);
    for (const BodyId id : kept) {
        EXPECT_EQ(edited.position(id), world.position(id));
        EXPECT_EQ(edited.angle(id), world.angle(id));
    }
}

TEST(Sleep, IsSharedByTheJoined) {
    World world = mechanism_world({.statics = false});
    world.add(HalfPlane{});
    const BodyId box =
        world.add(Body{.position = {0, 0.5}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.6});
    const BodyId ball = world.add(Body{.position = {3, 2}, .mass = 0.1, .radius = 0.2});
    world.add(Joint{.a = box, .b = ball, .type = WeldJoint{}});
    watch(world, 3, [] {});
    EXPECT_TRUE(world.asleep(box) && world.asleep(ball));
    world.set_velocity(ball, {0, 1}, 0);
    world.step(frame);
    EXPECT_FALSE(world.asleep(box) || world.asleep(ball));
}

// Which way friction in a plane acts is that of a motion, and who sleeps has none: his joint went on to report the
// force of before along other rows, and the floor of the books bore the weight.
TEST(Sleep, FrictionInAPlaneBearsWhatItBoreAwake) {
    World world = mechanism_world();
    const BodyId load = world.add(Body{.position = {1, 2}, .mass = 2, .radius = 0.1});
    const JointId friction =
        world.add(Joint{.b = load, .at = Vec2{1, 2}, .type = FrictionJoint{.maximum_force = 100, .maximum_torque = 1}});
    watch(world, 2, [] {});
    EXPECT_TRUE(world.asleep(load));
    EXPECT_NEAR(world.reaction(friction).force.x, 0, 1e-10);
    EXPECT_NEAR(world.reaction(friction).force.y, 2 * gravity, 1e-10);
    EXPECT_NEAR(momentum_balance(world).held.linear.y, 2 * 2 * gravity, 1e-9);
    EXPECT_LE(length(momentum_balance(world).residual.linear), 1e-9);
}

// It hung in the air for ever.
TEST(Edits, OfWhatAJointHoldsStirsWhoIsLeft) {
    World world = mechanism_world();
    const BodyId left = world.add(Body{.position = {0, -1}, .mass = 1});
    const BodyId other = world.add(Body{.position = {3, -1}, .mass = 1});
    const JointId rod = world.add(Joint{.b = left, .type = DistanceJoint{}});
    world.add(Joint{.b = other, .anchor_a = {3, 0}, .type = DistanceJoint{}});
    run(world, 1, frame);
    Joint joint = world.joint(rod);
    joint.b = other, joint.anchor_a = {2, 0}, joint.type = DistanceJoint{};
    world.set(rod, joint);
    run(world, 1, frame);
    EXPECT_NEAR(world.position(left).y, -1 - gravity / 2, 1e-9);
}

TEST(Collisions, AreOffBetweenTheJoinedUnlessAsked) {
    for (const bool collide : {false, true}) {
        World world = mechanism_world({}, {});
        const BodyId a = world.add(Body{.velocity = {1, 0}, .radius = 0.5}),
                     b = world.add(Body{.position = {3, 0}, .radius = 0.5});
        world.add(Joint{.a = a, .b = b, .type = DistanceJoint{.limits = {.upper = 10}}, .collide = collide});
        run(world, 5, frame);
        EXPECT_NEAR(world.position(a).x, collide ? 2 : 5, 1e-9);
    }
}

TEST(Ledger, ClosesForRandomMechanisms) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        World world = mechanism_world();
        world.add(HalfPlane{.point = {0, -3}, .side = {.restitution = 0.3, .friction = 0.5}});
        const auto somewhere = [&] { return Vec2{random.uniform(-2, 2), random.uniform(-2, 2)}; };
        for (int i = 0; i < 8; ++i)
            world.add(Body{.kind = i == 6   ? Kind::fixed
                                   : i == 7 ? Kind::driven
                                            : Kind::dynamic,
                           .position = somewhere(),
                           .velocity = i == 6 ? Vec2{} : somewhere(),
                           .angular_velocity = i == 6 ? 0 : random.uniform(-3, 3),
                           .mass = random.uniform(0.2, 3),
                           .radius = random.uniform(0.1, 0.3),
                           .restitution = 0.3,
                           .friction = 0.4});
        const JointSpring spring{.stiffness = random.uniform(1, 100), .damping = random.uniform(0, 2)};
        const JointMotor motor{.speed = random.uniform(-3, 3), .maximum = random.uniform(0, 20)};
        const JointLimits limits{-0.4, 0.6};
        const JointType types[] = {DistanceJoint{},
                                   DistanceJoint{.limits = {.upper = 2.5}},
                                   DistanceJoint{.spring = spring},
                                   RevoluteJoint{.motor = motor, .limits = limits},
                                   RevoluteJoint{.spring = spring},
                                   PrismaticJoint{.spring = spring, .limits = limits},
                                   WeldJoint{},
                                   WheelJoint{.spring = spring, .motor = motor},
                                   MotorJoint{.velocity = {1, 0}, .maximum_force = 3, .maximum_torque = 1},
                                   GearJoint{.ratio = -1.5},
                                   PulleyJoint{.ground_a = {-1, 4}, .ground_b = {1, 4}},
                                   FrictionJoint{2, 0.5},
                                   DragHandle{.maximum = 30}};
        for (int i = 0; i < 5; ++i) {
            const auto a = static_cast<std::size_t>(random.uniform(0, 8)),
                       b = static_cast<std::size_t>(random.uniform(0, 6));
            if (a == b) continue;
            const JointType& type = types[static_cast<std::size_t>(random.uniform(0, 13))];
            Joint joint{.a = world.ids()[a], .b = world.ids()[b], .type = type, .collide = random.uniform() < 0.5};
            if (!std::holds_alternative<DistanceJoint>(type))
                joint.at = 0.5 * (world.positions()[a] + world.positions()[b]);
            if (random.uniform() < 0.2) joint.a.reset();
            world.add(joint);
        }
        watch(world, 0.5, [] {});
    }
}

}  // namespace
}  // namespace carom
