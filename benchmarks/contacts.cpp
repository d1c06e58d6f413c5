// The quality of contact: scenes and tests on which Box2D 3.2 was measured in a study (dt 1/60, 4 substeps, its figures
// are quoted), rebuilt for SoftStep at its default settings. Prints the table of docs/performance.md.

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace carom;

constexpr double frame = 1.0 / 60, g = 10, turn = 6.283185307179586;
constexpr double solid = 0.6;  ///< friction

World soft_world(Vec2 gravity = {0, -g}) { return World({.gravity = gravity, .solver = SoftStep{}}); }
World on_floor(double friction = solid) {
    World world = soft_world();
    world.add(HalfPlane{.side = {1, friction}});
    return world;
}
Body box(Vec2 at, double width, double height, double density = 1, double friction = solid) {
    return {.position = at,
            .shapes = {{.geometry = Box{width, height}, .density = density}},
            .restitution = 0,
            .friction = friction};
}
Body disc(Vec2 at, double radius, double density = 1, double restitution = 0, double friction = solid) {
    return {.position = at,
            .shapes = {{.geometry = Disc{{}, radius}, .density = density}},
            .restitution = restitution,
            .friction = friction};
}
double kinetic(const World& world) { return energy(world).kinetic + energy(world).rotational; }
double fastest(const World& world) {
    double most = 0;
    for (const Vec2 v : world.velocities()) most = std::max(most, length(v));
    return most;
}
std::string text(const char* format, auto... numbers) {
    char line[200];
    std::snprintf(line, sizeof line, format, numbers...);
    return line;
}

// ---- Piles ----------------------------------------------------------------------------------------------------------

std::string single_box() {
    World world = on_floor(0.5);
    const BodyId id = world.add(box({0, 4}, 2, 2, 1, 0.5));
    double lowest = 4;
    run(world, 3, frame, [&](const World& now) { lowest = std::min(lowest, now.position(id).y); });
    return text("lowest %.5f, rests at %.8f", lowest, world.position(id).y);
}

std::string removed_load() {
    World world = on_floor();
    std::vector<BodyId> ids;
    for (int i = 0; i < 3; ++i) ids.push_back(world.add(disc({0, 0.5 + i}, 0.5, i == 2 ? 100 : 1)));
    run(world, 2, frame);
    const double low = 1.5 - world.position(ids[1]).y;
    world.remove(ids[2]);
    double high = 0, fast = 0;
    run(world, 1, frame, [&](const World& now) {
        high = std::max(high, now.position(ids[1]).y), fast = std::max(fast, now.velocity(ids[1]).y);
    });
    return text("middle %.1e m low; after that at most %.6f, %.1e m/s", low, high, fast);
}

std::string loaded_pyramids() {
    World world = on_floor();
    std::vector<BodyId> tops;
    for (int p = 0; p < 3; ++p) {
        const double middle = 30 * p;
        for (int row = 0; row < 9; ++row)
            for (int i = 0; i < 10 - row; ++i) world.add(box({middle + 2.0 * i - (9 - row), 1 + 2.0 * row}, 2, 2));
        tops.push_back(world.add(box({middle, 21}, 2, 2, 100.0 * (p + 1))));
    }
    run(world, 15, frame);
    std::string line = "sink";
    for (int p = 0; p < 3; ++p) line += text(" %.2f", 100 * (19 - world.position(tops[p]).y));
    line += " cm, aside";
    for (int p = 0; p < 3; ++p) line += text(" %.1f", 100 * (world.position(tops[p]).x - 30 * p));
    return line + " cm";
}

std::string great_on_small(bool triangles, double drop) {
    World world = on_floor();
    std::vector<BodyId> small;
    for (const double x : {-9.0, 9.0}) {
        Body body = box({x, 0.5}, 1, 1);
        if (triangles) body.shapes[0].geometry = Hull{{{-0.5, -0.5}, {0.5, -0.5}, {0, 0.5}}};
        small.push_back(world.add(body));
    }
    const BodyId great = world.add(box({0, 11 + drop}, 20, 20));
    double deepest = 0;
    run(world, 10, frame, [&](const World& now) { deepest = std::max(deepest, 11 - now.position(great).y); });
    double aside = 0;
    for (const BodyId id : small) aside = std::max(aside, std::abs(std::abs(world.position(id).x) - 9));
    return text("deepest %.2g m, at rest %.2g m low, a small one %.2g m aside", deepest, 11 - world.position(great).y,
                aside);
}

std::string overlapping_pyramid() {
    World world = on_floor();
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 4 - row; ++i) world.add(box({0.75 * (i - 0.5 * (3 - row)), 0.5 + 0.75 * row}, 1, 1));
    double fast = 0;
    run(world, 5, frame, [&](const World& now) { fast = std::max(fast, fastest(now)); });
    double top = 0;
    for (const Vec2 place : world.positions()) top = std::max(top, place.y);
    return text("at most %.2f m/s, top at %.4f of 3.5", fast, top);
}

std::string vertical_stack() {
    World world = on_floor(0.3);
    for (int i = 0; i < 15; ++i) world.add(box({i % 2 == 0 ? 0.01 : -0.01, 0.5 + 1.1 * i}, 1, 1, 1, 0.3));
    run(world, 10, frame);
    double aside = 0;
    for (const Vec2 place : world.positions()) aside = std::max(aside, std::abs(place.x));
    return text("top %.2f mm low, aside %.2f cm, %.0e J", 1000 * (14.5 - world.positions()[14].y), 100 * aside,
                kinetic(world));
}

std::string compression(int boxes) {
    World world = on_floor();
    for (int i = 0; i < boxes; ++i) world.add(box({0, 0.5 + i}, 1, 1));
    run(world, 20, frame);
    return text("%.2g mm", 1000 * (boxes - 0.5 - world.positions()[boxes - 1].y));
}

std::string pyramid() {
    World world = on_floor();
    BodyId top;
    for (int row = 0; row < 100; ++row)
        for (int i = 0; i < 100 - row; ++i) top = world.add(box({i - 0.5 * (99 - row), 0.5 + row}, 1, 1));
    run(world, 10, frame);
    return text("%.1f cm, aside %.1f cm", 100 * (99.5 - world.position(top).y), 100 * world.position(top).x);
}

std::string rush() {
    World world = soft_world({});
    for (int i = 0; i < 400; ++i) {
        const double angle = i * turn * 0.618, out = 10 + 0.12 * i;
        world.add(disc({out * std::cos(angle), out * std::sin(angle)}, 0.5, 1, 0, 0.6));
    }
    world.add(ForceField{.force = [](Vec2 x, Vec2, double, double) { return (-1000 / length(x)) * x; }});
    run(world, 30, frame);
    // The heap swings about the point as a whole, which nothing brakes.
    Vec2 swing{};
    for (const Vec2 v : world.velocities()) swing += v / 400;
    double out = 0, jostle = 0;
    for (std::size_t i = 0; i < world.size(); ++i) {
        out = std::max(out, length(world.positions()[i]) + 0.5);
        jostle = std::max(jostle, length(world.velocities()[i] - swing));
    }
    return text("radius %.2f m, swings at %.2g m/s, in itself %.2g m/s", out, length(swing), jostle);
}

std::string confined() {
    World world = soft_world({});
    world.add(Rectangle{.low = {-10, -10}, .high = {10, 10}});
    for (int i = 0; i < 25; ++i)
        for (int k = 0; k < 25; ++k) world.add(disc({-9.4 + 0.78 * i, -9.4 + 0.78 * k}, 0.5));
    run(world, 1, frame);
    const double fast = fastest(world);
    std::size_t out = 0;
    for (const Vec2 place : world.positions()) out += std::max(std::abs(place.x), std::abs(place.y)) > 10;
    return text("%.2g m/s after 1 s, %zu escape", fast, out);
}

std::string circle_stack() {
    World world = on_floor();
    for (int i = 0; i < 10; ++i) world.add(disc({0, 1.5 + 3.0 * i}, 1));
    run(world, 20, frame);
    double aside = 0;
    for (const Vec2 place : world.positions()) aside = std::max(aside, std::abs(place.x));
    return text("aside %.0e, top %.2g mm low", aside, 1000 * (19 - world.positions()[9].y));
}

std::string friction_ramp() {
    const double slope = 0.25;
    World world = soft_world({g * std::sin(slope), -g * std::cos(slope)});
    world.add(HalfPlane{.side = {1, 0.2}});
    for (const double friction : {0.75, 0.5, 0.35, 0.1, 0.0}) {
        Body body = box({0, 0.5}, 1, 1, 1, friction);
        body.shapes[0].filter.group = -1;
        world.add(body);
    }
    run(world, 5, frame);
    std::string line = "moved";
    for (const Vec2 place : world.positions()) line += text(" %.2g", place.x);
    return line + " m";
}

std::string heavy_on_light(double ratio) {
    World world = on_floor();
    world.add(box({0, 0.5}, 1, 1));
    const BodyId top = world.add(box({0, 1.5}, 1, 1, ratio));
    run(world, 10, frame);
    return text("%.1e m", 1.5 - world.position(top).y);
}

// ---- Impacts --------------------------------------------------------------------------------------------------------

std::string cradle(double gap) {
    World world = soft_world({});
    for (int i = 0; i < 5; ++i) world.add(disc({i * (1 + gap), 0}, 0.5, 1, 1, 0));
    world.set_velocity(world.ids()[0], {5, 0}, 0);
    run(world, 2, frame);
    std::string line;
    for (const Vec2 v : world.velocities()) line += text("%s%.12g", line.empty() ? "" : " ", v.x);
    return line;
}

std::string gas(double side, double speed) {
    World world = soft_world({});
    world.add(Rectangle{.low = {0, 0}, .high = {side, side}});
    const double pitch = side / 32;
    for (int i = 0; i < 1000; ++i) {
        Body one = disc({(i % 32 + 0.5) * pitch, (i / 32 + 0.5) * pitch}, 0.25, 1, 1, 0);
        one.velocity = {speed * std::cos(i * 2.4), speed * std::sin(i * 2.4)};
        world.add(one);
    }
    const double before = kinetic(world);
    run(world, 60, frame);
    return text("1 %+.0e", kinetic(world) / before - 1);
}

/// Heights of bounces over those of the closed form.
std::string bounces(Body body, double height, double restitution, int count) {
    World world = on_floor(0);
    body.restitution = restitution;
    const double under = body.position.y;
    body.position.y += height;
    const BodyId id = world.add(body);
    std::string line;
    double last = 0, wanted = height;
    for (int n = 0; n < count;) {
        const double before = world.velocity(id).y;
        world.step(frame);
        const double v = world.velocity(id).y;
        if (before > 0 && v <= 0) {  // energy is what it was at the apex
            wanted *= restitution * restitution;
            last = world.position(id).y - under + v * v / (2 * g);
            if (++n <= 3 || n == count) line += text("%s%.6f", line.empty() ? "" : " ", last / wanted);
        }
        if (world.time() > 100) return line + " dead";
    }
    return line;
}

std::string soft_hit() {
    World world = soft_world({});
    world.add(disc({0, 0}, 0.5, 1, 1, 0));
    world.add(disc({1.2, 0}, 0.5, 1, 1, 0));
    world.set_velocity(world.ids()[0], {0.1, 0}, 0);
    run(world, 4, frame);
    return text("%.12g, %.12g m/s", world.velocities()[0].x, world.velocities()[1].x);
}

std::string head_on() {
    World world = soft_world({});
    world.add(disc({-5.13, 0}, 0.25, 1, 1, 0));
    world.add(disc({5, 0}, 0.25, 1, 1, 0));
    world.set_velocity(world.ids()[0], {30, 0}, 0);
    world.set_velocity(world.ids()[1], {-30, 0}, 0);
    run(world, 1, frame);
    return text("%.12g, %.12g m/s", world.velocities()[0].x, world.velocities()[1].x);
}

// ---- Motion ---------------------------------------------------------------------------------------------------------

std::string free_fall() {
    World world = soft_world();
    const BodyId id = world.add(disc({0, 0}, 0.5));
    run(world, 10, frame);
    return text("%.0e m", world.position(id).y + 0.5 * g * 100);
}

std::string orbit() {
    World world = soft_world({});
    const BodyId id = world.add(disc({10, 0}, 0.5));
    const double v = std::sqrt(10.0);
    world.set_velocity(id, {0, v}, 0);
    world.add(
        ForceField{.force = [](Vec2 x, Vec2, double m, double) { return (-m * 100 / std::pow(length(x), 3)) * x; }});
    run(world, 60, frame);
    return text("r = %.6f m", length(world.position(id)));
}

std::string slow_disc() {
    World world = soft_world({});
    const BodyId id = world.add(disc({0, 0}, 0.5));
    world.set_velocity(id, {0.04, 0}, 0);
    run(world, 60, frame);
    return text("%.12g m/s", world.velocity(id).x);
}

std::string fast_disc() {
    World world = soft_world({});
    const BodyId id = world.add(disc({0, 0}, 0.5));
    world.set_velocity(id, {1e6, 0}, 1e4);
    run(world, 10, frame);
    return text("%.17g m/s, %.17g rad/s", world.velocity(id).x, world.angular_velocity(id));
}

std::string stop_distance() {
    World world = on_floor(0.5);
    const BodyId id = world.add(box({0, 0.25}, 0.5, 0.5, 1, 0.5));
    world.set_velocity(id, {5, 0}, 0);
    run(world, 3, frame);
    return text("%+.0e of it", world.position(id).x / (25 / (2 * 0.5 * g)) - 1);
}

std::string rolling() {
    World world = on_floor();
    const BodyId id = world.add(disc({0, 0.5}, 0.5));
    world.set_velocity(id, {5, 0}, -10);
    run(world, 10, frame);
    return text("speed %+.0e of it, sinks %.0e m", world.velocity(id).x / 5 - 1, 0.5 - world.position(id).y);
}

std::string far_away() {
    const Vec2 away{9e7, 0};
    World world = soft_world();
    world.add(HalfPlane{.point = away, .side = {1, solid}});
    for (int row = 0; row < 10; ++row)
        for (int i = 0; i < 10 - row; ++i) world.add(box(away + Vec2{i - 0.5 * (9 - row), 0.5 + row}, 1, 1));
    run(world, 10, frame);
    return text("%.1g m/s at 90 000 km", fastest(world));
}

struct Row {
    const char *test, *exact, *box2d;
    std::function<std::string()> carom;
};

const std::vector<Row> rows = {
    {"box of 2 m dropped by 3 m", "1, 1", "lowest 0.916, rests at 0.99991", single_box},
    {"three discs, the upper ×100, then removed", "0; 1.5", "6.4 cm; 1.508, 1.0 m/s", removed_load},
    {"pyramids of base 10, top ×100, ×200, ×300 dropped by 2 m", "0", "8.1, 15.6, 21.7 cm, aside −16 cm",
     loaded_pyramids},
    {"20 m box dropped by 16 m on two of 1 m (400 : 1)", "0", "0.99 m, 8.6 cm, 1 m",
     [] { return great_on_small(false, 16); }},
    {"the same on triangles, by 4 m", "0", "0.82 m, 16 cm", [] { return great_on_small(true, 4); }},
    {"boxes of friction .75 .5 .35 .1 0 on a slope of 0.25 rad", "0 0 0 14 31", "as it should be", friction_ramp},
    {"pyramid of base 4, overlap 25 %", "3.5", "3.4 m/s, no overshoot", overlapping_pyramid},
    {"15 boxes, pitch 1.1 m, 1 cm to either side", "0", "7.3 cm low, 4 cm aside", vertical_stack},
    {"stack of 10: sinks by", "0", "3.25 cm", [] { return compression(10); }},
    {"stack of 50: sinks by", "0", "87 cm", [] { return compression(50); }},
    {"pyramid of 100 rows: sinks by", "0", "73 cm, aside 1.6 cm", pyramid},
    {"400 discs pulled to one point", "–", "11.17 m, 0.012 m/s", rush},
    {"625 overlapping discs in a box", "0", "0.011 m/s, none", confined},
    {"10 discs dropped on one another", "0", "x = 0, top 2.6 cm low", circle_stack},
    {"box of 10 times the density on another: sinks", "0", "4.8 mm", [] { return heavy_on_light(10); }},
    {"100 times", "0", "4.4 cm", [] { return heavy_on_light(100); }},
    {"1000 times", "0", "falls through", [] { return heavy_on_light(1000); }},
    {"cradle of 5 touching discs at 5 m/s", "0 0 0 0 5", "−1.88 .71 1.59 2.29 2.29", [] { return cradle(0); }},
    {"gaps of 1 cm", "0 0 0 0 5", "energy 0.586", [] { return cradle(0.01); }},
    {"gas, 1000 discs, 40 m, 5 m/s: energy after 60 s", "1", "0.287", [] { return gas(40, 5); }},
    {"in 20 m", "1", "0.0045", [] { return gas(20, 5); }},
    {"in 40 m, 20 m/s", "1", "0.049", [] { return gas(40, 20); }},
    {"in 40 m, 1 m/s", "1", "0.014", [] { return gas(40, 1); }},
    {"disc from 5 m, e 0.8: bounces 1, 2, 3, 9", "1", ".993 .991 .972 … dead",
     [] {
         return bounces(disc({0, 0.5}, 0.5), 5, 0.8, 9);
     }},
    {"e 0.5: 1, 2, 3, 4", "1", ".988 .921 .840 .607",
     [] {
         return bounces(disc({0, 0.5}, 0.5), 5, 0.5, 4);
     }},
    {"box, e 0.8", "1", ".77 .65 .45",
     [] {
         return bounces(box({0, 0.5}, 1, 1), 5, 0.8, 3);
     }},
    {"e 1 from 0.5 m: 1, 2, 3, 60", "1", "dead at 15 s",
     [] {
         return bounces(disc({0, 0.5}, 0.5), 0.5, 1, 60);
     }},
    {"elastic hit at 0.1 m/s", "0, 0.1", "0.05, 0.05", soft_hit},
    {"two discs head on at ±30 m/s", "−30, 30", "pass through", head_on},
    {"free fall of 10 s", "0", "−0.208 m", free_fall},
    {"circular orbit under a user's force, 60 s", "10", "15.1 m", orbit},
    {"free disc at 0.04 m/s, 60 s", "0.04", "stopped", slow_disc},
    {"free disc at 1e6 m/s and 1e4 rad/s", "the same", "400 m/s, 47 rad/s", fast_disc},
    {"stopping distance from 5 m/s, µ 0.5", "0", "−8e-4 to −3.3e-3", stop_distance},
    {"rolling disc, 10 s", "0", "−4e-4, 7 mm", rolling},
    {"pyramid far from the origin: jitter", "0", "0.18 m/s at 90 km", far_away},
};

}  // namespace

int main(int count, char** arguments) {
    std::printf("| test | exact | Box2D 3.2 | Carom |\n|---|---|---|---|\n");
    for (const Row& row : rows) {
        if (count > 1 && std::string(row.test).find(arguments[1]) == std::string::npos) continue;
        std::printf("| %s | %s | %s | %s |\n", row.test, row.exact, row.box2d, row.carom().c_str());
        std::fflush(stdout);
    }
}
