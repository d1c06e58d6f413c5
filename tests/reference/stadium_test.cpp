// Round walls under the solver 'events': circles and Bunimovich's stadium.
#include <gtest/gtest.h>

#include <carom/gas.hpp>
#include <map>

#include "error_of.hpp"
#include "reference/exact_gas.hpp"

using namespace carom;
using carom::test::error_of;

namespace {

World in_room(const Stadium& room, Vec2 gravity = {}) {
    World world({.gravity = gravity, .solver = Events{}});
    world.add(room);
    return world;
}

Vec2 turned(Vec2 x, double angle) {
    return {std::cos(angle) * x.x - std::sin(angle) * x.y, std::sin(angle) * x.x + std::cos(angle) * x.y};
}

/// How far a body is outside of where its centre can be; negative inside.
double outside(const World& world, BodyId id, const Stadium& room) {
    const Vec2 way = room.b - room.a, x = world.position(id) - room.a;
    const double squared = squared_length(way);
    const double along = squared == 0 ? 0 : std::clamp(dot(x, way) / squared, 0.0, 1.0);
    return length(x - along * way) - (room.radius - world.body(id).radius);
}

}  // namespace

// In a circle all chords are alike: each is the one before, turned by twice the angle between wall and way. A disc
// moves as a point does in a circle that is smaller by its radius. After n bounces the errors of rounding have grown
// with n².
TEST(RoundRoom, ChordsOfACircleAreAlike) {
    for (const double radius : {0.0, 0.25}) {
        World world = in_room({.a = {3, -2}, .b = {3, -2}, .radius = 1 + radius});
        const double angle = 0.7;  // between the way and the tangent
        const BodyId id =
            world.add(Body{.position = {4, -2}, .velocity = {-std::sin(angle), std::cos(angle)}, .radius = radius});
        const double chord = 2 * std::sin(angle);
        constexpr int bounces = 1000;
        run(world, (bounces + 0.5) * chord, chord / 3);
        const double at = 2 * angle * bounces;
        const Vec2 middle = 0.5 * (turned({1, 0}, at) + turned({1, 0}, at + 2 * angle));
        EXPECT_NEAR(length(world.position(id) - Vec2{3, -2} - middle), 0, 1e-10);
        EXPECT_EQ(world.collisions(), bounces);
    }
}

// The mean chord of a room is π times its area over its perimeter (Santaló; N. Chernov, J. Stat. Phys. 88, 1 (1997)),
// and the stadium is ergodic (Bunimovich 1979): an average over time is one over the room. 40 runs of this length were
// off by 0.0024 of it (rms; they stay for long where they bounce straight across): the tolerance is four times that.
TEST(RoundRoom, FreePathInAStadiumIsThatOfItsAreaAndPerimeter) {
    World world = in_room({.a = {-1, 0}, .b = {1, 0}, .radius = 1});
    Random random(1);
    constexpr int points = 200;
    for (int i = 0; i < points; ++i) {
        const double angle = random.uniform(0, 2 * M_PI), x = random.uniform(-1, 1);
        world.add(Body{.position = {x, random.uniform(-1, 1)}, .velocity = {std::cos(angle), std::sin(angle)}});
    }
    const double time = 1000 * much(), exact = M_PI * (M_PI + 4) / (2 * M_PI + 4);
    run(world, time, time / 4);
    const double path = points * time / static_cast<double>(world.collisions());
    std::printf("mean free path %.5f, exact %.5f\n", path, exact);
    EXPECT_NEAR(path, exact, 0.0096 / many() * exact);
}

// Wherever it stands and however it is turned the room is the same, but for rounding, which chaos makes e^0.42 t as
// large: 1e-15 becomes some 6e-13.
TEST(RoundRoom, AStadiumCanBeTurned) {
    const auto ends_in = [](double angle, Vec2 place) {
        World world = in_room({.a = place + turned({-1, 0}, angle), .b = place + turned({1, 0}, angle), .radius = 1});
        const BodyId id = world.add(
            Body{.position = place + turned({0.2, 0.1}, angle), .velocity = turned({0.6, 0.8}, angle), .radius = 0.05});
        run(world, 17.3, 0.5);
        return turned(world.position(id) - place, -angle);
    };
    const Vec2 upright = ends_in(0, {});
    for (const double angle : {0.3, 1.9, M_PI}) EXPECT_NEAR(length(ends_in(angle, {5, -7}) - upright), 0, 1e-11);
}

// Under gravity a path may leave the half of the room that an end closes, and come back. Energy by the closed form of
// free flight and mirrors, to rounding of some thousand bounces; 1e-12 of a radius is the rounding of places.
TEST(RoundRoom, DiscsFallInStadiumsAndStayInside) {
    Random random(5);
    for (int k = 0; k < 60; ++k) {
        const double angle = random.uniform(0, 2 * M_PI), half = k % 4 == 0 ? 0 : random.uniform(0.01, 2);
        const Stadium room{.a = turned({-half, 0}, angle), .b = turned({half, 0}, angle), .radius = 1};
        World world = in_room(room, turned({0, -random.uniform(0.1, 20)}, random.uniform(0, 2 * M_PI)));
        const double vx = random.normal();
        const BodyId id = world.add(Body{.velocity = {vx, random.normal()}, .radius = random.uniform(0, 0.5)});
        const double before = energy(world).total(), scale = std::abs(before) + length(world.settings().gravity);
        for (int step = 0; step < 300; ++step) {
            world.step(0.1);
            ASSERT_LT(outside(world, id, room), 1e-12) << "room " << k << ", step " << step;
        }
        EXPECT_GT(world.collisions(), 5u);
        EXPECT_NEAR(energy(world).total(), before, 1e-12 * scale) << "room " << k;
    }
}

// The virial theorem for a room of any form: the pressure that the collisions tell is the one on the walls.
TEST(RoundRoom, PressureByTheVirialIsThatOnTheWalls) {
    World world = in_room({.a = {-6, 0}, .b = {6, 0}, .radius = 6});
    Random random(2);
    for (int i = 0; i < 15; ++i)
        for (int j = 0; j < 6; ++j) {
            const double vx = random.normal();
            world.add(Body{.position = {i - 7.0, j - 2.5}, .velocity = {vx, random.normal()}, .radius = 0.45});
        }
    run(world, 20, 1);
    GasMeter meter(world);
    for (int step = 0; step < 600; ++step) {
        world.step(0.5);
        meter.observe(world);
    }
    std::map<std::string, GasNumber> of;
    for (const GasNumber& number : meter.numbers()) of[number.name] = number;
    const GasNumber &inside = of.at("pressure by the virial"), &walls = of.at("pressure on the walls");
    std::printf("virial %.4f ± %.4f, walls %.4f ± %.4f\n", inside.value, inside.error, walls.value, walls.error);
    EXPECT_LT(walls.error, 0.02 * walls.value);
    EXPECT_NEAR(inside.value, walls.value, 4 * std::hypot(inside.error, walls.error));
}

// Far from walls the neighbours of a disc are those that it has in a periodic box of the same density: from contact,
// through the shell of the second neighbours, to where they know nothing of it.
TEST(RoundRoom, NeighboursFarFromWallsAreThoseInABox) {
    const auto curve_of = [](World& world, double step, std::vector<GasMeter::Field>* fields) {
        run(world, 30, 5);
        GasMeter meter(world);
        for (int k = 0; k < 1200; ++k) {
            world.step(step);
            meter.observe(world);
        }
        if (fields) *fields = meter.fields();
        for (const GasCurve& curve : meter.curves())
            if (curve.name == "pair correlation") return curve;
        return GasCurve{};
    };
    constexpr double radius = 24;
    World round = in_room({.a = {}, .b = {}, .radius = radius});
    Random random(9);
    for (int i = -23; i < 24; ++i)
        for (int j = -23; j < 24; ++j) {
            const Vec2 x{1.4 * i, 1.4 * j};
            if (length(x) > radius - 0.6) continue;
            const double vx = random.normal();
            round.add(Body{.position = x, .velocity = {vx, random.normal()}, .radius = 0.5});
        }
    std::vector<GasMeter::Field> fields;
    const GasCurve in_room_curve = curve_of(round, 0.1, &fields);
    double density = 0, cells = 0;
    for (const GasMeter::Field& f : fields)
        if (length(f.centre) < radius - 8) density += f.density, cells += 1;
    World box = lattice_gas(32, 36, M_PI / 4 * density / cells);
    const GasCurve in_box = curve_of(box, 0.1, nullptr);
    ASSERT_EQ(in_room_curve.x.size(), in_box.x.size());
    ASSERT_GT(in_box.x.size(), 50u);
    for (std::size_t k = 0; k < in_box.x.size(); ++k) {
        ASSERT_NEAR(in_room_curve.x[k], in_box.x[k], 1e-12);
        // Of N discs g is off by some 1/N, and the density of the room is known to half a percent.
        const double error = std::hypot(in_room_curve.error[k], in_box.error[k]) + 0.005 * in_box.y[k];
        EXPECT_NEAR(in_room_curve.y[k], in_box.y[k], 4 * error) << in_box.x[k];
    }
}

// Thermal walls give their temperature, all around.
TEST(RoundRoom, AThermalWallWarmsTheGas) {
    World world = in_room({.a = {-2, 0}, .b = {2, 0}, .radius = 4, .side = {.temperature = 3}});
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 4; ++j)
            world.add(Body{.position = {-3.15 + 0.7 * i, -1.05 + 0.7 * j}, .velocity = {0.1, 0.03 * i}, .radius = 0.2});
    run(world, 40, 1);
    double sum = 0;
    constexpr int samples = 400;
    for (int k = 0; k < samples; ++k) {
        world.step(0.5);
        sum += energy(world).kinetic / static_cast<double>(world.size()) / samples;
    }
    // A sample of 40 discs scatters by 1/√40; every second or third is a new one.
    EXPECT_NEAR(sum, 3, 4 * 3 / std::sqrt(40.0 * samples / 3));
}

TEST(RoundRoom, SaysWhatItCannotDo) {
    const auto refusal = [](Solver solver, const auto& spoil) {
        World world({.solver = solver});
        world.add(Stadium{.radius = 2});
        world.add(Body{.velocity = {1, 0}, .radius = 0.5, .name = "a"});
        return error_of([&] { spoil(world), world.step(0.1); });
    };
    const auto nothing = [](World&) {};
    EXPECT_EQ(refusal(Events{}, nothing), "no error");
    for (const Solver& solver : {Solver{SoftStep{}}, Solver{Impulse{}}})
        EXPECT_NE(refusal(solver, nothing).find("a stadium is round"), std::string::npos);
    const auto expect = [&](const char* words, const auto& spoil) {
        EXPECT_NE(refusal(Events{}, spoil).find(words), std::string::npos) << refusal(Events{}, spoil);
    };
    expect("'b' is outside the room by 0.5 m", [](World& w) {
        w.add(Body{.position = {2, 0}, .velocity = {1, 0}, .radius = 1, .name = "b"});
    });
    expect("a world with walls has no periodic box", [](World& w) { w.add(Periodic{}); });
    expect("radius", [](World& w) { w.add(Stadium{.radius = 0}); });
    expect("knows no stadium", [](World& w) {
        w.add(Body{.position = {-1, 0}, .shapes = {{.geometry = Box{.width = 0.2, .height = 0.2}}}, .name = "box"});
    });
}
