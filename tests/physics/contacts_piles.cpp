// Stacks and piles: how far they sink, that they come to rest, that units do not matter and that a copy goes on alike.

#include <algorithm>
#include <carom/archive.hpp>
#include <initializer_list>
#include <string>
#include <vector>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

// ---- Ten boxes ------------------------------------------------------------------------------------------------------

/// Ten boxes of a metre on one another.
struct Stack {
    std::vector<double> masses;
    SoftStep solver{};
};

/// After ten seconds no two neighbours overlap by more than `deepest`, and nothing moves.
void expect_stands(const Stack& stack, double deepest) {
    World world = floor_world(0.6, stack.solver);
    for (const double mass : stack.masses)
        world.add(box({0, 0.5 + static_cast<double>(world.size())}, 1, 1, 0.6, mass));
    pass(world, 10);
    double under = -0.5;
    for (const Vec2 place : world.positions()) {
        EXPECT_LE(under + 1 - place.y, deepest) << "below the box at " << place.y;
        EXPECT_NEAR(place.x, 0, deepest);
        under = place.y;
    }
    EXPECT_LE(motion(world), 1e-8);  // a box of 1 kg at 0.14 mm/s
}

const std::vector<double> alike(10, 1), alternating{1, 1e3, 1, 1e3, 1, 1e3, 1, 1e3, 1, 1e3};
const std::vector<double> heavy_top{1, 1, 1, 1, 1, 1, 1, 1, 1, 1e3};

/// Boxes of one width on one another: whether it is a corner of the upper one that is over an edge of the lower one, or
/// the other way round, is rounding. The forces that their corners bore are known all the same; where they were not, a
/// stack of two was dropped by a hair again and again, crept by 11 mm in ten seconds and never came to rest.
TEST(Piles, AFewBoxesOfOneWidthStayWhereTheyAre) {
    for (int count = 1; count <= 6; ++count)
        for (const double g : {5.0, 9.81, 20.0}) {
            SCOPED_TRACE(testing::Message() << count << " boxes, g " << g);
            World world({.gravity = {0, -g}, .solver = SoftStep{}});
            world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
            for (int k = 0; k < count; ++k)
                world.add(Body{
                    .position = {0, 0.5 + k}, .shapes = {{.geometry = Box{1, 1}}}, .restitution = 0, .friction = 0.5});
            for (int k = 0; k < 600; ++k) world.step(1.0 / 60);
            // They settle into their overlap, some 0.2 to 2 mm, and lean by a part of that meanwhile.
            for (const Vec2 x : world.positions()) EXPECT_LE(std::abs(x.x), 1e-4);
            for (const BodyId id : world.ids()) EXPECT_TRUE(world.asleep(id));
        }
}

// A millimetre is what the issue asks for; the fastest of the peers has 6.3.
TEST(TenBoxes, StandWithinAMillimetre) { expect_stands({alike}, 1e-3); }

// Newton's method solves these islands to rounding, and a contact that bears its load does not give way at all.
TEST(TenBoxes, StandToRoundingIfSolvedPrecisely) { expect_stands({alike, {.precise = Precise::all}}, 1e-12); }
TEST(TenBoxes, StandWithATonOnTop) { expect_stands({heavy_top}, 1e-12); }
TEST(TenBoxes, StandWithATonOnEveryKilogram) { expect_stands({alternating}, 1e-12); }

// ---- Mass ratios of a hundred million -------------------------------------------------------------------------------

/// Boxes that fall on one another by so much, every other one aside by so much: after ten seconds they stand, and at no
/// time are two of them in one another by more than a millimetre.
void expect_lands(const std::vector<double>& masses, double fall, double aside) {
    SCOPED_TRACE(testing::Message() << masses.size() << " boxes, the lowest of " << masses[0] << " kg, fall by " << fall
                                    << " m, aside by " << aside);
    World world = floor_world(0.6);
    const auto x = [&](std::size_t i) { return i % 2 == 0 ? 0 : aside; };
    for (std::size_t i = 0; i < masses.size(); ++i)
        world.add(box({x(i), 0.5 + fall + static_cast<double>(i) * (1 + fall)}, 1, 1, 0.6, masses[i]));
    double deepest = 0;
    for (int step = 0; step < 600; ++step) {
        world.step(frame);
        double under = -0.5;
        for (const Vec2 place : world.positions()) {
            deepest = std::max(deepest, under + 1 - place.y);
            under = place.y;
        }
    }
    EXPECT_LE(deepest, 1e-3);
    for (std::size_t i = 0; i < masses.size(); ++i) {
        EXPECT_NEAR(world.positions()[i].y, 0.5 + static_cast<double>(i), 1e-3);
        EXPECT_NEAR(world.positions()[i].x, x(i), 0.01);
    }
    // At rest as sleep has it: at less than 1e-6 of what gravity gives in a step.
    double mass = 0;
    for (const double m : masses) mass += m;
    EXPECT_LE(motion(world), 0.5 * mass * std::pow(1e-6 * g * frame, 2));
}

TEST(FourBoxes, StandWithAHundredMillionTimesTheirMassOnThem) {
    for (const double ratio : {1e6, 1e8}) {
        for (const auto& masses :
             {std::vector{1.0, ratio}, std::vector{1.0, ratio, 1.0, ratio}, std::vector{ratio, 1.0, ratio, 1.0}}) {
            for (const double fall : {0.0, 0.01, 0.5}) expect_lands(masses, fall, 0);
            for (const double fall : {0.0, 0.01}) expect_lands(masses, fall, 0.2);
        }
        expect_lands({1, 1, 1, ratio}, 0, 0);  // let fall on a column so slender it knocks that over
    }
}

// ---- A hundred rows -------------------------------------------------------------------------------------------------

// 5050 boxes of a metre. A tenth of a metre is what the issue asks for, where the fastest of the peers sinks by 0.73 m;
// after seven seconds it has come to rest: what creeps by a micrometre in three does so by a centimetre in eight hours.
TEST(PyramidOfAHundredRows, SinksByATenthOfABoxAtMostAndDoesNotCreep) {
    constexpr int rows = 100;
    World world = floor_world(0.6);
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i) world.add(box({i - 0.5 * (rows - 1 - row), 0.5 + row}, 1, 1, 0.6));
    pass(world, 7);
    const std::vector<Vec2> before(world.positions().begin(), world.positions().end());
    EXPECT_LE(rows - 0.5 - before.back().y, 0.1);
    pass(world, 3);
    double farthest = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        farthest = std::max(farthest, length(world.positions()[i] - before[i]));
    EXPECT_LT(farthest, 1e-6);
}

// ---- Units ----------------------------------------------------------------------------------------------------------

struct Units {
    double mass = 1, length = 1;
};

/// Two boxes, a plank and a ball.
void add_few(World& world, Units unit) {
    const double l = unit.length;
    for (const double x : {-0.55, 0.55}) world.add(box({x * l, 0.5 * l}, l, l, 0.5, 3 * unit.mass));
    Body plank = box({0.1 * l, 1.3 * l}, 1.6 * l, 0.4 * l, 0.5, unit.mass);
    plank.angle = 0.05;  // not on both at once: which of two comes first would be up to rounding
    world.add(plank);
    Body ball = disc({-0.2 * l, 2.2 * l}, 0.3 * l, 0.5);
    ball.mass = unit.mass;
    world.add(ball);
}
/// Boxes and discs by turns, six rows of six, which need an interior point as they fall together.
void add_many(World& world, Units unit) {
    const double l = unit.length;
    NumpyRandom random(3);
    for (int row = 0; row < 6; ++row)
        for (int i = 0; i < 6; ++i) {
            const double x = 1.1 * i + 0.3 * (row % 2) + random.uniform(-0.1, 0.1);
            const Vec2 at{x * l, (0.6 + 1.1 * row + random.uniform(-0.04, 0.04)) * l};
            Body body = (row + i) % 2 != 0 ? box(at, l, l, 0.6) : disc(at, 0.5 * l, 0.6);
            body.angle = random.uniform(-0.05, 0.05), body.mass = unit.mass;
            world.add(body);
        }
}

/// Places and angles, in units of the pile's own length, after a hundred steps in which it falls and settles.
std::vector<double> settled(void (*add)(World&, Units), Units unit, SoftStep solver) {
    const double l = unit.length;
    World world = floor_world(0.5, solver, {0, -g * l});
    add(world, unit);
    for (int step = 0; step < 100; ++step) world.step(frame);
    std::vector<double> all;
    for (const BodyId id : world.ids())
        all.insert(all.end(), {world.position(id).x / l, world.position(id).y / l, world.angle(id)});
    return all;
}

// Of masses in grams or kilotonnes, lengths in kilometres or millimetres nothing is left but rounding, 1e-16, which a
// pile that does not bounce about in chaos magnifies little; and none at all if the unit is a power of two.
void expect_any_units(void (*add)(World&, Units), std::initializer_list<Units> units, SoftStep solver) {
    const auto usual = settled(add, {}, solver);
    for (const Units unit : units) {
        const auto other = settled(add, unit, solver);
        for (std::size_t i = 0; i < usual.size(); ++i)
            EXPECT_NEAR(other[i], usual[i], 1e-9) << unit.mass << " kg, " << unit.length << " m, number " << i;
    }
    EXPECT_EQ(settled(add, {8, 1024}, solver), usual);
}
constexpr auto units = {Units{1e6, 1}, Units{1e-6, 1}, Units{1, 1e3}, Units{1, 1e-3}, Units{1e6, 1e-3}};
// A tower of squares put down a millimetre above one another, each a centimetre off at most: its blows took three
// precise solves that found no rest, and sweeps had it for a hundred seconds after. Towers of 22 swayed for ever, of 30
// fell.
TEST(Tower, OfManySquaresStands) {
    constexpr double side = 0.5;
    for (const int high : {15, 22, 30, 40, 50}) {
        World world = floor_world(0.5);
        for (int i = 0; i < high; ++i) {
            const double aside = 0.01 * std::sin(12.9898 * (i + 1));
            world.add(box({aside, 0.5 * side + 1e-3 * (i + 1) + i * side}, side, side, 0.5, side * side));
        }
        pass(world, 2);
        const BodyId top = world.ids().back();
        EXPECT_TRUE(world.asleep(top)) << high;
        EXPECT_NEAR(world.position(top).y, (high - 0.5) * side, 1e-9) << high;
    }
}

TEST(Units, DoNotMatterToAPile) { expect_any_units(add_few, units, {}); }
TEST(Units, DoNotMatterToAPileThatIsSolvedPrecisely) { expect_any_units(add_few, units, {.precise = Precise::all}); }
TEST(Units, DoNotMatterToOneThatNeedsAnInteriorPoint) { expect_any_units(add_many, {{1e6, 1}, {1, 1e-3}}, {}); }

// ---- Snapshots ------------------------------------------------------------------------------------------------------

/// Boxes, discs and capsules that fall on one another.
World heap() {
    World world = floor_world(0.4);
    for (int i = 0; i < 24; ++i) {
        const Vec2 at{(i % 4) - 1.5 + 0.07 * (i % 3), 0.6 + i / 4};
        Body body = i % 3 == 0 ? box(at, 0.8, 0.5, 0.4) : disc(at, 0.3, 0.4, 0.3);
        if (i % 3 == 1) body.radius = 0, body.shapes = {{.geometry = Capsule{{-0.2, 0}, {0.2, 0}, 0.15}}};
        world.add(body);
    }
    return world;
}

TEST(Heap, ACopyGoesOnWithTheSameBits) {
    World world = heap();
    pass(world, 1);
    World copy = world;
    pass(world, 1);
    EXPECT_NE(state_hash(copy), state_hash(world));
    pass(copy, 1);
    EXPECT_EQ(state_hash(copy), state_hash(world));
}

TEST(Heap, WhatWasSavedGoesOnWithTheSameBits) {
    World world = heap();
    pass(world, 1);
    World other = heap();
    restore_from(world, other);
    pass(world, 1);
    pass(other, 1);
    EXPECT_EQ(state_hash(other), state_hash(world));
}

}  // namespace
}  // namespace carom::test
