// Mechanisms beside Box2D 2.4, scene by scene: microseconds a step, and how far the joints come apart. dt 1/60; Carom
// with its 4 substeps, Box2D with its 8 and 3 iterations. Prints the table of docs/performance.md.
// carom_joints [SCENE] [alone]: the scenes whose names have SCENE in them, alone without Box2D.

#include <box2d/box2d.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace {

constexpr double frame = 1.0 / 60, gravity = 9.81;

/// A scene that either engine builds: boxes and the hinges between them.
struct Box {
    double x, y, width, height, density;
    bool fixed = false;
};
struct Hinge {
    int a, b;  ///< −1: the ground
    double x, y;
    double friction = 0;                     ///< torque [N m]
    std::optional<double> lower{}, upper{};  ///< [rad]
};
struct Scene {
    std::string name;
    int steps;
    std::vector<Box> boxes;
    std::vector<Hinge> hinges;
    bool statics = true;  ///< in Carom forces are looked for that hold what is put down as it is
};

/// µs a step, and over the whole run the largest gap of a joint and the largest sum of gaps [m].
struct Outcome {
    double time = 0, gap = 0, sum = 0;
};

template <class Step, class Gap>
Outcome run(const Scene& scene, Step step, Gap gap_of) {
    using Clock = std::chrono::steady_clock;
    Outcome out;
    step();  // what is made once
    for (int i = 0; i < scene.steps; ++i) {
        const auto begin = Clock::now();
        step();
        out.time += std::chrono::duration<double, std::micro>(Clock::now() - begin).count() / scene.steps;
        double sum = 0;
        for (std::size_t k = 0; k < scene.hinges.size(); ++k) {
            const double gap = gap_of(k);
            out.gap = std::max(out.gap, gap), sum += gap;
        }
        out.sum = std::max(out.sum, sum);
    }
    return out;
}

Outcome of_carom(const Scene& scene) {
    using namespace carom;
    World world({.gravity = {0, -gravity}, .solver = SoftStep{.sleep = false, .statics = scene.statics}, .threads = 1});
    std::vector<BodyId> ids;
    for (const Box& b : scene.boxes) {
        const double mass = b.density * b.width * b.height;
        ids.push_back(world.add(Body{.kind = b.fixed ? Kind::fixed : Kind::dynamic,
                                     .position = {b.x, b.y},
                                     .mass = mass,
                                     .moment_of_inertia = mass * (b.width * b.width + b.height * b.height) / 12}));
    }
    std::vector<JointId> joints;
    for (const Hinge& h : scene.hinges) {
        RevoluteJoint type{.limits = {h.lower, h.upper}};
        if (h.friction > 0) type.motor = JointMotor{.maximum = h.friction};
        const auto id = [&](int i) { return ids[static_cast<std::size_t>(i)]; };
        joints.push_back(world.add(Joint{
            .a = h.a < 0 ? std::nullopt : std::optional(id(h.a)), .b = id(h.b), .at = Vec2{h.x, h.y}, .type = type}));
    }
    return run(
        scene, [&] { world.step(frame); }, [&](std::size_t k) { return world.reaction(joints[k]).gap; });
}

Outcome of_box2d(const Scene& scene) {
    const auto single = [](double x) { return static_cast<float>(x); };
    b2World world({0, single(-gravity)});
    world.SetAllowSleeping(false);
    b2BodyDef ground_def;
    b2Body* ground = world.CreateBody(&ground_def);
    std::vector<b2Body*> bodies;
    for (const Box& b : scene.boxes) {
        b2BodyDef def;
        def.type = b.fixed ? b2_staticBody : b2_dynamicBody;
        def.position.Set(single(b.x), single(b.y));
        b2PolygonShape shape;
        shape.SetAsBox(single(b.width / 2), single(b.height / 2));
        b2FixtureDef fixture;
        fixture.shape = &shape, fixture.density = single(b.density);
        fixture.filter.maskBits = 0;
        bodies.push_back(world.CreateBody(&def));
        bodies.back()->CreateFixture(&fixture);
    }
    std::vector<b2Joint*> joints;
    for (const Hinge& h : scene.hinges) {
        b2RevoluteJointDef def;
        const auto body = [&](int i) { return i < 0 ? ground : bodies[static_cast<std::size_t>(i)]; };
        def.Initialize(body(h.a), body(h.b), {single(h.x), single(h.y)});
        def.enableMotor = h.friction > 0, def.maxMotorTorque = single(h.friction);
        def.enableLimit = h.lower.has_value();
        if (h.lower) def.lowerAngle = single(*h.lower), def.upperAngle = single(*h.upper);
        joints.push_back(world.CreateJoint(&def));
    }
    return run(
        scene, [&] { world.Step(single(frame), 8, 3); },
        [&](std::size_t k) { return (joints[k]->GetAnchorA() - joints[k]->GetAnchorB()).Length(); });
}

/// Rods of 0.5 m and 1 kg, dropped from the horizontal with a load at the end.
Scene rope(int rods, double load) {
    Scene s{"rope of " + std::to_string(rods) + " rods, load " + std::to_string(int(load)) + " rods", 600, {}, {}};
    for (int i = 0; i < rods; ++i) {
        s.boxes.push_back({0.5 * (i + 0.5), 0, 0.5, 0.1, 20});
        s.hinges.push_back({i - 1, i, 0.5 * i, 0});
    }
    if (load > 0) s.boxes.push_back({0.5 * rods, 0, 1, 1, load}), s.hinges.push_back({rods - 1, rods, 0.5 * rods, 0});
    return s;
}
/// Planks of a metre, as long together as the gap they span.
Scene bridge(int planks, double friction) {
    Scene s{"bridge of " + std::to_string(planks) + " planks, no slack" + (friction > 0 ? ", dry friction" : ""),
            300,
            {},
            {}};
    for (int i = 0; i < planks; ++i) {
        s.boxes.push_back({i + 0.5, 0, 1, 0.25, 20});
        s.hinges.push_back({i - 1, i, double(i), 0, friction});
    }
    s.boxes.push_back({double(planks), 0, 1, 1, 1, true});
    s.hinges.push_back({planks - 1, planks, double(planks), 0, friction});
    return s;
}
/// A sheet of n × n, hinged to its neighbours, that hangs from seven in the middle of the top row, or from a corner.
enum class Hangs { stands, is_solved, swings };
Scene grid(int n, int steps, Hangs how) {
    const bool swings = how == Hangs::swings;
    const char* const way = swings ? " that swings" : how == Hangs::stands ? " that stands" : "";
    Scene s{"grid of " + std::to_string(n) + " x " + std::to_string(n) + way, steps, {}, {}, how != Hangs::is_solved};
    for (int k = 0; k < n; ++k)
        for (int i = 0; i < n; ++i) {
            const bool is_fixed_here = i == 0 && (swings ? k == 0 : std::abs(k - n / 2) <= 3);
            s.boxes.push_back({double(k), -double(i), 0.8, 0.8, 1, is_fixed_here});
            const int own = k * n + i;
            const auto hinge = [&](int to, double x, double y) {
                const auto is_fixed = [&](int body) { return s.boxes[static_cast<std::size_t>(body)].fixed; };
                if (!is_fixed(to) || !is_fixed(own)) s.hinges.push_back({to, own, x, y});
            };
            if (i > 0) hinge(own - 1, k, 0.5 - i);
            if (k > 0) hinge(own - n, k - 0.5, -i);
        }
    return s;
}
/// Eleven bones and ten joints with limits and dry friction, each hung up by the head.
Scene ragdolls(int count) {
    Scene s{std::to_string(count) + " ragdolls hung up by the head", 120, {}, {}};
    const double pi = std::acos(-1.0);
    for (int d = 0; d < count; ++d) {
        const double x = 3.0 * d;
        const int first = static_cast<int>(s.boxes.size());
        // Side by side, for nothing is to collide here.
        const auto bone = [&](double y, double length, double width, double aside = 0) {
            s.boxes.push_back({x + aside, y, width, length, 1});
        };
        const auto joint = [&](int a, int b, double y, double lower, double upper, double friction) {
            s.hinges.push_back({first + a, first + b, x, y, friction, lower * pi, upper * pi});
        };
        bone(0.95, 0.23, 0.19), bone(1.2, 0.45, 0.18), bone(1.475, 0.23, 0.15);
        joint(0, 1, 1.0, -0.25, 0.05, 0.025), joint(1, 2, 1.4, -0.3, 0.1, 0.0125);
        for (int side = 0; side < 2; ++side) {
            const int n = 3 + 2 * side;
            bone(0.775, 0.37, 0.12, 0.2 * side - 0.1), bone(0.475, 0.37, 0.09, 0.2 * side - 0.1);
            joint(0, n, 0.9, -0.05, 0.4, 0.05), joint(n, n + 1, 0.625, -0.5, 0.02, 0.025);
        }
        for (int side = 0; side < 2; ++side) {
            const int n = 7 + 2 * side;
            bone(1.225, 0.32, 0.07, 0.5 * side - 0.25), bone(0.975, 0.31, 0.06, 0.5 * side - 0.25);
            joint(1, n, 1.35, -0.1, 0.8, 0.025), joint(n, n + 1, 1.1, -0.2, 0.3, 0.005);
        }
        s.hinges.push_back({-1, first + 2, x + 0.05, 1.55});
    }
    return s;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string wanted = argc > 1 ? argv[1] : "";
    const Scene scenes[] = {rope(50, 0),
                            rope(50, 1000),
                            bridge(160, 0),
                            bridge(160, 200),
                            grid(20, 120, Hangs::is_solved),
                            grid(60, 3, Hangs::is_solved),
                            grid(60, 120, Hangs::stands),
                            grid(20, 120, Hangs::swings),
                            ragdolls(1000)};
    std::printf(
        "| scene | Carom [µs/step] | worst gap [m] | all gaps [m] | Box2D 2.4 [µs/step] | worst gap [m] | "
        "all gaps [m] |\n|---|---|---|---|---|---|---|\n");
    for (const Scene& s : scenes) {
        if (s.name.find(wanted) == std::string::npos) continue;
        const Outcome c = of_carom(s), b = argc > 2 ? Outcome{} : of_box2d(s);
        std::printf("| %s | %.0f | %.1e | %.1e | %.0f | %.1e | %.1e |\n", s.name.c_str(), c.time, c.gap, c.sum, b.time,
                    b.gap, b.sum);
        std::fflush(stdout);
    }
}
