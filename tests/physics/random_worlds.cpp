// Crowds of all shapes on all kinds of ground, with all kinds of joints and without, as nobody would think of them.

#include "choices.hpp"
#include "in_units.hpp"
#include "joints.hpp"
#include "trials.hpp"

namespace carom::test {
namespace {

Geometry random_geometry(Choices& any) {
    const double s = any.chance(0.15) ? any.magnitude(0.2, 0.7) : 0.7;
    const double width = s * any.between(0.3, 1.2), height = s * any.between(0.3, 1.2);
    return any.one_of<Geometry>({Disc{.radius = 0.5 * width}, Box{width, height},
                                 Box{.width = width, .height = height, .rounding = 0.1 * s},
                                 Capsule{{-0.4 * width, 0}, {0.4 * width, 0}, 0.2 * height},
                                 Hull{{{-width, 0}, {0, -height}, {width, 0.1}, {0.2, height}}, 0.02},
                                 Polygon{{{-s, -s}, {s, -s}, {s, 0}, {0, 0}, {0, s}, {-s, s}}, 0}});
}

Body random_body(Choices& any) {
    Shape shape{.geometry = random_geometry(any)};
    if (any.chance(0.5)) shape.density = any.chance(0.2) ? any.magnitude(0.01, 100) : 1.0;
    if (any.chance(0.2)) shape.rolling_resistance = 0.05;
    return {.shapes = {shape},
            .restitution = any.chance(0.3) ? any.between(0, 1) : 0,
            .friction = any.chance(0.2) ? 0 : any.between(0.1, 1)};
}

void add_ground(Choices& any, World& world) {
    const Side side{.restitution = 0, .friction = 0.6};
    if (any.chance(0.3)) {
        world.add(HalfPlane{.side = side});
    } else if (any.chance(0.5)) {
        world.add(Rectangle{{-8, 0}, {8, 20}, side, side, side, side});
    } else {
        Chain hills;
        for (int i = -12; i <= 12; ++i) hills.points.push_back({2.0 * i, std::abs(i) == 12 ? 8.0 : any.between(0, 1)});
        world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = hills}}, .restitution = 0, .friction = 0.6});
    }
}

JointType random_joint(Choices& any) {
    const double most = any.magnitude(0.1, 300);
    JointLimits limits;
    if (any.chance(0.5)) limits = {-any.between(0, 0.6), any.between(0, 0.6)};
    std::optional<JointSpring> spring;
    if (any.chance(0.4)) spring = {.stiffness = any.magnitude(0.5, 5000), .damping = any.chance(0.5) ? 0.0 : 1.0};
    std::optional<JointMotor> motor;
    if (any.chance(0.5)) motor = {.speed = any.chance(0.5) ? any.between(-6, 6) : 0, .maximum = most};
    const Vec2 axis{any.between(-1, 1), 1};
    return any.one_of<JointType>(
        {DistanceJoint{.spring = spring}, DistanceJoint{.limits = {0.5, 1.5}},
         RevoluteJoint{.spring = spring, .motor = motor, .limits = limits},
         PrismaticJoint{.axis = axis, .spring = spring, .motor = motor, .limits = limits},
         WheelJoint{.axis = axis, .spring = spring, .motor = motor, .limits = limits}, WeldJoint{.spring = spring},
         MotorJoint{.maximum_force = most, .maximum_torque = 0.3 * most},
         FrictionJoint{.maximum_force = most, .maximum_torque = 0.3 * most}, PulleyJoint{{-3, 12}, {3, 12}}});
}

/// Rows of bodies that do not touch yet, some of them thrown; neighbours may hang together.
World random_world(Choices& any, bool joined) {
    World world = mechanism_world({.precise = any.chance(0.2) ? Precise::all : Precise::some,
                                   .sleep = any.chance(0.4),
                                   .statics = any.chance(0.8)});
    add_ground(any, world);
    const std::size_t bodies = 3 + any.below<std::size_t>(18), columns = 2 + any.below<std::size_t>(5);
    std::vector<BodyId> grid;
    for (std::size_t i = 0; i < bodies; ++i) {
        Body body = random_body(any);
        body.position = {1.5 * static_cast<double>(i % columns), 2.5 + 1.5 * static_cast<double>(i / columns)};
        body.angle = any.chance(0.5) ? 0 : any.between(-3, 3);
        if (any.chance(0.1))
            body.kind = Kind::fixed;
        else if (any.chance(0.1))
            body.kind = Kind::driven, body.velocity = {any.between(-1, 1), any.between(-0.5, 0.5)};
        else if (any.chance(0.3))
            body.velocity = {any.between(-3, 3), any.between(-3, 3)};
        grid.push_back(world.add(body));
    }
    for (std::size_t i = 0; joined && i < bodies; ++i)
        for (const std::size_t k : {i + 1, i + columns}) {
            if (k >= bodies || (k == i + 1 && k % columns == 0) || any.chance(0.5)) continue;
            if (world.body(grid[i]).kind != Kind::dynamic && world.body(grid[k]).kind != Kind::dynamic) continue;
            Joint joint{.a = grid[i], .b = grid[k], .type = random_joint(any)};
            const bool has_two_ends =
                std::holds_alternative<DistanceJoint>(joint.type) || std::holds_alternative<PulleyJoint>(joint.type);
            if (!has_two_ends) joint.at = 0.5 * (world.position(grid[i]) + world.position(grid[k]));
            if (any.chance(0.1)) joint.break_force = any.magnitude(5, 500);
            world.add(joint);
        }
    return world;
}

void edit(Choices& any, World& world) {
    const BodyId id = world.ids()[any.below(world.size())];
    Body body = world.body(id);
    const auto change = [&](auto member, const auto& value) {
        body.*member = value;
        world.set(id, body);
    };
    const Body other = random_body(any);
    switch (any.below(8)) {
        case 0:
            return change(&Body::friction, other.friction);
        case 1:
            return change(&Body::restitution, other.restitution);
        case 2:
            body.moment_of_inertia.reset();
            return change(&Body::shapes, other.shapes);
        case 3:
            return world.wake(id);
        case 4:
            return world.set_position(id, world.position(id) + Vec2{0, any.between(0, 0.5)}, any.between(-3, 3));
        case 5:
            if (body.kind == Kind::dynamic) world.apply_impulse(id, {any.between(-3, 3), 1}, world.position(id));
            return;
        case 6:
            if (!world.joint_ids().empty()) world.remove(world.joint_ids()[any.below(world.joint_ids().size())]);
            return;
        default:
            return world.configure({.gravity = {any.between(-3, 3), -9}, .solver = world.settings().solver});
    }
}

// Where things stand, are thrown or are joined in loops, what was found before they came to be as they are may not
// tell.
TEST(RandomWorlds, GoOnWithTheSameBitsWhenRestored) {
    constexpr std::uint64_t worlds = trials(120);
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        Choices any(seed), same(seed);
        World world = random_world(any, seed % 2 == 1), other = random_world(same, seed % 2 == 1);
        run(world, 1.5, frame);
        restore_from(world, other);
        run(world, 1, frame), run(other, 1, frame);
        ASSERT_TRUE(saved(world) == saved(other)) << seed;
    }
}

TEST(RandomWorlds, CloseTheirLedgerWhateverIsEdited) {
    constexpr std::uint64_t worlds = trials(100);
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        Choices any(seed);
        World world = random_world(any, seed % 2 == 1);
        Throughput through(world);
        for (int i = 0; i < 120; ++i) {
            if (any.chance(0.2)) edit(any, world);
            world.step(frame);
            through.add(world);
        }
        SCOPED_TRACE(seed);
        expect_closed(world, through);
    }
}

// Whose units are powers of two, every number is the same but for its exponent, unless something is compared with a
// metre or a kilogram. Ropes and wheels held at their centres of mass had a metre as their size.
TEST(RandomWorlds, AreTheSameInKilometresAndGrams) {
    constexpr InUnits units{1024, 1.0 / 1024};
    constexpr std::uint64_t worlds = trials(80);
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        Choices any(seed);
        World world = random_world(any, seed % 2 == 1), other = in_units(world, units);
        world = in_units(world, {});
        run(world, 1, frame), run(other, 1, frame);
        for (std::size_t i = 0; i < world.size(); ++i) {
            ASSERT_EQ(units.length * world.positions()[i], other.positions()[i]) << seed;
            ASSERT_EQ(world.angles()[i], other.angles()[i]) << seed;
        }
        ASSERT_EQ(units.factor("J", false) * energy(world).total(), energy(other).total()) << seed;
    }
}

}  // namespace
}  // namespace carom::test
