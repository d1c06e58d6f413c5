// The study that `carom check` prints: measured orders and error estimates on random scenes with fixed seeds, chaos
// that is recognised and regular motion that is not mistaken for it, impacts.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/convergence.hpp>
#include <carom/random.hpp>
#include <cmath>
#include <numbers>

#include "analysis/order.hpp"
#include "trials.hpp"

namespace carom {
namespace {

using std::numbers::pi;

/// Springs from a body to two fixed points, and gravity: smooth, and of no symmetry that an error could hide in.
World random_swing(std::uint64_t seed, const Integrator& method) {
    Random random(seed);
    World world({.gravity = {0, -random.uniform(1, 10)}, .integrator = method, .solver = NoContact{}});
    const BodyId left = world.add(Body{.kind = Kind::fixed, .position = {-random.uniform(1, 2), random.uniform(0, 1)}});
    const BodyId right = world.add(Body{.kind = Kind::fixed, .position = {random.uniform(1, 2), random.uniform(0, 1)}});
    const BodyId bob = world.add(Body{.position = {random.uniform(-0.3, 0.3), -random.uniform(1, 1.5)},
                                      .velocity = {random.uniform(-1, 1), random.uniform(-1, 1)},
                                      .mass = random.uniform(0.5, 2),
                                      .name = "bob"});
    for (const BodyId end : {left, right})
        world.add(Spring{.a = end, .b = bob, .stiffness = random.uniform(5, 20), .rest_length = 0.5});
    return world;
}

std::vector<Probe> place_of(const World& world, const char* name) {
    const BodyId body = world.find(name);
    return {{.name = "x", .value = [body](const World& w) { return w.position(body).x; }}};
}

struct Method {
    const char* name;
    Integrator integrator;
    double order, step;  ///< so that the leading term rules and rounding does not
};
const std::vector<Method> methods = {{"euler", Euler{}, 1, 5e-5},
                                     {"symplectic-euler", SymplecticEuler{}, 1, 5e-4},
                                     {"verlet", Verlet{}, 2, 4e-3},
                                     {"pefrl", Pefrl{}, 4, 2e-2},
                                     {"rk4", Rk4{}, 4, 1e-2},
                                     {"midpoint", RungeKutta{Tableau::midpoint}, 2, 2e-3},
                                     {"kutta3", RungeKutta{Tableau::kutta3}, 3, 4e-3},
                                     {"dormand-prince5", RungeKutta{Tableau::dormand_prince5}, 5, 2e-2},
                                     {"implicit", Implicit{}, 2, 4e-3}};

TEST(Study, MeasuresTheOrderOfEveryMethodOnRandomScenes) {
    for (const Method& method : methods)
        for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
            const World world = random_swing(seed, method.integrator);
            const Convergence c = study(world, place_of(world, "bob"), {.duration = 2, .step = method.step});
            ASSERT_TRUE(c.state.order) << method.name << " seed " << seed;
            // The next term of the error is a part h of the leading one: a tenth, here.
            EXPECT_NEAR(*c.state.order, method.order, 0.15) << method.name << " seed " << seed;
            EXPECT_EQ(c.state.by, ErrorBy::reference) << method.name << " seed " << seed;
            EXPECT_FALSE(c.growth) << method.name << " seed " << seed;
        }
}

/// x'' + 2γ x' + ω² x = 0 from x = 1 at rest.
double damped(double t, double w, double gamma) {
    const double s = std::sqrt(w * w - gamma * gamma);
    return std::exp(-gamma * t) * (std::cos(s * t) + gamma / s * std::sin(s * t));
}

TEST(Study, BracketsTheTrueErrorOfRandomOscillators) {
    const Integrator some[] = {SymplecticEuler{}, Verlet{}, Pefrl{}, Rk4{}, RungeKutta{Tableau::heun}};
    Random random(7);
    for (int n = 0; n < test::trials(120); ++n) {
        const double w = random.uniform(1, 6), gamma = random.uniform(0, 0.3), step = random.uniform(0.01, 0.06);
        World world({.integrator = some[n % 5], .solver = NoContact{}});
        const BodyId wall = world.add(Body{.kind = Kind::fixed});
        const BodyId bob = world.add(Body{.position = {1, 0}, .name = "bob"});
        world.add(Spring{.a = wall, .b = bob, .stiffness = w * w, .damping = 2 * gamma});
        const Convergence c = study(world, place_of(world, "bob"), {.duration = 10, .step = step});
        double error = 0;
        run(world, 10, step, [&](const World& now) {
            error = std::max(error, std::abs(now.position(bob).x - damped(now.time(), w, gamma)));
        });
        EXPECT_LT(c.quantities[0].error, 3 * error) << n;
        EXPECT_GT(c.quantities[0].error, error / 3) << n;
        EXPECT_EQ(c.trust == Trust::trust, std::max(c.state.relative(), c.quantities[0].relative()) <= 1e-3) << n;
    }
}

// It named a half, a quarter, … of the step, whose error under a method of high order is a small part of the one
// allowed.
TEST(Study, TheStepItNamesIsFineEnoughAndHardlyFiner) {
    for (const Method& method : methods)
        for (const std::uint64_t seed : {11, 12}) {
            const World world = random_swing(seed, method.integrator);
            const double step = 8 * method.step;
            const Convergence coarse = study(world, {}, {.duration = 2, .step = step});
            // Some errors allowed for which a half or a quarter of the step would do, or would not by a little.
            for (const double part : {0.3, 0.024}) {
                const double tolerance = part * coarse.state.error;
                const Convergence c = study(world, {}, {.duration = 2, .step = step, .tolerance = tolerance});
                ASSERT_EQ(c.trust, Trust::refine) << method.name << " seed " << seed;
                ASSERT_TRUE(c.refined) << method.name << " seed " << seed;
                const Convergence fine = study(world, {}, {.duration = 2, .step = *c.refined, .tolerance = tolerance});
                EXPECT_EQ(fine.trust, Trust::trust) << method.name << " seed " << seed << ": " << c.sentence();
                EXPECT_GT(fine.state.error, tolerance / 4) << method.name << " seed " << seed << ": " << c.sentence();
            }
        }
}

// carom check scenes/spring-pendulum.json said that the error passes the tolerance at t = 0 s, where there is none.
TEST(Study, AnErrorPassesBetweenSamplesAndNotAtTheOneBefore) {
    constexpr double step = 0.02, tolerance = 2e-4, duration = 1000;
    World world({.integrator = SymplecticEuler{}, .solver = NoContact{}});
    const BodyId wall = world.add(Body{.kind = Kind::fixed}), bob = world.add(Body{.position = {1, 0}});
    world.add(Spring{.a = wall, .b = bob, .stiffness = 1});
    const Convergence c = study(world, {}, {.duration = duration, .step = step, .tolerance = tolerance});
    ASSERT_GT(c.time[1], 50 * step);
    EXPECT_GT(c.good_until, 0);
    EXPECT_LT(c.good_until, c.time[1]);
    EXPECT_EQ(c.sentence().find("at t = 0 s"), std::string::npos) << c.sentence();
}

TEST(Study, AThrowWithoutAirIsExactUnderVerletAndHasNoOrder) {
    World world({.gravity = {0, -9.81}});
    world.add(Body{.velocity = {3, 4}, .name = "ball"});
    const Convergence c = study(world, place_of(world, "ball"), {.duration = 1, .step = 0.01});
    EXPECT_EQ(c.state.by, ErrorBy::rounding);
    EXPECT_FALSE(c.state.order);
    EXPECT_EQ(c.trust, Trust::trust);
}

TEST(Study, AMethodWithItsOwnStepIsHeldToItsTolerance) {
    const World world = random_swing(3, Adaptive{.tolerance = 1e-4});
    const Convergence c = study(world, place_of(world, "bob"), {.duration = 5, .step = 0.5});
    EXPECT_TRUE(c.own_step);
    EXPECT_DOUBLE_EQ(c.runs[1].tolerance, 1e-5);
    EXPECT_LT(c.runs[2].error.back(), c.runs[0].error.back());
}

/// Where a disc is that slides at first, and rolls from when friction has turned it as fast as it goes: m v' = −μ m g −
/// c v and r ω' = 2 μ g, then ³⁄₂ m v' = −c v.
double slides_and_rolls(double v, double mu_g, double c, double time) {
    const double a = mu_g / c;
    const auto slides = [&](double t) { return (v + a) * std::exp(-c * t) - a; };
    double low = 0, high = time;
    while (high - low > 1e-15) {
        const double t = (low + high) / 2;
        (slides(t) > 2 * mu_g * t ? low : high) = t;
    }
    const double slid = (v - slides(low)) / c - a * low;
    return slid + 1.5 * slides(low) / c * (1 - std::exp(-c * (time - low) / 1.5));
}

// Of contacts under a force no tolerance of the method refined what depends on the step: it was exact, to rounding.
TEST(Study, AMethodWithItsOwnStepDoesNotHideTheErrorOfContactsUnderAForce) {
    constexpr double v = 3, mu = 0.3, c = 0.2, time = 2;
    for (const Integrator& method : {Integrator{Adaptive{}}, Integrator{GaussRadau{}}}) {
        World world({.gravity = {0, -9.81}, .integrator = method});
        world.add(HalfPlane{.side = {.restitution = 0, .friction = mu}});
        world.add(Body{
            .position = {0, 0.2}, .velocity = {v, 0}, .radius = 0.2, .restitution = 0, .friction = mu, .name = "disc"});
        world.add(Drag{.linear = c});
        const Convergence found = study(world, place_of(world, "disc"), {.duration = time, .step = 0.1});
        const double error = std::abs(found.quantities[0].value - slides_and_rolls(v, mu * 9.81, c, time));
        EXPECT_GT(error, 1e-3);
        EXPECT_GT(found.quantities[0].error, error / 2);
        EXPECT_NE(found.trust, Trust::trust);
    }
}

// Likewise of impacts on what is driven along a curve, which are found on cubics: the error falls with the third power
// of the step, to 1e-8 m of steps of 1 ms.
TEST(Study, AMethodWithItsOwnStepDoesNotHideTheErrorOfImpactsOnACurve) {
    const auto start = [] {
        World world({.gravity = {0, -9.81}, .integrator = GaussRadau{}});
        const BodyId plate = world.add(Body{.kind = Kind::driven, .position = {0, -1}, .radius = 1});
        world.drive(plate, [](double t) { return Pose{{0, -1 + 0.1 * std::sin(23 * t)}}; });
        world.add(Body{.position = {0, 1}, .radius = 0.2, .name = "disc"});
        return world;
    };
    World fine = start();
    run(fine, 1, 1e-3);
    const std::vector<Probe> height = {{.name = "y", .value = [](const World& w) { return w.position(w.ids()[1]).y; }}};
    for (const double step : {0.1, 0.05}) {
        const Convergence found = study(start(), height, {.duration = 1, .step = step});
        const double error = std::abs(found.quantities[0].value - fine.position(fine.ids()[1]).y);
        EXPECT_GT(error, 1e-3) << step;
        EXPECT_GT(found.quantities[0].error, error / 2) << step;
        EXPECT_NE(found.trust, Trust::trust) << step;
    }
}

// ---- Chaos ----------------------------------------------------------------------------------------------------------

/// A point between discs on a square lattice of side 1: Sinai's billiard.
World sinai(double radius, std::uint64_t seed) {
    Random random(seed);
    World world;
    world.add(Periodic{.low = {0, 0}, .high = {1, 1}});
    world.add(Body{.kind = Kind::fixed, .position = {0.5, 0.5}, .radius = radius});
    const double angle = random.uniform(0, 2 * pi);
    world.add(Body{.position = {0.03, 0.04}, .velocity = {std::cos(angle), std::sin(angle)}});
    return world;
}

// truth.json, gas.sinai.lyapunov: 2.739 1/s at R = 0.4, an average over a long orbit. Here it is the rate of some 16
// e-folds, the logarithm of 1e-3/1e-10, or a dozen collisions, and those scatter.
TEST(Study, SinaisBilliardHasItsLyapunovExponent) {
    double sum = 0;
    int found = 0;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
        const Convergence c = study(sinai(0.4, seed), {}, {.duration = 30, .step = 0.01});
        if (!c.growth) continue;
        ++found, sum += c.growth->rate;
        EXPECT_GT(c.growth->rate, 2.739 / 2) << seed;
        EXPECT_LT(c.growth->rate, 2.739 * 2) << seed;
        EXPECT_EQ(c.trust, Trust::chaotic) << seed;
        EXPECT_LT(c.horizon, 30) << seed;
    }
    EXPECT_GE(found, 7);
    EXPECT_NEAR(sum / found, 2.739, 0.3 * 2.739);
}

/// Three bodies that stay together, and keep passing one another.
World three_bodies() {
    World world({.integrator = Rk4{}, .solver = NoContact{}});
    world.add(Body{.position = {1, 0}, .velocity = {0, 0.5}});
    world.add(Body{.position = {-1, 0}, .velocity = {0, -0.5}});
    world.add(Body{.position = {0.1, 0.6}, .velocity = {0.1, 0}});
    world.add(Attraction{.strength = 1, .softening = 0.1});
    return world;
}

TEST(Study, ThreeBodiesAndADoublePendulumAreChaotic) {
    // The rate belongs to the orbit, not to how long one looks: over 20 s and 60 s it is the same, 1.1 1/s.
    double rates[2];
    for (const int k : {0, 1}) {
        const Convergence three = study(three_bodies(), {}, {.duration = k ? 60.0 : 20.0, .step = 0.002});
        ASSERT_TRUE(three.growth);
        rates[k] = three.growth->rate;
        EXPECT_EQ(three.trust, k ? Trust::chaotic : Trust::refine) << three.sentence();
    }
    EXPECT_NEAR(rates[0] / rates[1], 1, 0.2);

    World pendulum({.gravity = {0, -9.81}, .integrator = Pefrl{}, .solver = NoContact{}});
    const BodyId pivot = pendulum.add(Body{.kind = Kind::fixed});
    const BodyId upper = pendulum.add(Body{.position = {1, 0.1}}), lower = pendulum.add(Body{.position = {2, 0.2}});
    pendulum.add(Spring{.a = pivot, .b = upper, .stiffness = 200, .rest_length = 1});
    pendulum.add(Spring{.a = upper, .b = lower, .stiffness = 200, .rest_length = 1});
    const Convergence two = study(pendulum, {}, {.duration = 60, .step = 0.01});
    EXPECT_TRUE(two.growth);
    EXPECT_EQ(two.trust, Trust::chaotic) << two.sentence();
}

TEST(Study, RegularMotionIsNeverCalledChaotic) {
    for (const double e : {0.0, 0.3, 0.6, 0.9}) {
        World world({.integrator = Verlet{}, .solver = NoContact{}});
        world.add(Body{.kind = Kind::fixed});
        world.add(Body{.position = {1 + e, 0}, .velocity = {0, std::sqrt((1 - e) / (1 + e))}});
        world.add(Attraction{.strength = 1});
        for (const double step : {0.3, 0.03, 0.003}) {
            const Convergence c = study(world, {}, {.duration = 60, .step = step});
            EXPECT_FALSE(c.growth) << "e " << e << " step " << step << ": " << c.sentence();
        }
    }
    for (const std::uint64_t seed : {1, 2, 3})
        EXPECT_FALSE(study(random_swing(seed, Verlet{}), {}, {.duration = 3, .step = 0.05}).growth) << seed;
}

// ---- Impacts --------------------------------------------------------------------------------------------------------

TEST(Study, AnElasticGasIsChaoticAndItsEnergyIsNot) {
    World gas({.solver = Impulse{.time_of_impact = false}});
    gas.add(Rectangle{.low = {0, 0}, .high = {8, 8}});
    Random random(4);
    for (int i = 0; i < 16; ++i)
        gas.add(Body{.position = {1.0 + 2 * (i % 4), 1.0 + 2 * (i / 4)},
                     .velocity = {random.normal(), random.normal()},
                     .radius = 0.4});
    const Convergence c = study(gas, {}, {.duration = 40, .step = 0.01});
    EXPECT_EQ(c.trust, Trust::chaotic) << c.sentence();
    ASSERT_TRUE(c.first_impact);
    EXPECT_FALSE(c.state.order) << "an order that is not there";
    const std::vector<Probe> kinetic{{.name = "T", .value = [](const World& w) { return energy(w).kinetic; }}};
    EXPECT_EQ(study(gas, kinetic, {.duration = 40, .step = 0.01, .judge_state = false}).trust, Trust::trust);
}

TEST(Study, TheOrderSurvivesImpactsThatAreFoundAndNotThoseThatAreNot) {
    for (const bool found : {true, false}) {
        World world({.gravity = {0, -9.81}, .integrator = Verlet{}, .solver = Impulse{.time_of_impact = found}});
        world.add(HalfPlane{});
        const BodyId nail = world.add(Body{.kind = Kind::fixed, .position = {0, 3}});
        const BodyId ball = world.add(Body{.position = {1, 1}, .radius = 0.1});
        world.add(Spring{.a = nail, .b = ball, .stiffness = 3, .rest_length = 1});
        const Convergence c = study(world, {}, {.duration = 2, .step = 0.004});
        ASSERT_TRUE(c.first_impact) << found;
        if (found) {
            ASSERT_TRUE(c.state.order);
            EXPECT_NEAR(*c.state.order, 2, 0.15);
        }
        if (c.state.order && !found) {
            EXPECT_LT(c.state.order_until, *c.first_impact);
        }
    }
}

/// A force that switches with the place: each crossing costs an error whose sign and size are those of chance, by where
/// in a step it falls.
World switched(double start) {
    World world({.integrator = Verlet{}, .solver = NoContact{}});
    world.add(Body{.position = {start, 0}});
    world.add(ForceField{.force = [](Vec2 x, Vec2, double, double) { return Vec2{x.x > 0 ? -3.0 : 1.0, 0}; }});
    return world;
}

TEST(Study, ASwitchedForceHasTheOrderOneOrNone) {
    for (int n = 0; n < 20; ++n) {
        const Convergence c = study(switched(1 + 0.01 * n), {}, {.duration = 20, .step = 0.02});
        EXPECT_FALSE(c.growth) << n;
        // Verlet's two are not there. What crossings cost on average may be an order of one.
        if (c.state.order && c.state.order_until > 19) {
            EXPECT_NEAR(*c.state.order, 1, 0.15) << n;
        }
    }
}

TEST(Study, AWorldThatExplodesIsToBeRefined) {
    World world({.integrator = Euler{}, .solver = NoContact{}, .long_step = LongStep::refuse});
    const BodyId wall = world.add(Body{.kind = Kind::fixed});
    const BodyId bob = world.add(Body{.position = {1, 0}});
    world.add(Spring{.a = wall, .b = bob, .stiffness = 400, .damping = 1});
    const Convergence c = study(world, {}, {.duration = 1, .step = 0.1});
    EXPECT_EQ(c.trust, Trust::refine);
    EXPECT_FALSE(c.runs[0].failure.empty());
    EXPECT_EQ(c.good_until, 0);
}

TEST(Study, WrongPlansAreErrors) {
    EXPECT_THROW(study(World{}, {}, {.duration = 0}), Error);
    EXPECT_THROW(study(World{}, {}, {.step = -1}), Error);
    for (const double tolerance : {-1.0, 0.0, std::nan("")})
        EXPECT_THROW(study(World{}, {}, {.tolerance = tolerance}), Error);
    EXPECT_THROW(study(World{}, {Probe{.name = "empty"}}, {}), Error);
    EXPECT_EQ(study(World{}, {}, {.duration = 1}).trust, Trust::trust);
}

// One that is no number from some time on was said to be right to a thousandth.
TEST(Study, LeavesOutWhatIsNoNumberAtTimes) {
    World world;
    world.add(Body{.velocity = {1, 0}});
    world.add(ForceField{.force = [](Vec2 x, Vec2, double, double) { return -1 * x; }});
    const Probe probe{.name = "x", .value = [](const World& w) { return w.time() > 1 ? NAN : w.positions()[0].x; }};
    const Convergence found = study(world, {probe}, {});
    EXPECT_EQ(found.quantities[0].left_out, "is no number at times");
    EXPECT_EQ(study(world, {probe}, {.judge_state = false}).trust, Trust::unjudged);
}

// Potentials are zero where somebody put the origin: a pendulum let go there has no energy at all, and its error is
// small beside what goes to and fro.
TEST(Study, JudgesTheTotalEnergyBesideTheEnergiesAtPlay) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    const BodyId nail = world.add(Body{.kind = Kind::fixed});
    const BodyId bob = world.add(Body{.position = {1, 0}});
    world.add(Joint{.a = nail, .b = bob, .type = DistanceJoint{.length = 1}});
    const Probe total{
        .name = "total", .value = [](const World& w) { return energy(w).total(); }, .is_total_energy = true};
    const Convergence c = study(world, {total}, {.duration = 5, .step = 0.01, .judge_state = false});
    EXPECT_EQ(c.trust, Trust::trust) << c.sentence();
    EXPECT_NEAR(c.quantities[0].size, 9.81, 0.01);  // it falls by a metre
}

// A gas by events does the same operations at every step: its runs are alike to the last bit, and wrong alike.
TEST(Study, IsNotDeceivedByRunsThatRoundAlike) {
    World world({.solver = Events{}});
    world.add(Rectangle{.low = {0, 0}, .high = {6, 6}});
    build(world,
          Gas{.fill = {.low = {0, 0}, .high = {6, 6}, .count = 20, .smallest_radius = 0.3, .largest_radius = 0.3}});
    const BodyId one = world.ids()[0];
    const Probe place{.name = "x", .value = [one](const World& w) { return w.position(one).x; }};
    const Probe heat{.name = "kinetic", .value = [](const World& w) { return energy(w).kinetic; }};
    const auto judged = [&](const std::vector<Probe>& probes, bool state, double duration) {
        return study(world, probes, {.duration = duration, .step = 0.1, .judge_state = state});
    };
    const Convergence all = judged({}, true, 60);
    EXPECT_EQ(all.trust, Trust::chaotic) << all.sentence();
    EXPECT_EQ(all.good_until, all.growth->horizon);
    EXPECT_LT(all.good_until, 60);
    EXPECT_EQ(judged({place}, false, 60).trust, Trust::chaotic);
    EXPECT_EQ(judged({heat}, false, 60).trust, Trust::trust);  // every hit keeps it
    EXPECT_EQ(judged({}, true, all.good_until / 2).trust, Trust::trust);
}

// Of runs that agree and do not shrink much the error is taken to be five times what is seen. Where there is a
// reference nothing has to be taken: scenes/rotation.json, right to 0.0003, was to be refined for an error of 0.0016
// that it has not.
TEST(Study, WhereThereIsAReferenceNothingIsMadeLarger) {
    constexpr double off = 3.2e-4;  // of all runs; they are within a third of that of one another
    Track truth, runs[3];
    Ladder ladder{};
    ladder.rounding = 1e-16, ladder.ratio = 2;
    for (int i = 0; i <= 100; ++i) {
        const double t = 0.01 * i;
        ladder.time.push_back(t);
        truth.push_back({t});
        // Differences of two shapes, so that there is no order, and of nearly one size.
        runs[2].push_back({t + off * t});
        runs[1].push_back({t + off * t + 3.6e-4 * t * (1 - t)});
        runs[0].push_back({t + off * t + 3.6e-4 * t * (1 - t) + 4e-4 * t * (1 - t) * (1 - 2 * t)});
    }
    const Followed f = follow({&runs[0], &runs[1], &runs[2]}, &truth, ladder, 0);
    EXPECT_FALSE(f.order);
    EXPECT_TRUE(f.apart);
    EXPECT_NEAR(f.error, off, 1e-12);  // it is that of the end, where the runs are one
    // Without one it is.
    const Followed alone = follow({&runs[0], &runs[1], &runs[2]}, nullptr, ladder, 0);
    EXPECT_GT(alone.shrink, 0);
    EXPECT_EQ(alone.by, ErrorBy::difference);
}

// What happened before is none of its business: a ball that had bounced was said to strike at t = 0, and the drifts had
// those of its past in them.
TEST(Study, BookedThePastOfItsWorld) {
    const auto ball = [](Vec2 position, Vec2 velocity) {
        World world({.gravity = {0, -10}, .solver = Impulse{}});
        world.add(HalfPlane{});
        world.add(Body{.position = position, .velocity = velocity, .radius = 0.1, .name = "ball"});
        return world;
    };
    World old = ball({0, 1}, {0.3, 0});
    run(old, 0.8, 1e-3);  // strikes at 0.42 s, and is near its highest then
    ASSERT_EQ(old.collisions(), 1u);
    const World fresh = ball(old.positions()[0], old.velocities()[0]);
    const StudyPlan plan{.duration = 0.1, .step = 1e-3};
    const Convergence a = study(old, place_of(old, "ball"), plan), b = study(fresh, place_of(fresh, "ball"), plan);
    EXPECT_FALSE(a.first_impact);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(a.runs[k].collisions, 0u);
        // The accounts of a past are rounded: a thousand additions of 10 J and 10 N s at most.
        EXPECT_NEAR(a.runs[k].energy_drift, b.runs[k].energy_drift, 1e-12);
        EXPECT_NEAR(a.runs[k].momentum_drift, b.runs[k].momentum_drift, 1e-12);
        EXPECT_NEAR(*a.runs[k].angular_drift, *b.runs[k].angular_drift, 1e-12);
    }
}

}  // namespace
}  // namespace carom
