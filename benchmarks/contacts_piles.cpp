// The quality of contact: piles, stacks and crowds.

#include "contacts.hpp"

namespace contacts {

namespace {

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
    const double low = 1.5 - world.position(ids[1]).y, top = 2.5 - world.position(ids[2]).y;
    world.remove(ids[2]);
    double high = 0, fast = 0;
    run(world, 1, frame, [&](const World& now) {
        high = std::max(high, now.position(ids[1]).y), fast = std::max(fast, now.velocity(ids[1]).y);
    });
    return text("middle %.1e m low, top %.1e; after that at most %.6f, %.1e m/s", low, top, high, fast);
}

/// Each in a world of its own, or all in one.
std::string loaded_pyramids() {
    std::string sink = "sink", aside = " cm, aside";
    World world = on_floor();
    std::vector<BodyId> tops;
    for (int p = 0; p < 3; ++p) {
        const double middle = 30 * p;
        for (int row = 0; row < 9; ++row)
            for (int i = 0; i < 10 - row; ++i) world.add(box({middle + 2.0 * i - (9 - row), 1 + 2.0 * row}, 2, 2));
        tops.push_back(world.add(box({middle, 21}, 2, 2, 100.0 * (p + 1))));
    }
    run(world, 15, frame);
    for (int p = 0; p < 3; ++p) {
        const Vec2 top = world.position(tops[p]);
        sink += text(" %.2f", 100 * (19 - top.y)), aside += text(" %.2f", 100 * (top.x - 30 * p));
    }
    return sink + aside + " cm";
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

std::string compression(int boxes, bool statics) {
    World world = on_floor(solid, statics);
    for (int i = 0; i < boxes; ++i) world.add(box({0, 0.5 + i}, 1, 1));
    run(world, 20, frame);
    return text("%.2g mm", 1000 * (boxes - 0.5 - world.positions()[boxes - 1].y));
}

/// Adds boxes of 1 m and 1 kg in so many rows: the one on top.
BodyId add_pyramid(World& world, int base) {
    BodyId top;
    for (int row = 0; row < base; ++row)
        for (int i = 0; i < base - row; ++i) top = world.add(box({i - 0.5 * (base - 1 - row), 0.5 + row}, 1, 1));
    return top;
}

std::string place_of_top(const World& world, BodyId top, int base) {
    return text("%.2g cm, aside %.2g cm", 100 * (base - 0.5 - world.position(top).y), 100 * world.position(top).x);
}

std::string pyramid(int base, bool statics) {
    World world = on_floor(solid, statics);
    const BodyId top = add_pyramid(world, base);
    run(world, 10, frame);
    return place_of_top(world, top, base);
}

std::string stirred_pyramid(int base) {
    World world = on_floor();
    const BodyId top = add_pyramid(world, base);
    world.add(box({0, base + 1.15}, 0.3, 0.3, 0.1));
    run(world, 10, frame);
    return place_of_top(world, top, base) + text(", then %.0e m/s", fastest(world));
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
    return text("radius %.2f m, swings at %.2g m/s, in itself %.2g m/s, overlap %.2g cm", out, length(swing), jostle,
                100 * deepest(world, 0.5));
}

std::string confined() {
    World world = soft_world({});
    world.add(Rectangle{.low = {-10, -10}, .high = {10, 10}});
    for (int i = 0; i < 25; ++i)
        for (int k = 0; k < 25; ++k) world.add(disc({-9.4 + 0.78 * i, -9.4 + 0.78 * k}, 0.5));
    run(world, 1, frame);
    const double fast = fastest(world), after = deepest(world, 0.5, 10);
    run(world, 9, frame);
    std::size_t out = 0;
    for (const Vec2 place : world.positions()) out += std::max(std::abs(place.x), std::abs(place.y)) > 10;
    return text("%.2g m/s after 1 s, %zu escape, overlap %.2g cm, after 10 s %.2g m/s, %.2g cm", fast, out, 100 * after,
                fastest(world), 100 * deepest(world, 0.5, 10));
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

std::string heavy_on_light(double ratio, int light = 1, bool statics = true) {
    World world = on_floor(solid, statics);
    for (int i = 0; i < light; ++i) world.add(box({0, 0.5 + i}, 1, 1));
    const BodyId top = world.add(box({0, 0.5 + light}, 1, 1, ratio));
    run(world, 10, frame);
    return text("%.1e m", 0.5 + light - world.position(top).y);
}

/// How far above the angle of friction a block begins to slide: in ten seconds by more than a micrometre.
std::string slip_threshold() {
    const auto slides = [](double slope) {
        World world = soft_world({g * std::sin(slope), -g * std::cos(slope)});
        world.add(HalfPlane{.side = {1, 0.5}});
        const BodyId id = world.add(box({0, 0.25}, 0.5, 0.5, 1, 0.5));
        run(world, 10, frame);
        return world.position(id).x > 1e-6;
    };
    double stays = std::atan(0.4), goes = std::atan(0.6);
    while (goes - stays > 1e-12) (slides((stays + goes) / 2) ? goes : stays) = (stays + goes) / 2;
    return text("%+.0e of µ", std::tan(stays) / 0.5 - 1);
}

}  // namespace

std::vector<Row> piles() {
    return {
        {"box of 2 m dropped by 3 m", "1, 1", "lowest 0.916, rests at 0.99991", single_box},
        {"three discs, the upper ×100, then removed", "0; 1.5", "6.4 cm, top 9.3 cm; 1.508, 1.0 m/s", removed_load},
        {"pyramids of base 10, top ×100, ×200, ×300 dropped by 2 m", "0", "8.1, 15.6, 21.7 cm, aside −16 cm",
         loaded_pyramids},
        {"20 m box dropped by 16 m on two of 1 m (400 : 1)", "0", "0.99 m, 8.6 cm, 1 m",
         [] { return great_on_small(false, 16); }},
        {"the same on triangles, by 4 m", "0", "0.82 m, 16 cm", [] { return great_on_small(true, 4); }},
        {"boxes of friction .75 .5 .35 .1 0 on a slope of 0.25 rad", "0 0 0 14 31", "as it should be", friction_ramp},
        {"pyramid of base 4, overlap 25 %", "3.5", "3.4 m/s, no overshoot", overlapping_pyramid},
        {"15 boxes, pitch 1.1 m, 1 cm to either side", "0", "7.3 cm low, 4 cm aside", vertical_stack},
        {"stack of 10: sinks by", "0", "3.25 cm", [] { return compression(10, true); }},
        {"the same without statics", "0", "3.25 cm", [] { return compression(10, false); }},
        {"stack of 50: sinks by", "0", "87 cm", [] { return compression(50, true); }},
        {"without statics", "0", "87 cm", [] { return compression(50, false); }},
        {"pyramid of 30 rows: sinks by", "0", "6.7 cm", [] { return pyramid(30, true); }},
        {"without statics", "0", "6.7 cm", [] { return pyramid(30, false); }},
        {"pyramid of 100 rows: sinks by", "0", "73 cm, aside 1.6 cm", [] { return pyramid(100, true); }},
        {"without statics", "0", "73 cm, aside 1.6 cm", [] { return pyramid(100, false); }},
        {"pyramid of 100 rows, and 0.1 kg falls on it", "0", "–", [] { return stirred_pyramid(100); }},
        {"400 discs pulled to one point", "–", "11.17 m, 0.012 m/s, 1.7 cm", rush},
        {"625 overlapping discs in a box", "0", "0.011 m/s, none, 32 cm", confined},
        {"10 discs dropped on one another", "0", "x = 0, top 2.6 cm low", circle_stack},
        {"box on another of its density: sinks", "0", "0.9 mm", [] { return heavy_on_light(1); }},
        {"box of 10 times the density on another: sinks", "0", "4.8 mm", [] { return heavy_on_light(10); }},
        {"100 times", "0", "4.4 cm", [] { return heavy_on_light(100); }},
        {"1000 times", "0", "falls through", [] { return heavy_on_light(1000); }},
        {"1000 times, without statics", "0", "falls through", [] { return heavy_on_light(1000, 1, false); }},
        {"10 times, on ten: sinks", "0", "10 cm", [] { return heavy_on_light(10, 10); }},
        {"200 times, on ten", "0", "collapses", [] { return heavy_on_light(200, 10); }},
        {"200 times, on ten, without statics", "0", "collapses", [] { return heavy_on_light(200, 10, false); }},
        {"a block begins to slide at: off by", "0", "±0.5 %", slip_threshold},
    };
}

}  // namespace contacts
