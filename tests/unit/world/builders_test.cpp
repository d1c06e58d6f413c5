#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

using namespace carom;

namespace {

using std::numbers::pi;

template <class Builder>
std::string error_from(const Builder& builder, World world = World{}) {
    const std::size_t before = world.size();
    try {
        build(world, builder);
    } catch (const Error& error) {
        EXPECT_EQ(world.size(), before) << "a builder that fails must leave nothing behind";
        return error.what();
    }
    return "no error";
}

bool is_one_line_with(const std::string& text, std::initializer_list<const char*> parts) {
    for (const char* part : parts)
        if (text.find(part) == std::string::npos) return false;
    return text.find('\n') == std::string::npos;
}

double least_gap(const World& world) {
    double least = 1e300;
    const auto x = world.positions();
    const auto r = world.radii();
    Vec2 box{1e300, 1e300};
    if (world.periodic()) box = world.periodic()->high - world.periodic()->low;
    for (std::size_t i = 0; i < world.size(); ++i)
        for (std::size_t j = i + 1; j < world.size(); ++j) {
            Vec2 d = x[j] - x[i];
            if (world.periodic()) d = {std::remainder(d.x, box.x), std::remainder(d.y, box.y)};
            least = std::min(least, length(d) - r[i] - r[j]);
        }
    return least;
}

}  // namespace

TEST(Rope, SharesMassLengthAndStiffnessAmongItsSegments) {
    World world;
    const Built rope = build(world, Rope{.anchor_b = {4, 0},
                                         .fixed_b = false,
                                         .segments = 8,
                                         .mass = 2,
                                         .rest_length = 5,
                                         .stiffness = 100,
                                         .damping = 3,
                                         .name = "rope"});
    ASSERT_EQ(rope.bodies.size(), 9u);
    ASSERT_EQ(world.springs().size(), 8u);
    double mass = 0;
    for (std::size_t i = 0; i < 9; ++i) {
        const Body bead = world.body(rope.bodies[i]);
        mass += bead.mass;
        EXPECT_EQ(bead.name, "rope[" + std::to_string(i) + "]");
        EXPECT_EQ(bead.kind, i == 0 ? Kind::fixed : Kind::dynamic);
        EXPECT_EQ(bead.position, (Vec2{0.5 * double(i), 0}));
    }
    EXPECT_EQ(mass, 2);  // eighths of 2 are exact
    for (const Spring& s : world.springs()) {
        EXPECT_EQ(s.rest_length, 0.625);
        EXPECT_EQ(s.stiffness, 160);
        EXPECT_EQ(s.damping, 4.8);
    }
}

TEST(Rope, HangsAsLongAsTheTheoryOfElasticRodsSays) {
    // A hanging rope with a load stretches by (M g + m g / 2) L / EA; lumped masses give that for any segments.
    const double g = 9.81, EA = 500, L = 2, m = 0.3, M = 0.7;
    for (const int segments : {1, 2, 7}) {
        World world({.gravity = {0, -g}});
        const BodyId load = world.add(Body{.position = {0, -L}, .mass = M});
        build(world, Rope{.b = load, .segments = segments, .mass = m, .stiffness = EA, .damping = 0.02 * EA});
        world.add(Drag{.linear = 2});  // so that it settles
        run(world, 30, 0.01);
        // The half segment that the load carries is not part of the load, so its weight m/(2n) is missing.
        const double missing = m / (2 * segments);
        const double expected = (M - missing + m / 2) * g * L / EA;
        EXPECT_NEAR(-world.position(load).y - L, expected, 1e-9) << segments;  // what 30 s of damping leave over
    }
}

TEST(Rope, HangsBetweenAnchorsOfBodies) {
    World world;
    const BodyId a = world.add(Body{.position = {0, 0}, .angle = pi / 2, .radius = 1});
    const BodyId b = world.add(Body{.position = {6, 1}, .radius = 1});
    const Built rope = build(world, Rope{.a = a, .b = b, .anchor_a = {0, -1}, .anchor_b = {-1, 0}, .segments = 4});
    ASSERT_EQ(rope.bodies.size(), 3u);
    // a's point (0, -1) turned by 90° is (1, 0); the rope runs from (1, 0) to (5, 1). sincos(π/2) is off by 1 ulp.
    EXPECT_NEAR(world.position(rope.bodies[1]).x, 3, 1e-15);
    EXPECT_NEAR(world.position(rope.bodies[1]).y, 0.5, 1e-15);
    EXPECT_EQ(world.springs().front().a, a);
    EXPECT_EQ(world.springs().front().anchor_a, (Vec2{0, -1}));
    EXPECT_EQ(world.springs().back().b, b);
    EXPECT_NEAR(energy(world).spring, 0, 1e-25);
}

TEST(Rope, RefusesWhatIsNoRope) {
    EXPECT_TRUE(is_one_line_with(error_from(Rope{}), {"Rope.anchor_b"}));
    EXPECT_TRUE(
        is_one_line_with(error_from(Rope{.anchor_b = {1, 0}, .segments = 0}), {"Rope.segments", "from 1", "0"}));
    EXPECT_TRUE(is_one_line_with(error_from(Rope{.anchor_b = {1, 0}, .mass = -2}), {"Rope.mass", "> 0", "kg", "-2"}));
    EXPECT_TRUE(is_one_line_with(error_from(Rope{.anchor_b = {1, 0}, .segments = 5, .radius = 0.2}),
                                 {"Rope.radius", "0.1 m", "0.2 m"}));
    EXPECT_TRUE(is_one_line_with(error_from(Rope{.anchor_b = {NAN, 0}}), {"Rope.anchor_b.x", "finite", "nan"}));
    EXPECT_TRUE(is_one_line_with(error_from(Rope{.a = BodyId{7, 1}, .anchor_b = {1, 0}}), {"BodyId"}));
}

TEST(Rope, LeavesNothingBehindWhenItFailsHalfway) {
    World world;
    world.add(Body{.name = "rope[3]"});
    EXPECT_TRUE(is_one_line_with(error_from(Rope{.anchor_b = {1, 0}, .name = "rope"}, world), {"unique", "rope[3]"}));
}

TEST(Lattice, HasTheSpringsOfItsKind) {
    const auto springs = [](Lattice lattice) {
        World world;
        build(world, lattice);
        EXPECT_NEAR(energy(world).spring, 0, 1e-25);  // made without tension
        return world.springs().size();
    };
    const std::size_t nx = 5, ny = 4;
    const std::size_t structural = (nx - 1) * ny + nx * (ny - 1), shear = 2 * (nx - 1) * (ny - 1),
                      bend = (nx - 2) * ny + nx * (ny - 2);
    EXPECT_EQ(springs({.nx = 5, .ny = 4}), structural);
    EXPECT_EQ(springs({.nx = 5, .ny = 4, .shear_stiffness = 1}), structural + shear);
    EXPECT_EQ(springs({.nx = 5, .ny = 4, .shear_stiffness = 1, .bend_stiffness = 1}), structural + shear + bend);
}

TEST(Lattice, IsHeldWhereItSays) {
    const auto held = [](Held where) {
        World world;
        std::size_t count = 0;
        for (const BodyId id : build(world, Lattice{.nx = 5, .ny = 4, .held = where, .name = "n"}).bodies)
            count += world.body(id).kind == Kind::fixed;
        return count;
    };
    EXPECT_EQ(held(Held::none), 0u);
    EXPECT_EQ(held(Held::top), 5u);
    EXPECT_EQ(held(Held::left), 4u);
    EXPECT_EQ(held(Held::left_right), 8u);
    EXPECT_EQ(held(Held::top_corners), 2u);
    EXPECT_EQ(held(Held::corners), 4u);
    EXPECT_EQ(held(Held::border), 14u);

    World world;
    const Built cloth =
        build(world, Lattice{.nx = 5, .ny = 4, .corner = {1, 2}, .spacing = 0.5, .held = Held::top, .name = "n"});
    EXPECT_EQ(world.find("n[2][3]"), cloth.bodies[3 * 5 + 2]);
    EXPECT_EQ(world.position(cloth.bodies[3 * 5 + 2]), (Vec2{2, 3.5}));
    EXPECT_EQ(world.body(cloth.bodies[3 * 5 + 2]).kind, Kind::fixed);
}

TEST(Lattice, RefusesTooMany) {
    EXPECT_TRUE(is_one_line_with(error_from(Lattice{.nx = 1'000'000, .ny = 1'000'000}),
                                 {"Lattice.nx", "ny", "10000000", "1e+12"}));
    EXPECT_TRUE(is_one_line_with(error_from(Lattice{.nx = -3}), {"Lattice.nx", "-3"}));
    EXPECT_TRUE(
        is_one_line_with(error_from(Lattice{.spacing = 0.1, .radius = 0.06}), {"Lattice.radius", "0.1 m", "0.06 m"}));
}

TEST(GridOf, CopiesABody) {
    World world;
    const Built grid = build(world, GridOf{.body = {.position = {1, 2}, .velocity = {3, 0}, .radius = 0.1, .name = "b"},
                                           .nx = 3,
                                           .ny = 2,
                                           .spacing = {0.5, -0.25}});
    ASSERT_EQ(grid.bodies.size(), 6u);
    EXPECT_EQ(world.position(world.find("b[2][1]")), (Vec2{2, 1.75}));
    EXPECT_EQ(grid.bodies[5], world.find("b[2][1]"));
    EXPECT_EQ(world.velocity(grid.bodies[5]), (Vec2{3, 0}));
    EXPECT_TRUE(is_one_line_with(error_from(GridOf{.spacing = {0, 1}}), {"GridOf.spacing", "0 m"}));
    EXPECT_TRUE(is_one_line_with(error_from(GridOf{.body = {.mass = 0}}), {"GridOf.body.mass", "> 0", "kg"}));
}

TEST(GridOf, CopiesShapes) {
    World world;
    const Shape box{.geometry = Box{.width = 0.4, .height = 0.2}, .density = 5.};
    const Built grid = build(world, GridOf{.body = {.shapes = {box}, .name = "b"}, .nx = 2, .ny = 2});
    ASSERT_EQ(grid.bodies.size(), 4u);
    for (const BodyId id : grid.bodies) {
        EXPECT_EQ(world.body(id).shapes.size(), 1u);
        EXPECT_DOUBLE_EQ(world.body(id).mass, 5 * 0.4 * 0.2);
    }
    EXPECT_TRUE(is_one_line_with(error_from(GridOf{.body = {.shapes = {{.friction = -1.}}}}),
                                 {"GridOf.body.shapes[0].friction", ">= 0"}));
}

TEST(Fill, CoversTheFractionWithoutOverlap) {
    World world;
    const Fill fill{.low = {-3, 1},
                    .high = {7, 6},
                    .fraction = 0.45,
                    .smallest_radius = 0.02,
                    .largest_radius = 0.2,
                    .body = {.friction = 0.3, .name = "grain"},
                    .density = 2};
    const Built built = build(world, fill);
    double covered = 0, least = 1, most = 0;
    for (const BodyId id : built.bodies) {
        const Body b = world.body(id);
        covered += pi * b.radius * b.radius;
        least = std::min(least, b.radius), most = std::max(most, b.radius);
        EXPECT_GE(b.position.x - b.radius, -3 - 1e-15);  // low + radius - radius, rounded
        EXPECT_LE(b.position.x + b.radius, 7 + 1e-15);
        EXPECT_GE(b.position.y - b.radius, 1 - 1e-15);
        EXPECT_LE(b.position.y + b.radius, 6 + 1e-15);
        EXPECT_DOUBLE_EQ(b.mass, 2 * pi * b.radius * b.radius);
        EXPECT_EQ(b.friction, 0.3);
    }
    EXPECT_NEAR(covered, 0.45 * 50, 0.5 * pi * 0.2 * 0.2);  // the nearest disc
    EXPECT_GE(least_gap(world), -1e-15);                    // rounding of the distance
    EXPECT_GE(least, 0.02);
    EXPECT_LE(most, 0.2);
    // Some 550 radii: the extremes of so many uniform numbers come within 5 % of the ends (chance of a miss e^-25).
    EXPECT_LT(least, 0.02 + 0.05 * 0.18);
    EXPECT_GT(most, 0.2 - 0.05 * 0.18);
}

TEST(Fill, AvoidsWhatIsThereAndReachesAcrossAPeriodicBox) {
    World world;
    world.add(Periodic{{0, 0}, {4, 4}});
    world.add(Body{.position = {2, 2}, .radius = 1});
    const Built built =
        build(world, Fill{.high = {4, 4}, .count = 60, .smallest_radius = 0.15, .largest_radius = 0.15});
    EXPECT_EQ(built.bodies.size(), 60u);
    EXPECT_GE(least_gap(world), -1e-15);
    bool across = false;
    for (const BodyId id : built.bodies) across |= world.position(id).x < 0.15 || world.position(id).x > 3.85;
    EXPECT_TRUE(across);  // of 60 discs some 4 are expected there
}

TEST(Fill, DependsOnTheSeedAlone) {
    const auto hash = [](int seed) {
        World world;
        build(world, Fill{.count = 50, .seed = seed});
        return state_hash(world);
    };
    EXPECT_EQ(hash(3), hash(3));
    EXPECT_NE(hash(3), hash(4));
}

TEST(Fill, SaysWhyItCannot) {
    const Fill equal{.fraction = 0.6, .smallest_radius = 0.02, .largest_radius = 0.02};
    EXPECT_TRUE(is_one_line_with(error_from(equal), {"Fill.fraction", "0.5", "tries"}));
    EXPECT_TRUE(is_one_line_with(error_from(Fill{}), {"Fill", "a fraction or a count", "neither"}));
    EXPECT_TRUE(is_one_line_with(error_from(Fill{.fraction = 0.1, .count = 3}), {"Fill", "both"}));
    EXPECT_TRUE(is_one_line_with(error_from(Fill{.fraction = 0.4, .smallest_radius = 1e-7, .largest_radius = 1e-7}),
                                 {"Fill.fraction", "10000000", "1.27e+13"}));
    EXPECT_TRUE(is_one_line_with(error_from(Fill{.count = 5000}), {"Fill.count", "1.57 times"}));
    EXPECT_TRUE(is_one_line_with(error_from(Fill{.count = 0}), {"Fill.count", "from 1"}));
    EXPECT_TRUE(is_one_line_with(error_from(Fill{.count = 1, .largest_radius = 0.7}),
                                 {"Fill.largest_radius", "0.5 m", "0.7 m"}));
    EXPECT_TRUE(
        is_one_line_with(error_from(Fill{.count = 1, .smallest_radius = 0.02}), {"Fill.largest_radius", "0.02 m"}));
    EXPECT_TRUE(is_one_line_with(error_from(Fill{.high = {0, 1}, .count = 1}), {"Fill.high", "above and right"}));
    EXPECT_TRUE(
        is_one_line_with(error_from(Fill{.count = 1, .body = {.restitution = 2}}), {"Fill.body.restitution", "2"}));
    EXPECT_TRUE(is_one_line_with(error_from(Fill{.fraction = 1e-9}), {"Fill.fraction", "1e-09"}));
    EXPECT_TRUE(
        is_one_line_with(error_from(Fill{.count = 1, .body = {.shapes = {{}}}}), {"Fill.body.shapes", "discs"}));
}

TEST(Gas, HasTheTemperatureExactly) {
    for (const bool periodic : {false, true}) {
        World world;
        if (periodic) world.add(Periodic{{0, 0}, {1, 1}});
        build(world, Gas{.fill = {.count = 100, .density = 5}, .temperature = 2.5});
        // N kT, and (N - 1) kT where the total momentum is conserved (truth: gas.finiteN.rate)
        EXPECT_NEAR(energy(world).kinetic, (periodic ? 99 : 100) * 2.5, 1e-11);  // 250 J, some 1e2 roundings
        EXPECT_NEAR(length(momentum(world)), 0, 1e-12);
    }
}

TEST(Gas, IsMaxwells) {
    World world;
    const double kT = 3, m = 2;
    build(world, Gas{.fill = {.high = {100, 100},
                              .count = 20000,
                              .smallest_radius = 0.1,
                              .largest_radius = 0.1,
                              .body = {.mass = m}},
                     .temperature = kT,
                     .exact = false});
    double second = 0, fourth = 0, cross = 0;
    const auto n = static_cast<double>(world.size());
    for (const Vec2 v : world.velocities()) {
        const double square = squared_length(v);
        second += square / n, fourth += square * square / n, cross += v.x * v.y / n;
    }
    // <v²> = 2 kT/m, <v⁴> = 2 <v²>², v_x and v_y independent; five standard errors of 20000 draws.
    const double mean = 2 * kT / m, error = 5 / std::sqrt(n);
    EXPECT_NEAR(second, mean, mean * error);
    EXPECT_NEAR(fourth, 2 * mean * mean, std::sqrt(20.) * mean * mean * error);
    EXPECT_NEAR(cross, 0, kT / m * error);
}

TEST(Gas, BlowsWithTheWind) {
    World world;
    build(world, Gas{.fill = {.count = 50, .body = {.velocity = {7, 0}}}, .temperature = 1});
    EXPECT_NEAR(momentum(world).x, 350, 1e-11);
    EXPECT_NEAR(energy(world).kinetic, 50 + 0.5 * 50 * 49, 1e-10);
}

TEST(Gas, RefusesWhatHasNoTemperature) {
    EXPECT_TRUE(
        is_one_line_with(error_from(Gas{.fill = {.count = 5}, .temperature = -1}), {"Gas.temperature", "J", "-1"}));
    EXPECT_TRUE(is_one_line_with(error_from(Gas{.fill = {.count = 1}}), {"Gas.exact"}));
    EXPECT_TRUE(
        is_one_line_with(error_from(Gas{.fill = {.count = 5, .body = {.kind = Kind::fixed}}}), {"Gas.fill.body.kind"}));
    EXPECT_TRUE(is_one_line_with(error_from(Gas{.fill = {.fraction = 2}}), {"Gas.fill.fraction", "2"}));
}

TEST(NotebookGas, IsTheTextbooksToTheLastBit) {
    // The fifteen discs of the textbook's gas, seed 99 (reference/textbook.json, gas.initial).
    std::ifstream file(CAROM_SOURCE_DIR "/tests/reference/textbook_gas.json");
    ASSERT_TRUE(file);
    const auto initial = nlohmann::json::parse(file);
    World world;
    const Built built = build(world, NotebookGas{});
    ASSERT_EQ(built.bodies.size(), initial.size());
    for (std::size_t i = 0; i < initial.size(); ++i) {
        const Body disc = world.body(built.bodies[i]);
        EXPECT_EQ(disc.position.x, initial[i]["pos"][0].get<double>()) << i;
        EXPECT_EQ(disc.position.y, initial[i]["pos"][1].get<double>()) << i;
        EXPECT_EQ(disc.velocity.x, initial[i]["vel"][0].get<double>()) << i;
        EXPECT_EQ(disc.velocity.y, initial[i]["vel"][1].get<double>()) << i;
        EXPECT_EQ(disc.radius, initial[i]["radius"].get<double>()) << i;
    }
}
