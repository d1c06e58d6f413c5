// What a contact's coefficients are, from those of the two: every rule, under every solver that has contacts, held
// against what a bounce and a slide tell of them.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <string>

using namespace carom;

namespace {

struct Rule {
    Mixing mixing;
    double of_both;  ///< of one half and of 0.18
};
/// One half and 0.18 have a product, 0.09, and so a geometric mean that can be written down.
constexpr double one = 0.5, other = 0.18;
const std::vector<Rule> rules{{Mixing::minimum, 0.18},
                              {Mixing::maximum, 0.5},
                              {Mixing::mean, 0.34},
                              {Mixing::product, 0.09},
                              {Mixing::geometric_mean, 0.3}};
const std::vector<Solver> solvers{Impulse{}, Impulse{.time_of_impact = false}, SoftStep{}, Events{}};

std::string called(const Rule& rule, const Solver& solver) {
    std::string name;
    for (const auto& choice : choices(static_cast<const Mixing*>(nullptr)))
        if (choice.value == rule.mixing) name = choice.name;
    return name + " under " + std::visit([](const auto& s) { return std::string(s.name); }, solver);
}
template <class Test>
void with_all(const std::vector<Solver>& all, const Test& test) {
    for (const Solver& solver : all)
        for (const Rule& rule : rules) {
            SCOPED_TRACE(called(rule, solver));
            test(solver, rule);
        }
}
void go(World& world, double duration, int steps) { run(world, duration, duration / steps); }

}  // namespace

// Solvers find the instant of a bounce: what is left is rounding. Without times of impact there is no closed form.
TEST(Mixing, SaysHowHighABallBounces) {
    constexpr double g = 10, drop = 1;
    with_all({Impulse{}, SoftStep{}, Events{}}, [](const Solver& solver, const Rule& rule) {
        World world({.gravity = {0, -g}, .solver = solver, .restitution_mixing = rule.mixing});
        world.add(HalfPlane{.side = {.restitution = other}});
        world.add(Body{.position = {0, 0.1 + drop}, .radius = 0.1, .restitution = one});
        const double e = rule.of_both, fall = std::sqrt(2 * drop / g);
        go(world, fall * (1 + e), 60);
        EXPECT_NEAR(world.positions()[0].y, 0.1 + e * e * drop, 1e-12);
        EXPECT_NEAR(world.velocities()[0].y, 0, 1e-12);
    });
}

TEST(Mixing, SaysHowTwoDiscsPart) {
    with_all(solvers, [](const Solver& solver, const Rule& rule) {
        World world({.solver = solver, .restitution_mixing = rule.mixing});
        world.add(Body{.position = {-0.5, 0}, .velocity = {2, 0}, .radius = 0.1, .restitution = one});
        world.add(Body{.position = {0.5, 0}, .velocity = {-2, 0}, .radius = 0.1, .restitution = other});
        go(world, 0.6, 60);
        EXPECT_NEAR(world.velocities()[1].x, 2 * rule.of_both, 1e-12);
    });
}

// Coulomb: a = g (sin α − µ cos α), here with sin α = 3/5.
TEST(Mixing, SaysHowABlockSlidesDownASlope) {
    constexpr double g = 10;
    with_all({SoftStep{}}, [](const Solver& solver, const Rule& rule) {
        World world({.gravity = {0, -g}, .solver = solver, .friction_mixing = rule.mixing});
        const Vec2 up{-0.6, 0.8}, down{-0.8, -0.6};
        world.add(HalfPlane{.normal = up, .side = {.friction = one}});
        world.add(Body{.position = 0.1 * up,
                       .angle = std::atan2(0.6, 0.8),
                       .shapes = {{.geometry = Box{.width = 0.6, .height = 0.2}}},
                       .restitution = 0,
                       .friction = other});
        go(world, 1, 60);
        // What a contact that is solved precisely gives way by in the first substeps: its compliance is 1e-6 of its
        // mass.
        EXPECT_NEAR(dot(world.velocities()[0], down), g * (0.6 - rule.of_both * 0.8), 1e-8);
    });
}

/// What a disc loses of its speed along a wall that it strikes at speed 2: µ (1 + e) times that as long as it slips.
double lost_along(Settings settings, double of_wall, double of_disc) {
    World world(settings);
    world.add(HalfPlane{.side = {.friction = of_wall}});
    world.add(Body{.position = {0, 0.4}, .velocity = {9, -2}, .radius = 0.1, .friction = of_disc});
    go(world, 0.3, 30);
    EXPECT_NEAR(world.angular_velocities()[0], -2 * (9 - world.velocities()[0].x) / 0.1, 1e-12);  // I = ½ m r²
    return 9 - world.velocities()[0].x;
}
TEST(Mixing, SaysHowAWallRubs) {
    with_all(solvers, [](const Solver& solver, const Rule& rule) {
        EXPECT_NEAR(lost_along({.solver = solver, .friction_mixing = rule.mixing}, one, other), 4 * rule.of_both,
                    1e-12);
    });
}
TEST(Mixing, LetsARoughWallTurnASmoothDisc) {
    for (const Solver& solver : solvers) {
        EXPECT_NEAR(lost_along({.solver = solver, .friction_mixing = Mixing::mean}, one, 0), one * 2, 1e-12);
        EXPECT_NEAR(lost_along({.solver = solver, .friction_mixing = Mixing::maximum}, one, 0), one * 4, 1e-12);
        EXPECT_EQ(lost_along({.solver = solver, .friction_mixing = Mixing::product}, one, 0), 0);
    }
}

// The gas meets a body that is moved in steps, much heavier than a disc of it.
TEST(Mixing, HoldsBetweenAGasAndOthers) {
    with_all({Events{}}, [](const Solver& solver, const Rule& rule) {
        World world({.solver = solver, .restitution_mixing = rule.mixing});
        world.add(Body{.position = {0.6, 0},
                       .mass = 1e9,
                       .shapes = {{.geometry = Box{.width = 0.4, .height = 1}}},
                       .restitution = other});
        const BodyId disc = world.add(Body{.velocity = {3, 0}, .radius = 0.1, .restitution = one});
        go(world, 0.2, 20);
        EXPECT_NEAR(world.velocity(disc).x, -3 * rule.of_both, 1e-7);  // 1e-9 of it goes to the box
    });
}

TEST(Mixing, ChangesWithTheSettings) {
    for (const Solver& solver : solvers) {
        SCOPED_TRACE(std::visit([](const auto& chosen) { return chosen.name; }, solver));
        World world({.solver = solver});
        const Side side{.restitution = one, .friction = one};
        world.add(Rectangle{.low = {-1, -1}, .high = {1, 1}, .left = side, .right = side});
        const BodyId disc = world.add(Body{.velocity = {9, 0}, .radius = 0.1});
        go(world, 0.2, 12);
        EXPECT_NEAR(world.velocity(disc).x, -4.5, 1e-12);
        const World snapshot = world;
        Settings settings = world.settings();
        settings.restitution_mixing = settings.friction_mixing = Mixing::maximum;
        world.configure(settings);
        world.set_velocity(disc, {-4.5, 1.5}, 0);  // a smooth disc: that the wall turns it is new, too
        go(world, 0.4, 24);
        EXPECT_NEAR(world.velocity(disc).x, 4.5, 1e-12);
        EXPECT_NEAR(world.velocity(disc).y, 1, 1e-12);  // it sticks: a third of the slip ends its spin
        world = snapshot;                               // with its settings
        go(world, 0.4, 24);
        EXPECT_NEAR(world.velocity(disc).x, 2.25, 1e-12);
    }
}

TEST(Mixing, IsOfTheWorldAndNotOfItsState) {
    const auto world_with = [](Mixing mixing) {
        World world({.restitution_mixing = mixing});
        world.add(HalfPlane{.normal = {-1, 0}, .side = {.restitution = one}});
        world.add(Body{.position = {-1, 0}, .velocity = {9, 0}});
        return world;
    };
    std::string bytes;
    Saver saver([&](std::string_view part) { bytes += part; });
    world_with(Mixing::minimum).save(saver);
    World world = world_with(Mixing::maximum);
    Loader loader(bytes);
    world.restore(loader);
    go(world, 0.2, 12);
    EXPECT_NEAR(world.velocities()[0].x, -9, 1e-12);
}
