// The ten scenes of Box2D's benchmark application (main of August 2026), rebuilt from their description: dt 1/60 s,
// four substeps, density 1, friction 0.6. Beside Debian's Box2D 2.4 where that has the shapes, and but for its first
// step, which is the dearest one of Carom and is timed there. Prints the table of docs/performance.md; the check values
// say whether the work is the same: most scenes are chaotic, and only their size is to be compared.
//
// Arguments: [SCENE] [STEPS]; without steps as many as the application makes. "profile SCENE" times the parts of a
// step.

#include <box2d/box2d.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace carom;

constexpr double frame = 1.0 / 60, pi = 3.14159265358979323846;

/// What both engines are given. Joints name bodies by their place here.
struct Set {
    std::vector<Body> bodies;
    std::vector<Joint> joints;
    Vec2 gravity{0, -10};
    bool sleeps = true, statics = true;
    /// What the scene does before a step, in Carom.
    std::function<void(World&, std::vector<BodyId>&, int step)> act{};
    /// Where the bodies driven along a curve are.
    std::function<Pose(double time)> curve{};
};

Body body(Vec2 at, std::vector<Shape> shapes, double friction = 0.6) {
    return {.position = at, .shapes = std::move(shapes), .restitution = 0, .friction = friction};
}
Body fixed(std::vector<Shape> shapes, double friction = 0.6) {
    Body ground = body({}, std::move(shapes), friction);
    ground.kind = Kind::fixed;
    return ground;
}
Shape shape(Geometry geometry, double density = 1) { return {.geometry = std::move(geometry), .density = density}; }
Shape ground(Geometry geometry) { return {.geometry = std::move(geometry)}; }
Body square(Vec2 at, double side) { return body(at, {shape(Box{side, side})}); }

/// A row of boxes as a floor and two columns of them as walls.
std::vector<Shape> bin(int half_width, int height) {
    std::vector<Shape> shapes;
    for (int i = -half_width; i <= half_width; ++i) shapes.push_back(ground(Box{1.1, 1, {1.0 * i, 0}}));
    for (const int side : {-half_width, half_width})
        for (int i = 1; i <= height; ++i) shapes.push_back(ground(Box{1, 1.1, {1.0 * side, 1.0 * i}}));
    return shapes;
}

// ---- The scenes -----------------------------------------------------------------------------------------------------

Set compounds() {
    Set set;
    std::vector<Shape> container = bin(40, 100);
    container.push_back(ground(Segment{{-800, -80}, {800, -80}}));
    set.bodies.push_back(fixed(std::move(container)));
    double shift = 0.25;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 150; ++j, shift = -shift)
            set.bodies.push_back(
                body({2.0 * i - 19 + shift, 2.25 * j + 5.575},
                     {shape(Polygon{{{-1, 0}, {0.5, 1}, {0, 2}}}), shape(Polygon{{{1, 0}, {-0.5, 1}, {0, 2}}})}, 0.5));
    return set;
}

Set joint_grid() {
    Set set;
    set.sleeps = false;
    for (int k = 0; k < 100; ++k)
        for (int i = 0; i < 100; ++i) {
            Shape disc = shape(Disc{{}, 0.4});
            disc.filter = {.category = 2, .mask = 0x7ffffffd};
            Body b = body({1.0 * k, -1.0 * i}, {disc});
            if (i == 0 && k >= 47 && k <= 53) b.kind = Kind::fixed, b.shapes[0].density.reset();
            set.bodies.push_back(b);
            const auto joined = [&](int from, Vec2 anchor) {
                if (b.kind == Kind::fixed && set.bodies[static_cast<std::size_t>(from)].kind == Kind::fixed) return;
                set.joints.push_back({.a = BodyId{static_cast<std::uint32_t>(from)},
                                      .b = BodyId{static_cast<std::uint32_t>(100 * k + i)},
                                      .anchor_a = anchor,
                                      .anchor_b = -anchor,
                                      .type = RevoluteJoint{}});
            };
            if (i > 0) joined(100 * k + i - 1, {0, -0.5});
            if (k > 0) joined(100 * (k - 1) + i, {0.5, 0});
        }
    return set;
}

Set junkyard() {
    Set set;
    set.bodies.push_back(fixed(bin(80, 50)));
    Hull pentagon;
    for (int n = 0; n < 5; ++n) {
        const double angle = n * pi * (std::sqrt(5.0) - 1);
        pentagon.points.push_back({0.25 * std::cos(angle), 0.25 * std::sin(angle)});
    }
    double shift = -0.1;
    for (int i = 0; i < 200; ++i)
        for (int j = 0; j < 40; ++j, shift = -shift)
            set.bodies.push_back(body({0.75 * (i - 100) + shift, j + 15.0}, {shape(pentagon)}));
    Body blade = body({}, {ground(Box{4, 8, {0, 4}})});
    blade.kind = Kind::driven;
    set.bodies.push_back(blade);
    set.curve = [](double time) { return Pose{{60 * std::sin(0.2 * time), 0}, 0}; };
    return set;
}

Set large_pyramid() {
    Set set;
    set.sleeps = false;
    set.bodies.push_back(fixed({ground(Box{200, 2, {0, -1}})}));
    for (int i = 0; i < 100; ++i)
        for (int j = i; j < 100; ++j) set.bodies.push_back(square({0.5 * (i + 1) + (j - i) - 50, i + 0.5}, 1));
    return set;
}

Set many_pyramids() {
    Set set;
    set.sleeps = false;
    std::vector<Shape> floors;
    for (int row = 0; row < 20; ++row) floors.push_back(ground(Segment{{-110, 11.0 * row}, {110, 11.0 * row}}));
    set.bodies.push_back(fixed(std::move(floors)));
    for (int row = 0; row < 20; ++row)
        for (int column = 0; column < 20; ++column)
            for (int i = 0; i < 10; ++i)
                for (int j = i; j < 10; ++j)
                    set.bodies.push_back(
                        square({0.5 * (i + 1) + (j - i) - 110 + 11 * column + 0.5, i + 0.5 + 11 * row}, 1));
    return set;
}

Set smash() {
    Set set;
    set.gravity = {};
    Body hammer = body({-20, 0}, {shape(Box{8, 8}, 8)});
    hammer.velocity = {40, 0};
    set.bodies.push_back(hammer);
    for (int i = 0; i < 120; ++i)
        for (int j = 0; j < 80; ++j) set.bodies.push_back(square({30 + 0.4 * i, 0.4 * (j - 40)}, 0.4));
    return set;
}

/// A paddle of 40 m that turns at 5 rad/s in a round drum.
Set spinner() {
    Set set;
    Chain drum{.closed = true};
    for (int i = 0; i < 360; ++i)
        drum.points.push_back({40 * std::cos(i * pi / 180), 32 + 40 * std::sin(i * pi / 180)});
    set.bodies.push_back(fixed({ground(drum)}, 0.1));
    set.bodies.push_back(body({0, 12}, {shape(Box{1.2, 40.4, {}, 0, 0.2})}, 0));
    set.joints.push_back({.b = BodyId{1}, .at = Vec2{0, 12}, .type = RevoluteJoint{.motor = JointMotor{.speed = 5}}});
    const Geometry kinds[] = {Capsule{{-0.25, 0}, {0.25, 0}, 0.25}, Disc{{}, 0.35}, Box{0.7, 0.7}};
    for (int i = 0; i < 6076; ++i) {
        Body b = body({-23 + 0.5 * (i % 92), 2 + 0.5 * (i / 92)}, {shape(kinds[i % 3], 0.25)}, 0.1);
        b.restitution = 0.1;
        set.bodies.push_back(b);
    }
    return set;
}

Set tumbler() {
    Set set;
    set.bodies.push_back(body({0, 10}, {shape(Box{1, 20, {10, 0}}, 50), shape(Box{1, 20, {-10, 0}}, 50),
                                        shape(Box{20, 1, {0, 10}}, 50), shape(Box{20, 1, {0, -10}}, 50)}));
    set.joints.push_back({.b = BodyId{0},
                          .at = Vec2{0, 10},
                          .type = RevoluteJoint{.motor = JointMotor{.speed = 25 * pi / 180, .maximum = 1e8}}});
    for (int i = 0; i < 45; ++i)
        for (int j = 0; j < 45; ++j) set.bodies.push_back(square({-9 + 0.4 * j, 1 + 0.4 * i}, 0.25));
    return set;
}

Set washer() {
    Set set;
    Body drum = body({0, 10}, {});
    drum.kind = Kind::driven, drum.velocity = {0.001, -0.002}, drum.angular_velocity = 25 * pi / 180;
    const auto quad = [&](double inner, double outer, double from, double to) {
        Polygon p;
        for (const auto& [r, angle] : {std::pair{inner, from}, {outer, from}, {outer, to}, {inner, to}})
            p.points.push_back({r * std::cos(angle), r * std::sin(angle)});
        drum.shapes.push_back(ground(p));
    };
    constexpr double degree = pi / 180;
    for (int i = 0; i < 36; ++i) quad(16, 18, (10 * i - 1) * degree, (10 * i + 11) * degree);
    for (const int i : {0, 9, 18, 27}) quad(14, 16, 10 * i * degree, (10 * i + 10) * degree);
    set.bodies.push_back(drum);
    for (int i = 0; i < 90; ++i)
        for (int j = 0; j < 90; ++j) set.bodies.push_back(square({-9.9 + 0.21 * j, 0.1 + 0.21 * i}, 0.2));
    return set;
}

// ---- Rain: ragdolls that come and go --------------------------------------------------------------------------------

struct Bone {
    double y, from, to, radius;
    int parent;
    double pivot, lower, upper, torque, turned = 0;
    bool foot = false;
};
constexpr Bone bones[] = {
    {0.95, -0.02, 0.02, 0.095, -1, 0, 0, 0, 0},
    {1.20, -0.135, 0.135, 0.09, 0, 1.00, -0.25, 0, 0.025},
    {1.475, -0.038, 0.039, 0.075, 1, 1.40, -0.3, 0.1, 0.0125},
    {0.775, -0.125, 0.125, 0.06, 0, 0.90, -0.05, 0.4, 0.05},
    {0.475, -0.155, 0.125, 0.045, 3, 0.625, -0.5, -0.02, 0.025, 0, true},
    {0.775, -0.125, 0.125, 0.06, 0, 0.90, -0.05, 0.4, 0.05},
    {0.475, -0.155, 0.125, 0.045, 5, 0.625, -0.5, -0.02, 0.025, 0, true},
    {1.225, -0.125, 0.125, 0.035, 1, 1.35, -0.1, 0.8, 0.025},
    {0.975, -0.125, 0.125, 0.03, 7, 1.10, -0.2, 0.3, 0.005, 0.25},
    {1.225, -0.125, 0.125, 0.035, 1, 1.35, -0.1, 0.8, 0.025},
    {0.975, -0.125, 0.125, 0.03, 9, 1.10, -0.2, 0.3, 0.005, 0.25},
};

void add_ragdoll(World& world, Vec2 at, int number, std::vector<BodyId>& ids) {
    std::vector<BodyId> here;
    for (const Bone& bone : bones) {
        Shape flesh = shape(Capsule{{0, bone.from}, {0, bone.to}, bone.radius});
        flesh.filter = {.category = 2, .mask = 3, .group = -(number + 1)};
        Body b = body(at + Vec2{0, bone.y}, {flesh}, 0.2);
        if (bone.foot) {
            Shape foot = shape(Polygon{{{-0.03, -0.185}, {0.11, -0.185}, {0.11, -0.16}, {-0.03, -0.14}}, 0.015});
            foot.friction = 0.05, foot.filter = {.category = 2, .mask = 1, .group = -(number + 1)};
            b.shapes.push_back(foot);
        }
        here.push_back(world.add(b));
        if (bone.parent < 0) continue;
        RevoluteJoint hinge;
        hinge.rest_angle = bone.turned * pi;
        hinge.spring = JointSpring{.frequency = 5, .damping_ratio = 0.5};
        hinge.motor = JointMotor{.speed = 0, .maximum = bone.torque};
        hinge.limits = {bone.lower * pi, bone.upper * pi};
        world.add(Joint{.a = here[bone.parent], .b = here.back(), .at = at + Vec2{0, bone.pivot}, .type = hinge});
    }
    ids.insert(ids.end(), here.begin(), here.end());
}

Set rain() {
    Set set;
    std::vector<Shape> shelves;
    for (int shelf = 0; shelf < 5; ++shelf)
        for (int j = 0; j <= 500; ++j) shelves.push_back(ground(Box{0.5, 0.5, {-125 + 0.5 * j, 45.0 * shelf}}));
    set.bodies.push_back(fixed(std::move(shelves)));
    set.act = [slots = std::vector<std::vector<BodyId>>(40), next = 0](World& world, std::vector<BodyId>&,
                                                                       int step) mutable {
        if (step % 8 != 0) return;
        std::vector<BodyId>& slot = slots[next % 40];
        for (const BodyId id : slot) world.remove(id);
        slot.clear();
        const double x = -125 + 6.25 * (next++ % 40 + 0.5);
        for (int shelf = 0; shelf < 5; ++shelf)
            for (int m = 0; m < 5; ++m) add_ragdoll(world, {x + 0.5 * m, 40 + 45.0 * shelf}, m, slot);
    };
    return set;
}

// ---- Small worlds ---------------------------------------------------------------------------------------------------

/// Awake all the time: what is timed is a step and not sleep.
Set on_the_ground() {
    Set set;
    set.sleeps = false;
    set.bodies.push_back(fixed({ground(Box{1000, 2, {0, -1}})}));
    return set;
}
Set one_box() {
    Set set = on_the_ground();
    set.bodies.push_back(square({0, 0.5}, 1));
    return set;
}
Set ten_boxes() {
    Set set = on_the_ground();
    for (int i = 0; i < 10; ++i) set.bodies.push_back(square({0, i + 0.5}, 1));
    return set;
}
Set pyramid_of_55() {
    Set set = on_the_ground();
    for (int i = 0; i < 10; ++i)
        for (int j = i; j < 10; ++j) set.bodies.push_back(square({0.55 * (i + 1) + 1.1 * (j - i) - 5, i + 0.5}, 1));
    return set;
}
Set boxes_apart() {
    Set set = on_the_ground();
    for (int i = 0; i < 200; ++i) set.bodies.push_back(square({3.0 * (i - 100), 0.5}, 1));
    return set;
}
Set one_ragdoll() {
    Set set = on_the_ground();
    set.act = [](World& world, std::vector<BodyId>& ids, int step) {
        if (step == 0) add_ragdoll(world, {0, 1}, 0, ids);
    };
    return set;
}

/// What is put down as it stands settles under sweeps, as what has been stirred does.
template <Set (*make)()>
Set settling() {
    Set set = make();
    set.statics = false;
    return set;
}

// ---- The engines ----------------------------------------------------------------------------------------------------

struct Result {
    double ms = 0, height = 0, energy = 0;
    std::size_t contacts = 0;
};

double since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Result run_carom(const Set& set, int steps, int threads, bool profile) {
    World world(
        {.gravity = set.gravity, .solver = SoftStep{.sleep = set.sleeps, .statics = set.statics}, .threads = threads});
    std::vector<BodyId> ids;
    for (const Body& b : set.bodies) {
        ids.push_back(world.add(b));
        if (b.kind == Kind::driven && set.curve) world.drive(ids.back(), set.curve);
    }
    for (Joint joint : set.joints) {
        if (joint.a) joint.a = ids[joint.a->index];
        joint.b = ids[joint.b.index];
        world.add(joint);
    }
    auto act = set.act;
    const auto step = [&](int n) {
        if (act) act(world, ids, n);
        world.step(frame);
    };
    world.measure_stages(profile);
    const auto start = std::chrono::steady_clock::now();
    for (int n = 0; n < steps; ++n) step(n);  // from the first step on: in that statics are solved
    Result result{.ms = 1e3 * since(start) / steps};
    for (const Vec2 x : world.positions()) result.height += x.y / static_cast<double>(world.size());
    result.energy = energy(world).kinetic + energy(world).rotational;
    result.contacts = world.contacts().size();
    for (const StageTime& t : world.stage_times())
        if (profile)
            std::printf("  %-16.*s %8.3f ms\n", static_cast<int>(t.stage.size()), t.stage.data(),
                        1e3 * t.seconds / steps);
    return result;
}

b2Vec2 to_b2(Vec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

/// False if Box2D 2.4 has no such shape.
bool add_fixture(b2Body& to, const Shape& from, const Body& of) {
    b2FixtureDef fixture;
    fixture.density = static_cast<float>(from.density.value_or(0));
    fixture.friction = static_cast<float>(from.friction.value_or(of.friction));
    fixture.restitution = static_cast<float>(of.restitution);
    fixture.filter.categoryBits = static_cast<uint16>(from.filter.category);
    fixture.filter.maskBits = static_cast<uint16>(from.filter.mask);
    b2PolygonShape polygon;
    b2CircleShape circle;
    b2EdgeShape edge;
    const auto corners = [&](const std::vector<Vec2>& points) {
        std::vector<b2Vec2> all;
        for (const Vec2 p : points) all.push_back(to_b2(p));
        polygon.Set(all.data(), static_cast<int32>(all.size()));
    };
    fixture.shape = &polygon;
    if (const auto* box = std::get_if<Box>(&from.geometry))
        polygon.SetAsBox(static_cast<float>(box->width / 2), static_cast<float>(box->height / 2), to_b2(box->centre),
                         0);
    else if (const auto* p = std::get_if<Polygon>(&from.geometry))
        corners(p->points);
    else if (const auto* hull = std::get_if<Hull>(&from.geometry))
        corners(hull->points);
    else if (const auto* disc = std::get_if<Disc>(&from.geometry))
        circle.m_radius = static_cast<float>(disc->radius), fixture.shape = &circle;
    else if (const auto* segment = std::get_if<Segment>(&from.geometry))
        edge.SetTwoSided(to_b2(segment->a), to_b2(segment->b)), fixture.shape = &edge;
    else
        return false;
    to.CreateFixture(&fixture);
    return true;
}

void add_joint(b2World& world, b2Body& earth, const std::vector<b2Body*>& bodies, const Joint& joint) {
    b2RevoluteJointDef def;
    b2Body* a = joint.a ? bodies[joint.a->index] : &earth;
    b2Body* b = bodies[joint.b.index];
    joint.at ? def.Initialize(a, b, to_b2(*joint.at)) : void();
    if (!joint.at) def.bodyA = a, def.bodyB = b, def.localAnchorA = to_b2(joint.anchor_a);
    if (!joint.at) def.localAnchorB = to_b2(joint.anchor_b);
    if (const auto& motor = std::get<RevoluteJoint>(joint.type).motor) {
        def.enableMotor = true, def.motorSpeed = static_cast<float>(motor->speed);
        def.maxMotorTorque = static_cast<float>(motor->maximum.value_or(1e30));
    }
    world.CreateJoint(&def);
}

/// Of ms 0 if Box2D 2.4 cannot express the scene.
Result run_box2d(const Set& set, int steps) {
    if (set.act) return {};
    b2World world(to_b2(set.gravity));
    world.SetAllowSleeping(set.sleeps);
    b2BodyDef nothing;
    b2Body* earth = world.CreateBody(&nothing);
    std::vector<b2Body*> bodies;
    for (const Body& from : set.bodies) {
        b2BodyDef def;
        def.type = from.kind == Kind::fixed    ? b2_staticBody
                   : from.kind == Kind::driven ? b2_kinematicBody
                                               : b2_dynamicBody;
        def.position = to_b2(from.position), def.linearVelocity = to_b2(from.velocity);
        def.angularVelocity = static_cast<float>(from.angular_velocity);
        bodies.push_back(world.CreateBody(&def));
        for (const Shape& s : from.shapes)
            if (!add_fixture(*bodies.back(), s, from)) return {};
    }
    for (const Joint& joint : set.joints) add_joint(world, *earth, bodies, joint);
    const auto step = [&](int n) {
        for (std::size_t i = 0; i < bodies.size() && set.curve; ++i)
            if (set.bodies[i].kind == Kind::driven)
                bodies[i]->SetLinearVelocity(60 *
                                             (to_b2(set.curve((n + 1) * frame).position) - bodies[i]->GetPosition()));
        world.Step(static_cast<float>(frame), 8, 3);
    };
    step(0);
    const auto start = std::chrono::steady_clock::now();
    for (int n = 1; n < steps; ++n) step(n);
    return {.ms = 1e3 * since(start) / std::max(1, steps - 1)};
}

struct Scene {
    const char* name;
    Set (*make)();
    int steps;
    double newest_ms;       ///< Box2D 3.2, AVX2, one thread, a step, in the study
    double height, energy;  ///< mean y [m] and kinetic energy [J] there at the end; 0 where it is not known
};
constexpr Scene scenes[] = {
    {"compounds", compounds, 500, 3.44, 45.1, 2.9e4},
    {"joint_grid", joint_grid, 500, 4.82, -53.78, 4.28e4},
    {"joint_grid_settling", settling<joint_grid>, 500, 4.82, -53.78, 4.28e4},
    {"junkyard", junkyard, 800, 3.46, 5.63, 6251},
    {"large_pyramid", large_pyramid, 500, 1.65, 33.156, 0.13},
    {"large_pyramid_settling", settling<large_pyramid>, 500, 1.65, 33.156, 0.13},
    {"many_pyramids", many_pyramids, 200, 7.68, 0, 0.001},
    {"many_pyramids_settling", settling<many_pyramids>, 200, 7.68, 0, 0.001},
    {"rain", rain, 1000, 7.36, 106, 2.7e4},
    {"smash", smash, 300, 4.74, 0, 2.1e5},
    {"spinner", spinner, 500, 8.58, 32.7, 1.244e6},
    {"tumbler", tumbler, 750, 1.97, 6.26, 5.22e4},
    {"washer", washer, 500, 10.14, 3.94, 5550},
    {"one_box", one_box, 10000, 0.0020, 0, 0},
    {"one_box_settling", settling<one_box>, 10000, 0.0020, 0, 0},
    {"ten_boxes", ten_boxes, 5000, 0.0036, 0, 0},
    {"ten_boxes_settling", settling<ten_boxes>, 5000, 0.0036, 0, 0},
    {"pyramid_of_55", pyramid_of_55, 3000, 0.0177, 0, 0},
    {"pyramid_of_55_settling", settling<pyramid_of_55>, 3000, 0.0177, 0, 0},
    {"one_ragdoll", one_ragdoll, 2000, 0.0075, 0, 0},
    {"boxes_apart", boxes_apart, 2000, 0.0260, 0, 0},
    {"boxes_apart_settling", settling<boxes_apart>, 2000, 0.0260, 0, 0},
};

}  // namespace

int main(int argc, char** argv) {
    const bool profile = argc > 1 && std::strcmp(argv[1], "profile") == 0;
    if (profile) --argc, ++argv;
    const std::string wanted = argc > 1 ? argv[1] : "";
    const int most = argc > 2 ? std::atoi(argv[2]) : 1000000;
    std::printf(
        "| scene | steps | Carom, 1 thread | 2 threads | Box2D 2.4 | Box2D 3.2 (quoted) | contact points | mean height "
        "| kinetic energy |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    for (const Scene& scene : scenes) {
        if (std::string(scene.name).find(wanted) == std::string::npos) continue;
        const Set set = scene.make();
        const int steps = std::min(most, scene.steps);
        const Result one = run_carom(set, steps, 1, profile), two = run_carom(set, steps, 2, false);
        const Result peer = run_box2d(set, steps);
        std::printf("| %s | %d | %.4g ms | %.4g ms | %s | %.3g ms | %zu | %.2f (%.2f) m | %.3g (%.3g) J |\n",
                    scene.name, steps, one.ms, two.ms,
                    peer.ms > 0 ? (std::to_string(peer.ms).substr(0, 5) + " ms").c_str() : "–", scene.newest_ms,
                    one.contacts, one.height, scene.height, one.energy, scene.energy);
        std::fflush(stdout);
    }
}
