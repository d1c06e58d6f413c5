// The quality of contact: what stands or falls as a whole, here and far from the origin.

#include "../tests/arch.hpp"
#include "contacts.hpp"

namespace contacts {

namespace {

std::string arch() {
    World world = on_floor();
    const BodyId key = test::add_arch(world, solid);
    const double height = world.position(key).y;
    run(world, 10, frame);
    const double after = world.position(key).y;
    run(world, 20, frame);
    return text("keystone %.1f mm low after 10 s, %.1f after 30 s, then %.0e m/s", 1000 * (height - after),
                1000 * (height - world.position(key).y), fastest(world));
}

/// The least thickness of half a circle of 60 stones that stands, in parts of its radius.
std::string thinnest_arch() {
    double falls = 0.09, stands = 0.13;
    while (stands - falls > 1e-6) {
        const double between = (falls + stands) / 2;
        World world = on_floor(0.9);
        test::add_half_circle(world, between, 60);
        run(world, 1, frame);
        (fastest(world) == 0 ? stands : falls) = between;
    }
    return text("%.5f", stands);
}

std::string dominoes() {
    World world = on_floor();
    std::vector<BodyId> ids;
    for (int i = 0; i < 15; ++i) ids.push_back(world.add(box({i - 7.5, 0.5}, 0.25, 1)));
    const double mass = 0.25, inertia = mass * (1 + 0.25 * 0.25) / 12, impulse = 0.2;
    world.set_velocity(ids[0], {impulse / mass, 0}, -impulse * 0.5 / inertia);
    double last = 0;
    run(world, 15, frame, [&](const World& now) {
        if (last == 0 && now.angle(ids.back()) < -turn / 8) last = now.time();
    });
    int down = 0;
    for (const BodyId id : ids) down += world.angle(id) < -turn / 8;
    return text("%d fall, the last at %.2f s", down, last);
}

/// Five storeys of cards of 0.4 m that touch from the start, as in scenes/contacts/card-house.json.
std::string card_house() {
    constexpr double card = 0.4, thick = 0.002, lean = 26 * turn / 360, rough = 0.7;
    const double reach = card / 2 * std::sin(lean) + thick / 2 * std::cos(lean),
                 rise = card / 2 * std::cos(lean) + thick / 2 * std::sin(lean), storey = 2 * rise + thick;
    World world = soft_world();
    world.add(HalfPlane{.side = {0, rough}});
    const auto place = [&](Vec2 at, double angle, double width, double height) {
        Body body = box(at, width, height, 1, rough);
        body.angle = angle;
        world.add(body);
    };
    for (int level = 0; level < 5; ++level)
        for (int i = 0; i < 5 - level; ++i) {
            const Vec2 middle{(i - 0.5 * (4 - level)) * card, level * storey + rise};
            place(middle - Vec2{reach, 0}, -lean, thick, card);
            place(middle + Vec2{reach, 0}, lean, thick, card);
            if (i + level < 4) place({middle.x + card / 2, (level + 1) * storey - thick / 2}, 0, card, thick);
        }
    const std::vector<Vec2> built(world.positions().begin(), world.positions().end());
    run(world, 30, frame);
    double most = 0;
    for (std::size_t i = 0; i < built.size(); ++i) most = std::max(most, length(world.positions()[i] - built[i]));
    return text("%.2f mm, then %.0e m/s", 1000 * most, fastest(world));
}

// ---- Far from the origin --------------------------------------------------------------------------------------------

constexpr Vec2 away{9e7, -9e7};

World far_floor(double friction = solid) {
    World world = soft_world();
    world.add(HalfPlane{.point = away, .side = {1, friction}});
    return world;
}

std::string far_pyramid() {
    World world = far_floor();
    for (int row = 0; row < 10; ++row)
        for (int i = 0; i < 10 - row; ++i) world.add(box(away + Vec2{i - 0.5 * (9 - row), 0.5 + row}, 1, 1));
    run(world, 10, frame);
    return text("%.1g m/s at 130 000 km", fastest(world));
}

std::string far_stack() {
    World world = far_floor(0.3);
    for (int i = 0; i < 15; ++i) world.add(box(away + Vec2{i % 2 == 0 ? 0.01 : -0.01, 0.5 + 1.1 * i}, 1, 1, 1, 0.3));
    run(world, 10, frame);
    return text("%.1g m/s, top %.2f mm low", fastest(world), 1000 * (14.5 - (world.positions()[14].y - away.y)));
}

std::string far_recovery() {
    World world = far_floor();
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 4 - row; ++i)
            world.add(box(away + Vec2{0.75 * (i - 0.5 * (3 - row)), 0.5 + 0.75 * row}, 1, 1));
    double fast = 0, top = 0;
    run(world, 5, frame, [&](const World& now) { fast = std::max(fast, fastest(now)); });
    for (const Vec2 place : world.positions()) top = std::max(top, place.y - away.y);
    return text("at most %.2f m/s, top at %.4f of 3.5, then %.1g m/s", fast, top, fastest(world));
}

}  // namespace

std::vector<Row> structures() {
    return {
        {"arch of 17 stones under 4 slabs", "0", "stands, keystone 30 cm low", arch},
        {"half a circle of 60 stones stands if it is as thick as", "0.1075", "–", thinnest_arch},
        {"15 dominoes 1 m apart, impulse 0.2 at the first", "all fall", "all, the last at 7.8 s", dominoes},
        {"house of 40 cards of 2 mm: moves in 30 s by", "0", "38 mm; 7 mm in another layout", card_house},
        {"pyramid of base 10 far from the origin: jitter", "0", "0.18 m/s at 90 km", far_pyramid},
        {"15 boxes as above, far away", "0", "0.067 m/s at 40 km (a pyramid)", far_stack},
        {"overlap of 25 % as above, far away", "3.5", "0.18 m/s at 90 km (a pyramid)", far_recovery},
    };
}

}  // namespace contacts
