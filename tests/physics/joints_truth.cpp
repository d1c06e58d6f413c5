// Mechanisms of joints against the exact results of tests/reference/truth.json.

#include "joints.hpp"
#include "reference/truth.hpp"

namespace carom {
namespace {

using namespace test;

/// What a rule of second order says, from its values with n parts and with 2n (Richardson).
double extrapolated(double coarse, double fine) { return (4 * fine - coarse) / 3; }

/// The time of the k-th change of sign of a quantity, by the secant of the step that it happens in.
template <class Quantity>
double zero(World& world, double step, int k, Quantity quantity) {
    for (double before = quantity(); world.time() < 1e3;) {
        world.step(step);
        const double now = quantity();
        if ((now > 0) != (before > 0) && --k == 0) return world.time() - step * now / (now - before);
        before = now;
    }
    return NAN;
}

// ---- Pendula --------------------------------------------------------------------------------------------------------

constexpr double degrees = pi / 180, amplitudes[] = {1, 10, 45, 90, 120, 150, 170, 179};

/// The period with so many steps in it, from the second and the sixth passage through the lowest point.
double period_in(World world, BodyId bob, double step) {
    const auto aside = [&] { return world.position(bob).x; };
    const double first = zero(world, step, 2, aside);
    return (zero(world, step, 4, aside) - first) / 2;
}

/// The same for steps that go to 0: the method is of second order.
double period_of(const World& world, BodyId bob, double expected) {
    return extrapolated(period_in(world, bob, expected / 120), period_in(world, bob, expected / 240));
}

// What is left is of fourth order in steps of T/120: 2e-8 of T at 90°, and 1e-6 at 179°, where the bob falls within a
// tenth of the period.
TEST(Truth, mech_pendulum) {
    for (std::size_t k = 0; k < 8; ++k) {
        const double angle = amplitudes[k] * degrees, exact = truth("mech.pendulum")[k];
        World world = mechanism_world();
        const BodyId bob = world.add(Body{.position = {std::sin(angle), -std::cos(angle)}, .mass = 1});
        world.add(Joint{.b = bob, .type = DistanceJoint{}});
        EXPECT_NEAR(period_of(world, bob, exact), exact, (k < 4 ? 1e-7 : 2e-6) * exact) << amplitudes[k] << "°";
    }
}

struct PhysicalPendulum {
    const char* name;
    double lever, moment_of_inertia;  ///< from the pin to the centre [m], about the centre of 1 kg [kg m²]
    Shape shape;
};

// A body on a pin swings like the simple pendulum of its reduced length I/(m d): mech.pendulum's periods times √(I/(m
// d)). Of the rod that is 2/3 of its length, of the disc on its rim 3/2 of its radius. 150° is as far off as it was
// above.
TEST(Truth, mech_pendulum_physical) {
    const PhysicalPendulum pendula[] = {
        {"rod on its end", 0.5, 1.0 / 12 + 0.0001 / 12, {.geometry = Box{1, 0.01}}},
        {"rod on a sixth of it", 1.0 / 3, 1.0 / 12 + 0.0001 / 12, {.geometry = Box{1, 0.01}}},
        {"disc on its rim", 0.3, 0.5 * 0.09, {.geometry = Disc{.radius = 0.3}}},
        {"square on its corner", std::sqrt(0.5), 1.0 / 6, {.geometry = Box{1, 1}}},
    };
    for (const PhysicalPendulum& p : pendula) {
        for (const std::size_t k : {0u, 3u, 5u}) {
            const double angle = amplitudes[k] * degrees;
            const double reduced = p.lever + p.moment_of_inertia / p.lever;
            const double exact = truth("mech.pendulum")[k].get<double>() * std::sqrt(reduced);
            World world = mechanism_world();
            const BodyId body = world.add(Body{.position = {p.lever * std::sin(angle), -p.lever * std::cos(angle)},
                                               .angle = angle,
                                               .mass = 1,
                                               .shapes = {p.shape}});
            world.add(Joint{.b = body, .at = Vec2{}, .type = RevoluteJoint{}});
            EXPECT_NEAR(period_of(world, body, exact), exact, 5e-7 * exact) << p.name << ", " << amplitudes[k] << "°";
        }
    }
}

// The motion is chaotic: the method's error of (ωh)²/24, some 1e-7 with 4 substeps of 1/960, grows by the factor e in a
// second. The issue asks for 1e-4 at t = 5.
TEST(Truth, mech_double_pendulum) {
    World world = mechanism_world();
    const BodyId a = world.add(Body{.position = {1, 0}, .mass = 1}), b = world.add(Body{.position = {2, 0}, .mass = 1});
    world.add(Joint{.b = a, .type = DistanceJoint{}});
    world.add(Joint{.a = a, .b = b, .type = DistanceJoint{}});
    constexpr double times[] = {1, 2, 5, 10}, allowed[] = {1e-5, 1e-5, 2e-5, 1e-4};
    for (std::size_t k = 0; k < 4; ++k) {
        run(world, times[k] - world.time(), 1.0 / 960);
        const Vec2 p = world.position(a), q = world.position(b) - p;
        const Vec2 v = world.velocity(a), w = world.velocity(b) - v;
        const double found[] = {std::atan2(p.x, -p.y), std::atan2(q.x, -q.y), cross(p, v), cross(q, w)};
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(found[i], truth("mech.double.pendulum")[k][i].get<double>(), allowed[k]) << "t = " << times[k];
    }
}

// ---- Ropes at rest --------------------------------------------------------------------------------------------------

/// Dashpots to the ground, a level and an upright one: what hangs on them comes to rest where it would without them.
void calm(World& world, BodyId body, double damping) {
    for (const Vec2 far : {Vec2{100, 0}, Vec2{0, 100}})
        world.add(Joint{.b = body,
                        .anchor_a = world.position(body) + far,
                        .type = DistanceJoint{.spring = JointSpring{.stiffness = 0, .damping = damping}}});
}

struct Hanging {
    double sag = 0, horizontal = 0, end = 0, length = 0;
};

/// A rope of 1 kg/m and 1.2 m between two pins 1 m apart, of so many rods on pins; hung up as a V, it comes to rest by
/// dashpots and the friction of its pins.
Hanging catenary(int rods) {
    World world = mechanism_world({.sleep = false});
    const double link = 1.2 / rods, down = std::sqrt(0.36 - 0.25);
    const Vec2 falls{0.5 / 0.6, -down / 0.6}, rises{falls.x, -falls.y};
    std::optional<BodyId> last;
    Vec2 at{};
    const RevoluteJoint pin{.spring = JointSpring{.stiffness = 0, .damping = 0.01 * link}};
    for (int i = 0; i < rods; ++i) {
        const Vec2 way = link * (i < rods / 2 ? falls : rises);
        Body next = rod(at + 0.5 * way, link, link);
        next.angle = std::atan2(way.y, way.x);
        const BodyId id = world.add(next);
        world.add(Joint{.a = last, .b = id, .at = at, .type = pin});
        at += way, last = id;
    }
    const BodyId post = world.add(Body{.kind = Kind::fixed, .position = {1, 0}});
    world.add(Joint{.a = last, .b = post, .at = Vec2{1, 0}, .type = RevoluteJoint{}});
    for (int i = 0; i < rods; ++i) calm(world, world.ids()[static_cast<std::size_t>(i)], 5 * link);
    run(world, 15, frame);
    EXPECT_LE(energy(world).kinetic + energy(world).rotational, 1e-16);
    const Vec2 force = world.reaction(world.joint_ids()[0]).force;
    // The middle pin is half a rod's rise below the rods beside it.
    const BodyId middle = world.ids()[static_cast<std::size_t>(rods) / 2];
    const double sag = -world.position(middle).y + 0.5 * link * std::sin(world.angle(middle));
    return {sag, std::abs(force.x), length(force), 1.2};
}

// Rods are a rule of second order for the rope; 1e-6 is for the fourth order of 20, of which 5e-7 is left.
TEST(Truth, mech_catenary) {
    const auto& exact = truth("mech.catenary");
    const Hanging coarse = catenary(20), fine = catenary(40);
    EXPECT_NEAR(extrapolated(coarse.sag, fine.sag), exact[1].get<double>(), 1e-6);
    EXPECT_NEAR(extrapolated(coarse.horizontal, fine.horizontal), exact[2].get<double>(), 1e-6);
    EXPECT_NEAR(extrapolated(coarse.end, fine.end), exact[3].get<double>(), 1e-6);
    EXPECT_NEAR(extrapolated(coarse.horizontal, fine.horizontal) / gravity, exact[0].get<double>(), 1e-6);
}

/// The same rope of beads on springs, of EA = 100 N.
Hanging elastic_catenary(int segments) {
    World world = mechanism_world({.sleep = false});
    const double link = 1.2 / segments, stiffness = 100 / link;
    std::vector<BodyId> beads;
    for (int i = 0; i <= segments; ++i) {
        const double s = static_cast<double>(i) / segments;
        const bool end = i == 0 || i == segments;
        beads.push_back(world.add(
            Body{.kind = end ? Kind::fixed : Kind::dynamic, .position = {s, -1.2 * s * (1 - s)}, .mass = link}));
        if (i > 0)
            world.add(Joint{.a = beads[beads.size() - 2],
                            .b = beads.back(),
                            .type = DistanceJoint{.length = link, .spring = JointSpring{.stiffness = stiffness}}});
    }
    for (const BodyId id : beads)
        if (world.body(id).kind == Kind::dynamic) calm(world, id, 5 * link);
    run(world, 20, frame);
    EXPECT_LE(energy(world).kinetic, 1e-16);
    Hanging rope;
    for (std::size_t i = 1; i < beads.size(); ++i)
        rope.length += length(world.position(beads[i]) - world.position(beads[i - 1]));
    // The support bears the half link beside it, too.
    const Vec2 force = world.reaction(world.joint_ids()[0]).force;
    rope.horizontal = std::abs(force.x);
    rope.end = length({force.x, std::abs(force.y) + 0.5 * link * gravity});
    rope.sag = -world.position(beads[beads.size() / 2]).y;
    return rope;
}

// Beads are such a rule as well.
TEST(Truth, mech_catenary_elastic) {
    const auto& exact = truth("mech.catenary.elastic");
    const Hanging coarse = elastic_catenary(20), fine = elastic_catenary(40);
    EXPECT_NEAR(extrapolated(coarse.horizontal, fine.horizontal), exact[0].get<double>(), 1e-6);
    EXPECT_NEAR(extrapolated(coarse.sag, fine.sag), exact[1].get<double>(), 1e-6);
    EXPECT_NEAR(extrapolated(coarse.end, fine.end), exact[2].get<double>(), 1e-6);
    EXPECT_NEAR(extrapolated(coarse.length, fine.length), exact[3].get<double>(), 1e-6);
}

/// A bar of so many rods, welded by springs of EI n/L, with P L²/EI = 1 at its end: tip angle, deflection and reach. At
/// rest it does not matter what they weigh; their moment of inertia keeps the springs slow against the substep.
std::array<double, 3> elastica(int rods) {
    World world = mechanism_world({.sleep = false}, {});
    const double link = 1.0 / rods;
    std::optional<BodyId> last;
    for (int i = 0; i < rods; ++i) {
        const BodyId next = world.add(Body{.position = {(i + 0.5) * link, 0}, .mass = link, .moment_of_inertia = 0.01});
        // Each spring bends as a link does, half of it on either side; before the first there is but half a link.
        const double stiffness = (i == 0 ? 2 : 1) / link;
        world.add(Joint{.a = last,
                        .b = next,
                        .at = Vec2{i * link, 0},
                        .type = WeldJoint{.spring = JointSpring{.stiffness = stiffness, .damping = 0.01 * stiffness}}});
        last = next;
    }
    for (const BodyId id : world.ids()) {
        calm(world, id, 3 * link);
    }
    world.add(ConstantForce{.body = *last, .force = {0, 1}, .point = {0.5 * link, 0}});
    run(world, 40, frame);
    EXPECT_LE(energy(world).kinetic + energy(world).rotational, 1e-16);
    const double angle = world.angle(*last);
    const Vec2 tip = world.position(*last) + 0.5 * link * Vec2{std::cos(angle), std::sin(angle)};
    return {angle, tip.y, tip.x};
}

// The fourth order of 20 rods leaves 2e-8.
TEST(Truth, mech_elastica) {
    const auto& exact = truth("mech.elastica");
    const auto coarse = elastica(20), fine = elastica(40);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(extrapolated(coarse[k], fine[k]), exact[k].get<double>(), 1e-7) << k;
}

// ---- Modes ----------------------------------------------------------------------------------------------------------

/// Frequency of a mode of a chain of 1 m and 1 kg that hangs from a pin, of so many rods.
double hanging_mode(int rods, double expected) {
    World world = mechanism_world({.sleep = false});
    const double link = 1.0 / rods;
    // Aside by Bernoulli's J0 of the distance from the free end.
    const auto aside = [&](int joint) {
        return 1e-5 * std::cyl_bessel_j(0, 2 * expected * std::sqrt((1 - joint * link) / gravity));
    };
    std::optional<BodyId> last;
    Vec2 at{aside(0), 0};
    std::vector<double> shape;
    for (int i = 0; i < rods; ++i) {
        const double x = aside(i + 1) - aside(i);
        const Vec2 way{x, -std::sqrt(link * link - x * x)};
        Body next = rod(at + 0.5 * way, link, link);
        next.angle = std::atan2(way.y, way.x);
        const BodyId id = world.add(next);
        world.add(Joint{.a = last, .b = id, .at = at, .type = RevoluteJoint{}});
        shape.push_back(next.position.x);
        at += way, last = id;
    }
    const auto part = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < shape.size(); ++i) sum += shape[i] * world.positions()[i].x;
        return sum;
    };
    const double first = zero(world, 1e-3, 1, part);
    return pi / (zero(world, 1e-3, 1, part) - first);
}

// Rods are a rule of second order for the chain. The fourth order of 40, and what of the other modes is in the start,
// leave 4e-8 of the first mode, 7e-5 of the fourth; the issue asks for 1e-4 of the first.
TEST(Truth, mech_hangchain_of_rods) {
    for (std::size_t n = 0; n < 4; ++n) {
        const double exact = truth("mech.hangchain")[n];
        const double coarse = hanging_mode(40, exact), fine = hanging_mode(80, exact);
        EXPECT_NEAR(extrapolated(coarse, fine), exact, (n == 0 ? 1e-6 : 1e-4) * exact) << "mode " << n + 1;
    }
}

// (ωh)²/12 of the frequency, and h is a fourth of 1/100: 2e-6 for the fastest.
TEST(Truth, mech_chain_modes_of_struts) {
    const std::size_t sizes[] = {2, 3, 10};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t mode = 1; mode <= truth("mech.chain.modes")[row].size(); ++mode) {
            const std::size_t n = sizes[row];
            const double exact = truth("mech.chain.modes")[row][mode - 1];
            World world = mechanism_world({.sleep = false}, {});
            std::vector<double> shape;
            for (std::size_t i = 0; i <= n + 1; ++i) {
                shape.push_back(i == n + 1 ? 0
                                           : std::sin(pi * static_cast<double>(i * mode) / static_cast<double>(n + 1)));
                world.add(Body{.kind = i == 0 || i == n + 1 ? Kind::fixed : Kind::dynamic,
                               .position = {static_cast<double>(i) + 0.1 * shape[i], 0},
                               .mass = 1});
                if (i > 0)
                    world.add(Joint{.a = world.ids()[i - 1],
                                    .b = world.ids()[i],
                                    .type = DistanceJoint{.length = 1, .spring = JointSpring{.stiffness = 1}}});
            }
            const auto part = [&] {
                double sum = 0;
                for (std::size_t i = 0; i <= n + 1; ++i)
                    sum += shape[i] * (world.positions()[i].x - static_cast<double>(i));
                return sum;
            };
            const double first = zero(world, 0.01, 1, part);
            EXPECT_NEAR(pi / (zero(world, 0.01, 1, part) - first), exact, 2e-6 * exact) << n << ' ' << mode;
        }
}

// ---- Capstan --------------------------------------------------------------------------------------------------------

/// Ratio of the pulls at the ends of a rope of so many beads on a drum that turns under it. The beads hardly turn: they
/// slide and do not roll.
double capstan(double wrap, int beads) {
    constexpr double drum = 1, bead = 0.02;
    World world = mechanism_world({.sleep = false}, {});
    world.add(Body{.kind = Kind::driven, .angular_velocity = 0.1, .radius = drum, .restitution = 0, .friction = 0.3});
    const double turn = wrap / beads;
    const auto place = [&](double i) {
        const double angle = (i + 0.5) * turn;
        return (drum + bead) * Vec2{std::cos(angle), std::sin(angle)};
    };
    std::optional<BodyId> last;
    for (int i = 0; i < beads; ++i) {
        const BodyId next = world.add(Body{.position = place(i),
                                           .mass = 10,
                                           .moment_of_inertia = 1e3,
                                           .radius = bead,
                                           .restitution = 0,
                                           .friction = 0.3});
        if (i == 0)
            world.add(Joint{.b = next, .anchor_a = place(0) + 20 * (place(-1) - place(0)), .type = DistanceJoint{}});
        else
            world.add(Joint{.a = last, .b = next, .type = DistanceJoint{}});
        last = next;
    }
    const Vec2 out = place(beads) - place(beads - 1);
    const double far = 20 * length(out);
    world.add(Joint{.b = *last,
                    .anchor_a = place(beads - 1) + 20 * out,
                    .type = DistanceJoint{.length = far - 0.1, .spring = JointSpring{.stiffness = 100, .damping = 1}}});
    run(world, 5, frame);
    const double pull = length(world.reaction(world.joint_ids().front()).force),
                 hold = length(world.reaction(world.joint_ids().back()).force);
    return std::max(pull, hold) / std::min(pull, hold);
}

// Beads that turn the rope by δ each multiply its pull by (1 + µ tan δ/2)/(1 − µ tan δ/2): of second order. Contacts
// give way by some (pull/mass) h², which moves heavy beads by 4e-6 of the ratio, and light ones by more.
TEST(Truth, mech_capstan) {
    for (std::size_t k = 0; k < 2; ++k) {
        const double exact = truth("mech.capstan")[k], wrap = pi * (1 + static_cast<double>(k));
        EXPECT_NEAR(extrapolated(capstan(wrap, 40), capstan(wrap, 80)), exact, 1e-5 * exact);
    }
}

}  // namespace
}  // namespace carom
