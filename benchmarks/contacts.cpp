// The quality of contact: scenes and tests on which Box2D 3.2 was measured in a study (dt 1/60, 4 substeps, its figures
// are quoted), rebuilt for SoftStep at its default settings. Prints the table of docs/performance.md.

#include "contacts.hpp"

namespace {

using namespace contacts;

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
    std::string line;
    for (const double duration : {1, 9, 50}) {
        run(world, duration, frame);
        line += text("%s1 %+.0e", line.empty() ? "" : ", ", kinetic(world) / before - 1);
    }
    return line;
}

/// Energy after 1, 10 and 60 s, and the mean share of spin in the last 50.
std::string gas_of_boxes() {
    World world = soft_world({});
    world.add(Rectangle{.low = {0, 0}, .high = {10, 10}});
    for (int i = 0; i < 100; ++i) {
        Body one = box({i % 10 + 0.5, i / 10 + 0.5}, 0.5, 0.3, 1, 0);
        one.angle = 1.1 * i, one.velocity = {5 * std::cos(i * 2.4), 5 * std::sin(i * 2.4)}, one.restitution = 1;
        world.add(one);
    }
    const double before = kinetic(world);
    std::string line;
    double spin = 0;
    const auto book = [&](const World& now) { spin += energy(now).rotational / kinetic(now) / 3000; };
    for (const double duration : {1, 9, 50}) {
        run(world, duration, frame, duration < 50 ? std::function<void(const World&)>{} : book);
        line += text("1 %+.0e, ", kinetic(world) / before - 1);
    }
    return line + text("%.3f", spin);
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

/// Energy of a ball that bounces for a minute, over that at its start.
std::string elastic_for_a_minute(double height) {
    World world = on_floor(0);
    const BodyId id = world.add(disc({0, 0.5 + height}, 0.5, 1, 1));
    run(world, 60, frame);
    const double v = world.velocity(id).y;
    return text("1 %+.0e", (world.position(id).y - 0.5 + v * v / (2 * g)) / height - 1);
}

/// How much of its time a ball loses at every hit between two walls that it strikes in the midst of steps.
std::string wall_hits() {
    constexpr double room = 9.5, radius = 0.25, speed = 31, duration = 10;
    World world = soft_world({});
    for (const double side : {-1.0, 1.0}) {
        Body wall = box({side * (room / 2 + 0.5), 0}, 1, 2, 1, 0);
        wall.kind = Kind::fixed, wall.restitution = 1;
        world.add(wall);
    }
    const BodyId id = world.add(disc({0, 0}, radius, 1, 1, 0));
    world.set_velocity(id, {speed, 0}, 0);
    run(world, duration, frame);
    const double way = room - 2 * radius, hits = std::floor((speed * duration + way / 2) / way);
    const double from_start = speed * duration - hits * way;  // it is this far beyond the middle, along its way
    const double late = from_start - (world.velocity(id).x > 0 ? 1 : -1) * world.position(id).x;
    return text("%.0e s", std::abs(late) / speed / hits);
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

}  // namespace

std::vector<Row> contacts::impacts_and_motion() {
    return {
        {"cradle of 5 touching discs at 5 m/s", "0 0 0 0 5", "−1.88 .71 1.59 2.29 2.29", [] { return cradle(0); }},
        {"gaps of 1 cm", "0 0 0 0 5", "energy 0.586", [] { return cradle(0.01); }},
        {"gaps of 10 cm", "0 0 0 0 5", "exact", [] { return cradle(0.1); }},
        {"gas, 1000 discs, 40 m, 5 m/s: energy after 1, 10, 60 s", "1", "0.980 0.785 0.287", [] { return gas(40, 5); }},
        {"in 20 m", "1", "0.474 0.040 0.0045", [] { return gas(20, 5); }},
        {"in 40 m, 20 m/s", "1", "0.907 0.345 0.049", [] { return gas(40, 20); }},
        {"in 40 m, 1 m/s", "1", "0.944 0.403 0.014", [] { return gas(40, 1); }},
        {"100 boxes of 50 × 30 cm, 10 m, 5 m/s; share of their spins", "1; 0.333", "1.14 2.05 2.24, 0.226",
         [] { return gas_of_boxes(); }},
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
        {"e 1 from 5 m: after 60 s", "1", "0.997", [] { return elastic_for_a_minute(5); }},
        {"from 1 m", "1", "0.925 at 5 s, dead at 45 s", [] { return elastic_for_a_minute(1); }},
        {"e 1 from 0.5 m: 1, 2, 3, 60", "1", "dead at 15 s",
         [] {
             return bounces(disc({0, 0.5}, 0.5), 0.5, 1, 60);
         }},
        {"elastic hit at 0.1 m/s", "0, 0.1", "0.05, 0.05", soft_hit},
        {"two discs head on at ±30 m/s", "−30, 30", "pass through", head_on},
        {"a fast disc at a wall: time lost a hit", "0", "0.017 s", wall_hits},
        {"free fall of 10 s", "0", "−0.208 m", free_fall},
        {"circular orbit under a user's force, 60 s", "10", "15.1 m", orbit},
        {"free disc at 0.04 m/s, 60 s", "0.04", "stopped", slow_disc},
        {"free disc at 1e6 m/s and 1e4 rad/s", "the same", "400 m/s, 47 rad/s", fast_disc},
        {"stopping distance from 5 m/s, µ 0.5", "0", "−8e-4 to −3.3e-3", stop_distance},
        {"rolling disc, 10 s", "0", "−4e-4, 7 mm", rolling},
    };
}

int main(int count, char** arguments) {
    std::printf("| test | exact | Box2D 3.2 | Carom |\n|---|---|---|---|\n");
    for (const auto rows : {piles, structures, impacts_and_motion})
        for (const Row& row : rows()) {
            if (count > 1 && std::string(row.test).find(arguments[1]) == std::string::npos) continue;
            std::printf("| %s | %s | %s | %s |\n", row.test, row.exact, row.box2d, row.carom().c_str());
            std::fflush(stdout);
        }
}
