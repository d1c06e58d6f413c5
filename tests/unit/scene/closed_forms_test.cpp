// Every closed form against a truth of its own: published values, limits, and the equation of motion integrated by
// a method of order 8.

#include "scene/closed_forms.hpp"

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/scene.hpp>
#include <cmath>

#include "error_of.hpp"
#include "math/elliptic.hpp"

namespace carom {
namespace {

double value(const std::string& formula, double t = 0) { return closed_form(formula, {})(t); }

/// The largest difference from a run of one body under gravity and a force, over the times of the run.
double off(World world, const std::string& x, double duration, double step = 0.05) {
    const auto formula = closed_form(x, {});
    double most = 0;
    const BodyId body = world.find("b");
    run(world, duration, step,
        [&](const World& w) { most = std::max(most, std::abs(w.position(body).x - formula(w.time()))); });
    return most;
}

/// A force along x by place, speed and time on a body of mass 1.
World along(double x, double v, std::function<double(double, double, double)> force) {
    World world({.integrator = Adaptive{.tolerance = 1e-13}, .solver = NoContact{}});
    world.add(Body{.position = {x, 0}, .velocity = {v, 0}, .name = "b"});
    world.add(ForceField{.force = [force](Vec2 at, Vec2 speed, double, double t) {
        return Vec2{force(at.x, speed.x, t), 0};
    }});
    return world;
}

// What 1e-13 a step leaves over some hundred steps.
constexpr double close = 1e-11;

TEST(ClosedForms, PublishedValues) {
    // truth.json: mech.damped, mech.pendulum, mech.drop.quad, mech.kepler, mech.chain.modes, ed.bounce,
    // mech.proj.linear
    EXPECT_NEAR(value("oscillator(1, 1, 0, 2*pi, 0.1*2*pi)"), 0.5315351237271717, 1e-14);
    EXPECT_NEAR(value("oscillator(1, 1, 0, 2*pi, 2*pi)"), 0.013600931465574935, 1e-14);
    EXPECT_NEAR(value("oscillator(1, 1, 0, 2*pi, 2*2*pi)"), 0.2000736246452928, 1e-14);
    const double periods[][2] = {{1, 2.0061048740557132},   {45, 2.0862558726143674}, {90, 2.3678419475762373},
                                 {150, 3.5350981863815236}, {170, 4.893524274105486}, {179, 7.825796837537682}};
    for (const auto& [degrees, period] : periods)
        EXPECT_NEAR(value("pendulum_period(t*deg, sqrt(9.81))", degrees), period, 1e-13 * period) << degrees;
    EXPECT_NEAR(value("newton_fall(5, 9.81, 0.01)"), 91.56004025108372, 1e-12);
    EXPECT_NEAR(value("newton_fall(3, 9.81, 0)"), 0.5 * 9.81 * 9, 1e-13);
    // ½ g t² (1 − g k t²/6): what is left out is of 1e-17 in the second.
    for (const char* k : {"1e-14", "1e-9"})
        EXPECT_NEAR(
            value(std::string("newton_fall(3, 9.81, ") + k + ") / (0.5 * 9.81 * 9 * (1 - 9.81 * 9 * " + k + " / 6))"),
            1, 1e-14);
    EXPECT_NEAR(value("newton_fall_speed(5, 9.81, 0.01)"), 28.702319455705407, 1e-13);
    EXPECT_NEAR(value("kepler_x(2, 1, 0.6, 1)"), -1.3398590471389715, 1e-14);
    EXPECT_NEAR(value("kepler_y(3, 1, 0.6, 1)"), 0.0707385106686625, 1e-14);
    EXPECT_NEAR(value("chain_frequency(10, 3, 1)"), 0.8308300260037729, 1e-15);
    EXPECT_NEAR(value("drag_place(2.4103775113124124, 0, 20*cos(45*deg), 0, 0.5)"), 19.809301292035858, 1e-12);
    EXPECT_NEAR(value("drag_place(2.4103775113124124, 0, 20*sin(45*deg), -9.81, 0.5)"), 0, 1e-12);
    EXPECT_NEAR(value("bouncing_ball(3.578892951020438, 1, 9.81, 0.8)"), 0, 1e-13);
    EXPECT_GT(value("bouncing_ball(4.06, 1, 9.81, 0.8)"), 0);
    EXPECT_EQ(value("bouncing_ball(4.07, 1, 9.81, 0.8)"), 0);
}

// After a hundred thousand bounces it lay still without a word.
TEST(ClosedForms, BouncingBallLaySoonerThanItRests) {
    const double g = 9.81, first = std::sqrt(2 / g);
    // Elastic: flights of 2√(2h/g). Times of 1e5 s are rounded to 1e-11 s, and so is a flight's share of them; a ball
    // has 4.4 m/s at most.
    for (const double after : {0.1, 0.3, 0.45})
        EXPECT_NEAR(value("bouncing_ball(t, 1, 9.81, 1)", 220000 * first + first + after),
                    after * (std::sqrt(2 * g) - 0.5 * g * after), 1e-9)
            << after;
    // The flights before the one at t, added up one by one; as well as above.
    for (const double e : {0.5, 0.999, 1 - 0x1p-20, 1 - 0x1p-33}) {
        long double flight = 2 * e * std::sqrt(2.0L / g), start = std::sqrt(2.0L / g);
        int n = 0;
        for (const int wanted : {1, 3, 30, 300000}) {
            for (; n < wanted; ++n) start += flight, flight *= e;
            if (flight < 1e-3L) break;
            const double t = static_cast<double>(start + flight / 3), since = static_cast<double>(t - start);
            EXPECT_NEAR(closed_form("bouncing_ball(t, 1, 9.81, e)", {{"e", e}})(t),
                        since * (0.5 * g * (static_cast<double>(flight) - since)), 1e-9)
                << e << " " << wanted;
        }
    }
    EXPECT_EQ(value("bouncing_ball(1e9, 1, 9.81, 0.999999)"), 0);
    EXPECT_EQ(value("bouncing_ball(1, 1, 9.81, 0)"), 0);
    EXPECT_EQ(value("bouncing_ball(1, 0, 9.81, 0.5)"), 0);
}

TEST(ClosedForms, Limits) {
    EXPECT_NEAR(value("drag_place(2, 1, 3, -9.81, 1e-12) - projectile(2, 1, 3, -9.81)"), 0, 1e-10);
    EXPECT_EQ(value("drag_place(2, 1, 3, -9.81, 0)"), value("projectile(2, 1, 3, -9.81)"));
    EXPECT_NEAR(value("oscillator(2, 1, 3, 2, 2*(1 + 1e-12))"), value("oscillator(2, 1, 3, 2, 2)"), 1e-11);
    EXPECT_NEAR(value("oscillator(2, 1, 3, 0, 0)"), 7, 1e-15);
    EXPECT_NEAR(value("pendulum(0.7, 1e-5, 3)/1e-5"), std::cos(2.1), 1e-10);
    EXPECT_NEAR(value("kepler_x(1, 2, 0, 8)"), 2 * std::cos(1.0), 1e-15);
    // At resonance, and a hair beside it.
    // From rest, without damping, t sin(Ωt)/2Ω, and δt² cos(Ωt)/4Ω less for a drive that is slower by δ: 0.1*3 is 0.3
    // and one bit.
    for (const char* drive : {"0.3", "0.1*3", "0.3*(1+1e-12)", "0.3*(1-1e-9)"})
        EXPECT_NEAR(value(std::string("driven_oscillator(100, 0, 0, 0.3, 0, 1, ") + drive + ")"),
                    value("100 * sin(30) / 0.6"), 1e-5)
            << drive;
    // Where one formula ends and the other begins, with and without damping.
    for (const char* gamma : {"0", "0.001"})
        EXPECT_NEAR(value(std::string("driven_oscillator(10, 1, 2, 2, ") + gamma + ", 3, 2.0489)"),
                    value(std::string("driven_oscillator(10, 1, 2, 2, ") + gamma + ", 3, 2.0515)"), 2e-2);
    EXPECT_NEAR(value("driven_oscillator(3, 0, 0, 2, 0, 1, 2)"),
                value("driven_oscillator(3, 0, 0, 2, 0, 1, 2.0000001)"), 1e-6);
}

TEST(ClosedForms, SolveTheirEquations) {
    for (const double gamma : {0.0, 0.2, 3.0, 5.0}) {
        const std::string g = std::to_string(gamma);
        EXPECT_LT(off(along(1, -2, [=](double x, double v, double) { return -2 * gamma * v - 9 * x; }),
                      "oscillator(t, 1, -2, 3, " + g + ")", 5),
                  close)
            << gamma;
        EXPECT_LT(off(along(1, -2,
                            [=](double x, double v, double t) { return -2 * gamma * v - 9 * x + 4 * std::cos(2 * t); }),
                      "driven_oscillator(t, 1, -2, 3, " + g + ", 4, 2)", 5),
                  close)
            << gamma;
    }
    EXPECT_LT(off(along(0, 0, [](double x, double, double t) { return -9 * x + std::cos(3 * t); }),
                  "driven_oscillator(t, 0, 0, 3, 0, 1, 3)", 5),
              close);
    EXPECT_LT(off(along(2, 5, [](double, double v, double) { return -9.81 - 0.7 * v; }),
                  "drag_place(t, 2, 5, -9.81, 0.7)", 5),
              close);
    EXPECT_LT(
        off(along(0, 0, [](double, double v, double) { return 9.81 - 0.3 * v * v; }), "newton_fall(t, 9.81, 0.3)", 5),
        close);
    for (const double angle : {0.1, 1.5, 3.0})
        EXPECT_LT(off(along(angle, 0, [](double x, double, double) { return -4 * std::sin(x); }),
                      "pendulum(t, " + std::to_string(angle) + ", 2)", 10),
                  10 * close)
            << angle;
}

TEST(ClosedForms, SpeedsAreDerivatives) {
    const char* pairs[][2] = {
        {"oscillator(t, 1, 2, 3, 0.4)", "oscillator_speed(t, 1, 2, 3, 0.4)"},
        {"oscillator(t, 1, 2, 3, 4)", "oscillator_speed(t, 1, 2, 3, 4)"},
        {"driven_oscillator(t, 1, 2, 3, 0.4, 5, 2)", "driven_oscillator_speed(t, 1, 2, 3, 0.4, 5, 2)"},
        {"driven_oscillator(t, 1, 2, 3, 0, 5, 3)", "driven_oscillator_speed(t, 1, 2, 3, 0, 5, 3)"},
        {"pendulum(t, 2.5, 3)", "pendulum_speed(t, 2.5, 3)"},
        {"drag_place(t, 1, 2, 3, 0.4)", "drag_speed(t, 2, 3, 0.4)"},
        {"newton_fall(t, 9.81, 0.2)", "newton_fall_speed(t, 9.81, 0.2)"}};
    constexpr double h = 1e-3;  // the central difference of four points is good to h⁴ x⁽⁵⁾/30, some 1e-10 here
    for (const auto& [place, speed] : pairs)
        for (const double t : {0.3, 1.0, 2.7}) {
            const auto x = closed_form(place, {});
            const double slope = (8 * (x(t + h) - x(t - h)) - (x(t + 2 * h) - x(t - 2 * h))) / (12 * h);
            EXPECT_NEAR(value(speed, t), slope, 1e-8) << place << " at " << t;
        }
}

TEST(ClosedForms, JacobisFunctionsAndKeplersEquation) {
    // Abramowitz, Stegun, 16.1 and 17.3: K(sin 45°), and sn, cn, dn at K/2 of that modulus.
    const double k = std::sqrt(0.5), quarter = elliptic_k(k);
    EXPECT_NEAR(quarter, 1.854074677301371918, 1e-15);
    EXPECT_NEAR(jacobi(quarter, k).sn, 1, 1e-15);
    EXPECT_NEAR(jacobi(quarter, k).cn, 0, 1e-15);
    EXPECT_NEAR(jacobi(quarter, k).dn, k, 1e-15);
    const double other = std::sqrt(0.5);  // √(1 − k²)
    EXPECT_NEAR(jacobi(quarter / 2, k).sn, 1 / std::sqrt(1 + other), 1e-15);
    for (const double e : {0.0, 0.5, 0.9, 0.999999})
        for (const double m : {-20.0, -1e-3, 0.0, 1e-9, 0.1, 3.14159, 100.0}) {
            const double anomaly = eccentric_anomaly(m, e);
            EXPECT_NEAR(anomaly - e * std::sin(anomaly), m, 1e-14 * std::max(1.0, std::abs(m))) << e << " " << m;
        }
}

// An orbit of eccentricity 2 was a smooth curve, and mode 1.5 of a chain a number.
TEST(ClosedForms, ANumberThatTheFormulaIsNotForGaveAnother) {
    const auto error = [](const std::string& formula, double t = 0) {
        return test::error_of([&] { value(formula, t); });
    };
    EXPECT_EQ(error("kepler_x(1, 1, 1.5, 1)"), "'kepler_x' needs 0 <= e < 1, got e = 1.5");
    EXPECT_EQ(error("kepler_y(1, 1, 1, 1)"), "'kepler_y' needs 0 <= e < 1, got e = 1");
    EXPECT_EQ(error("kepler_x(1, 1, -0.5, 1)"), "'kepler_x' needs 0 <= e < 1, got e = -0.5");
    EXPECT_EQ(error("kepler_x(1, -1, 0.5, 1)"), "'kepler_x' needs a > 0, got a = -1");
    EXPECT_EQ(error("pendulum(1, 4, 1)"), "'pendulum' needs |angle| < pi, got angle = 4");
    EXPECT_EQ(error("pendulum_period(pi, 1)"), "'pendulum_period' needs |angle| < pi, got angle = 3.141592653589793");
    EXPECT_EQ(error("chain_mode(0, 1, 3, 1.5, 1, 1)"), "'chain_mode' needs a whole j from 1 to n, got j = 1.5");
    EXPECT_EQ(error("chain_mode(0, 4, 3, 1, 1, 1)"), "'chain_mode' needs a whole i from 1 to n, got i = 4");
    EXPECT_EQ(error("chain_frequency(2.5, 1, 1)"), "'chain_frequency' needs a whole n >= 1, got n = 2.5");
    EXPECT_EQ(error("chain_frequency(3, 4, 1)"), "'chain_frequency' needs a whole j from 1 to n, got j = 4");
    EXPECT_EQ(error("bouncing_ball(3, 1, 9.81, 1.5)"), "'bouncing_ball' needs 0 <= e <= 1, got e = 1.5");
    EXPECT_EQ(error("newton_fall(1, 9.81, -1)"), "'newton_fall' needs k >= 0, got k = -1");
    EXPECT_EQ(error("kepler_x(1, 1, t, 1)", 0.5), "no error");
    EXPECT_EQ(error("kepler_x(1, 1, t, 1)", 2), "'kepler_x' needs 0 <= e < 1, got e = 2");
    // What is not asked for is no error.
    EXPECT_EQ(value("t < 1 ? kepler_x(1, 1, t, 1) : 5", 2), 5);
}

TEST(ClosedForms, WrongCallsSayWhatIsTaken) {
    const auto error = [](const char* text) { return test::error_of([&] { closed_form(text, {}); }); };
    EXPECT_EQ(error("kepler_x(1, 2)"), "in \"kepler_x(1, 2)\": 'kepler_x' takes 4 numbers (t, a, e, mu), got 2");
    EXPECT_EQ(error("kepler_z(1)"), "in \"kepler_z(1)\": there is no function 'kepler_z'; did you mean 'kepler_x'?");
    EXPECT_EQ(error("pendulum"), "in \"pendulum\": 'pendulum' is a function and needs (");
    for (const ClosedForm& form : closed_forms()) EXPECT_FALSE(std::string(form.source).empty()) << form.name;
}

}  // namespace
}  // namespace carom
