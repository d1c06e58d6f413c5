// A hash of the state and of the energies of a set of worlds that between them use every method and force: what must be
// the same to the last bit for every compiler, optimisation, machine and number of threads (the first argument), and
// for every set of instructions: the widest that this machine has, or at most avx2 or baseline (the second argument).

#include <algorithm>
#include <carom/carom.hpp>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "simd/isa.hpp"

using namespace carom;

namespace {

int threads = 1;

Settings with(const Integrator& integrator, const Solver& solver = Impulse{}, Vec2 gravity = {0, -9.81}) {
    return {.gravity = gravity, .integrator = integrator, .solver = solver, .threads = threads};
}

std::uint64_t energy_hash(const World& world) {
    const Energy e = energy(world);
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const double account : {e.total(), e.heat.total(), e.work.total(), e.residual})
        hash = (hash ^ __builtin_bit_cast(std::uint64_t, account)) * 0x100000001b3u;
    return hash;
}

/// A line of the world's hashes.
void report(const std::string& name, World world, double duration, double step) {
    run(world, duration, step);
    std::printf("%-28s %016llx %016llx\n", name.c_str(), static_cast<unsigned long long>(state_hash(world)),
                static_cast<unsigned long long>(energy_hash(world)));
}

/// Discs of several sizes, in a room or a periodic box.
template <class Room>
World gas(const Settings& settings, const Room& room, double restitution, double friction) {
    World world(settings);
    world.add(room);
    NumpyRandom random(42);
    for (int i = 0; i < 60; ++i) {
        const Vec2 cell{1.0 + i % 8, 1.0 + i / 8};
        world.add(Body{.position = cell + Vec2{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)},
                       .velocity = {3 * random.normal(), 3 * random.normal()},
                       .angular_velocity = random.uniform(-5, 5),
                       .mass = random.uniform(0.5, 2),
                       .radius = random.uniform(0.1, 0.25),
                       .restitution = restitution,
                       .friction = friction});
    }
    return world;
}

void gases() {
    const Rectangle room{.low = {0, 0}, .high = {9, 9}};
    const Periodic box{.low = {0, 0}, .high = {9, 9}};
    const Impulse textbook{.time_of_impact = false};
    report("gas/textbook", gas(with(SymplecticEuler{}, textbook, {}), room, 1, 0), 4, 0.01);
    report("gas/elastic", gas(with(Verlet{}, Impulse{}, {}), room, 1, 0), 4, 0.01);
    report("gas/periodic", gas(with(Verlet{}, Impulse{}, {}), box, 1, 0), 4, 0.01);
    report("gas/rough", gas(with(Verlet{}), room, 0.9, 0.3), 2, 0.01);
    report("exact/periodic", gas(with(Verlet{}, Events{}, {}), box, 1, 0), 40, 0.5);
    report("exact/falling", gas(with(Verlet{}, Events{}), room, 1, 0), 4, 0.05);
    World rough = gas(with(Verlet{}, Events{.restitution_speed = 3}),
                      Rectangle{.low = {0, 0}, .high = {9, 9}, .top = {.temperature = 20}}, 0.95, 0.3);
    rough.add(Body{.kind = Kind::fixed, .position = {4.5, 0}, .radius = 0.3});
    rough.add(
        Body{.kind = Kind::fixed, .position = {0.45, 4}, .shapes = {{.geometry = Segment{{-0.4, 0.1}, {0.1, 0.2}}}}});
    report("exact/rough", rough, 2, 0.05);
    World dense = gas(with(Verlet{}), room, 0.9, 0.3);
    dense.add(Drag{.linear = 0.1, .quadratic = 0.02, .angular = 0.01, .wind = {1, 0}});
    report("gas/wind", dense, 1, 0.01);
}

/// A net of damped springs with anchors off centre, so that everything turns too.
World net(const Integrator& integrator, double damped = 1) {
    World world(with(integrator));
    std::vector<BodyId> knots;
    constexpr int n = 5;
    for (int i = 0; i < n * n; ++i)
        knots.push_back(world.add(Body{.kind = i == 0 || i == n - 1 ? Kind::fixed : Kind::dynamic,
                                       .position = {0.5 * (i % n), -0.5 * (i / n)},
                                       .angle = 0.1 * i,
                                       .mass = 0.1 + 0.01 * i,
                                       .moment_of_inertia = 0.002}));
    for (int i = 0; i < n * n; ++i) {
        const auto tie = [&](int j, DampingLaw law) {
            world.add(Spring{.a = knots[i],
                             .b = knots[j],
                             .anchor_a = {0.05, 0.02},
                             .anchor_b = {-0.05, 0.01},
                             .stiffness = 200,
                             .rest_length = 0.4,
                             .damping = damped * 0.05,
                             .damping_law = law});
        };
        if (i % n + 1 < n) tie(i + 1, DampingLaw::along);
        if (i / n + 1 < n) tie(i + n, DampingLaw::isotropic);
    }
    world.add(
        TorsionSpring{.a = knots[7], .b = knots[12], .stiffness = 0.3, .rest_angle = 0.2, .damping = damped * 0.001});
    return world;
}

/// Three bodies that attract one another, one of them on a narrow ellipse.
World orbits(const Integrator& integrator, DistanceLaw law) {
    World world(with(integrator, NoContact{}, {}));
    world.add(Body{.position = {0, 0}, .velocity = {0, -0.01}, .mass = 1, .charge = 1});
    world.add(Body{.position = {1, 0}, .velocity = {0, 0.5}, .mass = 1e-2, .charge = -1});
    world.add(Body{.position = {-3, 0.5}, .velocity = {0.1, -0.5}, .mass = 1e-3, .charge = 0.5});
    world.add(Attraction{.strength = 1, .law = law, .softening = 0.01});
    world.add(Attraction{.strength = 1e-3, .couples = Couples::charge, .law = law});
    return world;
}

/// Enough stars for the threads to share them.
World cluster() {
    World world(with(Verlet{}, Impulse{}, {}));
    NumpyRandom random(7);
    for (int i = 0; i < 400; ++i)
        world.add(Body{.position = {10 * random.normal(), 10 * random.normal()},
                       .velocity = {random.normal(), random.normal()},
                       .mass = random.uniform(0.5, 2),
                       .radius = 0.05});
    world.add(Attraction{.strength = 0.1, .softening = 0.1});
    return world;
}

/// A mechanism with a joint of every type, in a heap of boxes.
World mechanism() {
    World world(with(Verlet{}, SoftStep{}));
    world.add(HalfPlane{.point = {0, -2}, .side = {.restitution = 0.2, .friction = 0.4}});
    std::vector<BodyId> all;
    for (int i = 0; i < 12; ++i)
        all.push_back(world.add(Body{.position = {0.6 * i, 0.1 * (i % 3)},
                                     .velocity = {0, 0.1 * i},
                                     .mass = 1 + 0.1 * i,
                                     .shapes = {{.geometry = Box{0.5, 0.2}}},
                                     .restitution = 0.1,
                                     .friction = 0.5}));
    const JointSpring spring{.stiffness = 40, .damping = 0.3};
    const JointType types[] = {RevoluteJoint{},
                               RevoluteJoint{.spring = spring, .motor = JointMotor{.speed = 2, .maximum = 3}},
                               DistanceJoint{.spring = spring},
                               DistanceJoint{.limits = {.upper = 0.7}},
                               PrismaticJoint{.axis = {1, 0.2}, .limits = {-0.1, 0.2}},
                               WeldJoint{},
                               WheelJoint{.spring = spring},
                               MotorJoint{.velocity = {0.1, 0}, .maximum_force = 5, .maximum_torque = 1},
                               GearJoint{.ratio = -2},
                               FrictionJoint{3, 0.5},
                               DistanceJoint{}};
    for (std::size_t i = 0; i < 11; ++i)
        world.add(Joint{.a = all[i], .b = all[i + 1], .anchor_a = {0.3, 0}, .anchor_b = {-0.3, 0}, .type = types[i]});
    world.add(Joint{.b = all[0], .at = Vec2{-0.3, 0}, .type = RevoluteJoint{}});
    world.add(Joint{.a = all[3], .b = all[9], .type = PulleyJoint{.ground_a = {1, 4}, .ground_b = {6, 4}}});
    world.add(Joint{.b = all[11], .anchor_a = {7, 1}, .type = DragHandle{.maximum = 50}, .break_force = 1000});
    return world;
}

/// Sheets of hinged discs, with many loops, that swing so little that they as good as hang still, or do not; and chains
/// for threads to share.
World sheets() {
    World world(with(Verlet{}, SoftStep{.sleep = false, .statics = false}));
    const auto hinge = [&](BodyId a, BodyId b, Vec2 anchor) {
        world.add(Joint{.a = a, .b = b, .anchor_a = anchor, .anchor_b = -anchor, .type = RevoluteJoint{}});
    };
    const auto add = [&](Vec2 corner, int columns, int rows, double speed) {
        std::vector<BodyId> all;
        for (int i = 0; i < columns * rows; ++i) {
            all.push_back(world.add(Body{.kind = i == 0 ? Kind::fixed : Kind::dynamic,
                                         .position = corner + Vec2{double(i / rows), -double(i % rows)},
                                         .velocity = {i == 0 ? 0 : speed, 0},
                                         .radius = 0.4}));
            if (i % rows > 0) hinge(all[all.size() - 2], all.back(), {0, -0.5});
            if (i >= rows) hinge(all[static_cast<std::size_t>(i - rows)], all.back(), {0.5, 0});
        }
    };
    add({0, 0}, 1, 60, 1e-3), add({10, 0}, 11, 13, 1e-4), add({40, 0}, 9, 12, 1);
    for (int i = 0; i < 30; ++i) add({60.0 + 2 * i, 0}, 1, 3 + i % 4, 0.1 * i);
    return world;
}

/// A sheet that hangs still: most substeps are let be, and some are corrected in place.
/// Threads share a large one. Or forces are found that hold it, and the state is that of its joints.
World still_sheet(int n, bool statics = false) {
    World world(with(Verlet{}, SoftStep{.sleep = false, .statics = statics}));
    std::vector<BodyId> all;
    for (int i = 0; i < n * n; ++i) {
        const bool held = i % n == 0 && i / n > 4 && i / n < 9;
        all.push_back(world.add(Body{
            .kind = held ? Kind::fixed : Kind::dynamic, .position = {double(i / n), -double(i % n)}, .radius = 0.4}));
        const auto hinge = [&](int to, Vec2 anchor) {
            if (held && to % n == 0 && to / n > 4 && to / n < 9) return;
            world.add(Joint{.a = all[static_cast<std::size_t>(to)],
                            .b = all.back(),
                            .anchor_a = -anchor,
                            .anchor_b = anchor,
                            .type = RevoluteJoint{}});
        };
        if (i % n > 0) hinge(i - 1, {0, 0.5});
        if (i >= n) hinge(i - n, {-0.5, 0});
    }
    return world;
}

/// Figures that are alike, for lanes to share: they fall, fling their limbs to the limits, and land.
World figures() {
    World world(with(Verlet{}, SoftStep{.sleep = false}));
    world.add(HalfPlane{.side = {.restitution = 0.2, .friction = 0.4}});
    for (int i = 0; i < 13; ++i) {
        const Vec2 at{3.0 * i, 1 + 0.2 * (i % 5)};
        const auto bone = [&](Vec2 from_trunk) {
            return world.add(Body{.position = at + from_trunk,
                                  .velocity = {0, -0.5 * i},
                                  .angular_velocity = 2.0 * (i - 6),
                                  .shapes = {{.geometry = Box{0.1, 0.4}, .filter = {.group = -1 - i}}},
                                  .restitution = 0.2,
                                  .friction = 0.4});
        };
        const BodyId trunk = bone({});
        for (int k = 0; k < 4; ++k) {
            const Vec2 pivot{k % 2 == 0 ? -0.05 : 0.05, k < 2 ? 0.2 : -0.2};
            const std::optional<JointSpring> spring =
                i < 6 ? std::optional<JointSpring>() : JointSpring{.stiffness = 5, .damping = 0.01};
            world.add(
                Joint{.a = trunk,
                      .b = bone(pivot + Vec2{0, -0.2}),
                      .at = at + pivot,
                      .type = RevoluteJoint{
                          .spring = spring, .motor = JointMotor{.maximum = 0.1 * k}, .limits = {-0.5 - 0.1 * k, 0.4}}});
        }
    }
    return world;
}

void methods() {
    const std::vector<std::pair<std::string, Integrator>> all = {
        {"euler", Euler{}},
        {"symplectic-euler", SymplecticEuler{}},
        {"verlet", Verlet{}},
        {"pefrl", Pefrl{}},
        {"rk4", Rk4{}},
        {"midpoint", RungeKutta{Tableau::midpoint}},
        {"heun", RungeKutta{Tableau::heun}},
        {"ralston", RungeKutta{Tableau::ralston}},
        {"kutta3", RungeKutta{Tableau::kutta3}},
        {"kutta38", RungeKutta{Tableau::kutta38}},
        {"dormand-prince5", RungeKutta{Tableau::dormand_prince5}},
        {"dormand-prince8", RungeKutta{Tableau::dormand_prince8}},
        {"adaptive54", Adaptive{.pair = Pair::dormand_prince54}},
        {"adaptive853", Adaptive{.pair = Pair::dormand_prince853}},
        {"gauss-radau", GaussRadau{}},
        {"implicit", Implicit{}},
    };
    for (const auto& [name, integrator] : all) {
        report("net/" + name, net(integrator), 1, 0.005);
        report("orbits/" + name, orbits(integrator, DistanceLaw::inverse_square), 5, 0.01);
    }
    const std::pair<std::string, NystromPair> pairs[] = {{"nystrom64", NystromPair::dormand_prince64},
                                                         {"nystrom86", NystromPair::dormand_prince86},
                                                         {"nystrom1210", NystromPair::dormand_prince1210}};
    for (const auto& [name, pair] : pairs) {
        report("net/" + name, net(Nystrom{.pair = pair}, 0), 1, 0.05);
        report("orbits/" + name, orbits(Nystrom{.pair = pair}, DistanceLaw::inverse_square), 5, 0.5);
    }
    report("orbits/inverse", orbits(Verlet{}, DistanceLaw::inverse), 5, 0.01);
    report("cluster", cluster(), 0.2, 0.01);
    report("mechanism", mechanism(), 2, 1.0 / 60);
    report("sheets", sheets(), 0.5, 1.0 / 60);
    report("still_sheet", still_sheet(16), 0.5, 1.0 / 60);
    report("large_still_sheet", still_sheet(28), 0.2, 1.0 / 60);
    report("standing_sheet", still_sheet(16, true), 0.1, 1.0 / 60);
    report("figures", figures(), 1, 1.0 / 60);
}

/// Springs between centres: a lattice large enough for threads to share, a damped patch and springs to anywhere in it.
World cloth(const Integrator& integrator) {
    World world(with(integrator));
    const Built made = build(
        world, Lattice{.nx = 53, .ny = 47, .shear_stiffness = 700, .bend_stiffness = 200, .held = Held::top_corners});
    NumpyRandom random(11);
    for (std::size_t k = 0; k < 200; ++k)
        world.add(Spring{.a = made.bodies[k],
                         .b = made.bodies[2000 - 7 * k],
                         .stiffness = random.uniform(1, 5),
                         .rest_length = random.uniform(0, 20),
                         .damping = k % 2 ? random.uniform(0, 0.1) : 0});
    return world;
}

void networks() {
    report("cloth/symplectic-euler", cloth(SymplecticEuler{}), 0.2, 0.005);
    report("cloth/verlet", cloth(Verlet{}), 0.2, 0.005);
    report("cloth/rk4", cloth(Rk4{}), 0.1, 0.005);
    World light({.integrator = Verlet{}, .threads = threads});  // no damping: another way through Verlet's step
    build(light, Lattice{.nx = 61, .ny = 59, .shear_stiffness = 700, .held = Held::left});
    light.set_velocity(light.ids()[900], {2, 1}, 0);
    report("cloth/undamped", light, 0.3, 0.005);
    World smooth({.integrator = Nystrom{}, .threads = threads});
    build(smooth, Lattice{.nx = 61, .ny = 59, .shear_stiffness = 700, .held = Held::left});
    smooth.set_velocity(smooth.ids()[900], {2, 1}, 0);
    report("cloth/nystrom86", smooth, 0.3, 0.1);
    for (const Integrator& integrator : {Integrator{SymplecticEuler{}}, Integrator{Verlet{}}}) {
        World large({.integrator = integrator, .threads = threads});  // passes through memory in one wave
        build(large, Lattice{.nx = 90, .ny = 120, .shear_stiffness = 700, .held = Held::left});
        large.set_velocity(large.ids()[5000], {2, 1}, 0);
        report(std::holds_alternative<Verlet>(integrator) ? "cloth/wave/verlet" : "cloth/wave/symplectic-euler", large,
               0.1, 0.005);
    }
}

/// Soft discs of several sizes in a periodic box, enough for threads to share them.
void soft_discs() {
    for (const double damping : {0.0, 3.0}) {
        World world(with(Verlet{}, NoContact{}, {}));
        world.add(Periodic{.low = {0, 0}, .high = {40, 40}});
        NumpyRandom random(17);
        for (int i = 0; i < 2500; ++i)
            world.add(Body{.position = {0.8 * (i % 50) + random.uniform(-0.2, 0.2), 0.8 * (i / 50)},
                           .velocity = {random.normal(), random.normal()},
                           .mass = random.uniform(0.5, 2),
                           .radius = random.uniform(0.2, 0.5)});
        world.add(SoftDiscs{.stiffness = 1000, .damping = damping});
        report(damping == 0 ? "soft-discs/elastic" : "soft-discs/damped", world, 0.5, 0.005);
    }
}

/// A ball on a spring between a piston that is driven, a floor and a field, with contacts under forces.
void everything() {
    World world(with(Verlet{}));
    world.add(HalfPlane{.point = {0, 0}, .normal = {0.1, 1}, .side = {.restitution = 0.8, .friction = 0.2}});
    const BodyId piston = world.add(Body{.kind = Kind::driven, .position = {0, 3}, .radius = 0.2});
    world.drive(piston, [](double t) { return Pose{{0.3 * t * (1 - t), 3 - 0.5 * t * t * (1 - t)}, t}; });
    const BodyId ball = world.add(Body{.position = {0.1, 1.5}, .radius = 0.3, .restitution = 0.7, .friction = 0.4});
    const BodyId other = world.add(Body{.position = {0.5, 0.8}, .radius = 0.2, .restitution = 0.9, .friction = 0.1});
    world.add(Spring{.a = piston, .b = ball, .anchor_b = {0, 0.3}, .stiffness = 40, .rest_length = 1, .damping = 0.2});
    world.add(ConstantForce{.body = other, .force = {0.4, 0.2}, .point = {0, 0.1}, .torque = 0.02});
    world.add(ForceField{.name = "trap",
                         .force = [](Vec2 x, Vec2 v, double m, double) { return -2 * x - 0.1 * m * v; },
                         .potential = {}});
    world.add(Drag{.body = other, .quadratic = 0.05});
    report("everything", world, 3, 0.01);
}

std::vector<Shape> shapes_of(int kind, NumpyRandom& random) {
    const double a = random.uniform(0.2, 0.5), b = random.uniform(0.1, 0.3);
    switch (kind % 6) {
        case 0:
            return {Shape{.geometry = Disc{{}, a}, .density = 1, .rolling_resistance = 0.02}};
        case 1:
            return {Shape{.geometry = Box{2 * a, 2 * b}, .density = 1}};
        case 2:
            return {Shape{.geometry = Capsule{{-a, 0}, {a, 0.1}, b}, .density = 2}};
        case 3:
            return {Shape{.geometry = Hull{{{-a, -b}, {a, -b}, {a / 2, b}, {-a / 3, a}}, 0.05}, .density = 1}};
        case 4:
            return {Shape{.geometry = Polygon{{{-a, -a}, {a, -a}, {0, -a / 2}, {-a, a}}}, .density = 3}};
        default:
            return {Shape{.geometry = Box{a, a}, .density = 1},
                    Shape{.geometry = Disc{{a, 0}, b}, .density = 30, .surface_speed = 0.5}};
    }
}

/// Bodies of all shapes fall onto one another between walls and a chain.
World heap(const Settings& settings, int count, double restitution) {
    World world(settings);
    world.add(Rectangle{.low = {-3, 0}, .high = {3, 1000}});
    world.add(Body{.kind = Kind::fixed,
                   .shapes = {Shape{.geometry = Chain{{{3, 0.5}, {1, 0.1}, {-1, 0.2}, {-3, 1}}}}},
                   .friction = 0.4});
    NumpyRandom random(3);
    for (int i = 0; i < count; ++i)
        world.add(Body{.position = {random.uniform(-2, 2), 1.5 + 0.6 * i},
                       .angle = random.uniform(-3, 3),
                       .velocity = {random.normal(), random.normal()},
                       .angular_velocity = random.uniform(-5, 5),
                       .shapes = shapes_of(i, random),
                       .restitution = restitution,
                       .friction = 0.5});
    return world;
}

/// Pyramids of boxes side by side: large ones for threads to share colours of, small ones to share as islands.
World pyramids(int count, int base, double above = 0.05) {
    World world(with(Verlet{}, SoftStep{}));
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
    for (int p = 0; p < count; ++p)
        for (int row = 0; row < base; ++row)
            for (int i = 0; i + row < base; ++i)
                world.add(Body{.position = {p * (base + 2.0) + i + 0.5 * row, above + 0.5 + row},
                               .shapes = {Shape{.geometry = Box{1, 1}}},
                               .restitution = 0,
                               .friction = 0.6});
    return world;
}

/// A pyramid into which a heavy disc is shot: some of its boxes go where nobody foresaw them.
World shot_at(World world) {
    world.add(Body{.position = {-8, 6}, .velocity = {80, -5}, .mass = 50, .radius = 1, .restitution = 0.2});
    return world;
}

/// A pyramid that stands by forces that are found, and something light that falls on it.
World touched(World world) {
    world.add(Body{.position = {11.5, 24.2}, .mass = 0.1, .shapes = {Shape{.geometry = Box{0.3, 0.3}}}});
    return world;
}

/// Heavy tops on light legs and wheels, which are solved precisely with their joints, and one that slides in a guide.
World tables() {
    World world(with(Verlet{}, SoftStep{}));
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    for (int i = 0; i < 6; ++i) {
        const double x = 3.0 * i, mass = 20.0 * (i + 1) * (i + 1);
        Body top{.position = {x, 1.1}, .mass = mass, .shapes = {{.geometry = Box{2, 0.1}}}, .restitution = 0};
        const BodyId id = world.add(top);
        for (const double side : {-0.9, 0.9}) {
            Body leg{.position = {x + side, 0.55}, .mass = 1, .restitution = 0, .friction = 0.5};
            i % 2 == 0 ? void(leg.radius = 0.45) : void(leg.shapes = {{.geometry = Box{0.1, 1}}});
            const JointType type = i % 2 == 0 ? JointType(RevoluteJoint{}) : JointType(WeldJoint{});
            world.add(Joint{.a = id, .b = world.add(leg), .at = leg.position, .type = type});
        }
        if (i == 5) world.add(Joint{.b = id, .at = top.position, .type = PrismaticJoint{.axis = {0, 1}}});
    }
    return world;
}

void piles() {
    const Rectangle room{.low = {0, 0}, .high = {9, 9}};
    report("softstep/gas", gas(with(Verlet{}, SoftStep{}, {}), room, 1, 0.2), 2, 0.01);
    report("softstep/heap", heap(with(Verlet{}, SoftStep{}), 60, 0), 4, 1.0 / 60);
    report("softstep/bouncing", heap(with(Verlet{}, SoftStep{}), 20, 0.6), 2, 1.0 / 60);
    report("softstep/precise", heap(with(Verlet{}, SoftStep{.precise = Precise::all}), 12, 0), 3, 1.0 / 60);
    report("softstep/rk4", heap(with(Rk4{}, SoftStep{.substeps = 2}), 12, 0.2), 2, 1.0 / 60);
    report("softstep/pyramid", pyramids(1, 40), 0.4, 1.0 / 60);
    report("softstep/pyramids", pyramids(20, 4), 0.4, 1.0 / 60);
    report("softstep/shot", shot_at(pyramids(1, 24)), 0.7, 1.0 / 60);
    report("softstep/touched", touched(pyramids(1, 24, 0)), 0.7, 1.0 / 60);
    report("softstep/tables", tables(), 1, 1.0 / 60);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) threads = std::atoi(argv[1]);
    const std::string most = argc > 2 ? argv[2] : "avx512";
    if (most != "avx512" && most != "avx2" && most != "baseline") {
        std::fputs("usage: hashes [THREADS [baseline | avx2 | avx512]]\n", stderr);
        return 2;
    }
    if (most != "avx512") use_isa(std::min(isa(), most == "avx2" ? Isa::avx2 : Isa::baseline));
    gases();
    methods();
    networks();
    soft_discs();
    everything();
    piles();
}
