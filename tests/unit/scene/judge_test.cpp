// The statistics of expectations, on functions that are known: a driven body moves along one.

#include <gtest/gtest.h>

#include <carom/scene.hpp>
#include <cmath>
#include <numbers>

namespace {

using namespace carom;

/// x of a body that moves along `curve` for 2 s, judged.
double judged(const std::string& curve, const std::string& expectation, double step) {
    Scene scene = Scene::parse(R"({"carom": 1, "world": {"solver": "none"}, "bodies": [{"name": "b", "kind": "driven"}],
        "forces": [{"type": "drive", "body": "b", "x": ")" +
                               curve + R"("}], "run": {"duration": 2},
        "expects": [{"quantity": "b.x", "value": 0, )" +
                               expectation + "}]}");
    World world = scene.world();
    Judge judge(scene, world);
    run(world, 2, step, [&](const World& now) { judge.observe(now); });
    return judge.verdicts().at(0).value;
}

/// The order of accuracy, from the errors at two steps.
double order(const std::string& curve, const std::string& expectation, double exact) {
    const double h = 0.0625;  // 2 s are whole steps of it
    const double coarse = std::abs(judged(curve, expectation, h) - exact);
    const double fine = std::abs(judged(curve, expectation, h / 2) - exact);
    return std::log2(coarse / fine);
}

const std::string wave = "sin(3*t) + 0.3*t";

TEST(Judge, EndIsTheLastValue) { EXPECT_DOUBLE_EQ(judged("3 + t", R"("statistic": "end")", 0.1), 5); }

TEST(Judge, AtIsExactOnAStepAndOfFourthOrderBetween) {
    EXPECT_EQ(judged("t*t", R"("at": 1)", 0.125), 1);
    EXPECT_EQ(judged("t*t", R"("at": 0)", 0.125), 0);
    EXPECT_NEAR(judged("t*t*t - t", R"("at": 1.03)", 0.125), 1.03 * 1.03 * 1.03 - 1.03, 1e-14);
    EXPECT_GT(order(wave, R"("at": 0.61)", std::sin(1.83) + 0.183), 3.5);
}

/// A run of thirty steps that nearly make 10 s was counted as thirty-one, and its last sample was lost.
TEST(Judge, CountsTheStepsThatARunMakes) {
    for (const double step : {0.1, 1.0 / 3, 0.33333333333, 0.3333333333, 0.3, 7.0, 10.0, 11.0}) {
        World world;
        std::uint64_t made = 0;
        run(world, 10, step, [&](const World&) { ++made; });
        EXPECT_EQ(steps_of({.duration = 10, .step = step}), made) << step;
    }
}

TEST(Judge, AtOfALaterTimeIsNever) { EXPECT_TRUE(std::isnan(judged("t", R"("at": 3)", 0.1))); }

// The turn of an angle, from π to −π, and a pole were zeros.
TEST(Judge, AJumpIsNoZero) {
    const std::string zero = R"("statistic": "zero")";
    EXPECT_NEAR(judged("atan2(sin(2*pi*t), cos(2*pi*t))", zero, 0.013), 1, 1e-6);
    EXPECT_TRUE(std::isnan(judged("1/(t - 0.305)", zero, 0.01)));
    EXPECT_NEAR(judged("tan(3*t + 0.1)", zero, 0.013), (std::numbers::pi - 0.1) / 3, 1e-5);
    // What is seen but a few times in a swing is none, nor what changes in the last step.
    EXPECT_NEAR(judged("cos(pi*t/0.6 - 1.2)", zero, 0.2), 0.6 / std::numbers::pi * (1.2 + std::numbers::pi / 2), 0.05);
    EXPECT_NEAR(judged("t - 1.95", zero, 0.1), 1.95, 1e-12);
}

// A velocity jumps, too: in an impact it changes its sign.
TEST(Judge, ABounceIsAChangeOfSign) {
    for (const char* solver : {"impulse", "softstep"}) {
        const Scene scene =
            Scene::parse(std::string(R"({"carom": 1, "world": {"gravity": [0, -10], "solver": ")") + solver +
                         R"("}, "walls": [{"type": "half-plane"}],
            "bodies": [{"name": "b", "position": [0, 5.1], "radius": 0.1}], "run": {"duration": 5, "step": 0.01},
            "expects": [{"quantity": "b.vy", "statistic": "zero", "value": 1},
                        {"quantity": "b.vy", "statistic": "zero", "number": 2, "value": 2}]})");
        World world = scene.world();
        Judge judge(scene, world);
        run(world, 5, 0.01, [&](const World& now) { judge.observe(now); });
        EXPECT_NEAR(judge.verdicts().at(0).value, 1, 0.01) << solver;
        EXPECT_NEAR(judge.verdicts().at(1).value, 2, 0.01) << solver;
    }
}

TEST(Judge, ExtremesLieBetweenSteps) {
    // The derivative 3 cos 3t + 0.3 vanishes at the maximum and at the minimum.
    const double t1 = std::acos(-0.1) / 3, t2 = (2 * std::numbers::pi - std::acos(-0.1)) / 3;
    EXPECT_NEAR(judged("1 - (t - 0.77)^2", R"("statistic": "maximum")", 0.1), 1, 1e-14);
    // The error depends on where the samples lie: the worst of ten places falls with the third order at least.
    const auto worst = [](double step) {
        double error = 0;
        for (int k = 0; k < 10; ++k) {
            const std::string shifted = "sin(3*t + " + std::to_string(0.05 * k) + ")";
            error = std::max(error, std::abs(judged(shifted, R"("statistic": "minimum", "at": 1.9)", step) + 1));
        }
        return error;
    };
    EXPECT_GT(std::log2(worst(0.0625) / worst(0.03125)), 2.9);
    EXPECT_NEAR(judged(wave, R"("statistic": "maximum", "at": 1)", 0.01), std::sin(3 * t1) + 0.3 * t1, 1e-6);
    EXPECT_NEAR(judged(wave, R"("statistic": "minimum", "at": 1.8)", 0.01), std::min(0.0, std::sin(3 * t2) + 0.3 * t2),
                1e-6);
}

// A parabola through a jump or a kink went beyond all values that there were: 1.25 where a speed of 1 turns over.
TEST(Judge, AnExtremeAtAJumpOvershot) {
    EXPECT_EQ(judged("t < 1.005 ? 1 : -1", R"("statistic": "maximum")", 0.01), 1);
    EXPECT_EQ(judged("t < 1.005 ? 1 : -1", R"("statistic": "minimum")", 0.01), -1);
    EXPECT_EQ(judged("t < 1.005 ? 0 : 1", R"("statistic": "maximum")", 0.01), 1);
    EXPECT_LE(judged("t < 1.003 ? t^2 : 2 - t", R"("statistic": "maximum")", 0.01), 1);
    EXPECT_GE(judged("abs(t - 1.004)", R"("statistic": "minimum")", 0.01), 0);
    // In the first steps and in the last there is but one side to look at.
    EXPECT_EQ(judged("t < 0.015 ? 1 : -1", R"("statistic": "maximum")", 0.01), 1);
    EXPECT_EQ(judged("t < 1.985 ? 1 : -1", R"("statistic": "maximum")", 0.01), 1);
    EXPECT_EQ(judged("t < 1.985 ? 0 : 1", R"("statistic": "maximum")", 0.01), 1);
}

// A ball between two walls flies at 1 m/s all the time, and an account of heat only grows.
TEST(Judge, AnExtremeOvershotInAnImpact) {
    const Scene scene = Scene::parse(R"json({"carom": 1, "world": {"gravity": [0, -9.81]},
        "walls": [{"type": "half-plane"}, {"type": "rectangle", "low": [-2, -2], "high": [2, 9]}],
        "bodies": [{"name": "b", "position": [0, 2], "velocity": [1, 0], "restitution": 0.8}],
        "run": {"duration": 1.9, "step": 0.01},
        "expects": [{"quantity": "b.vx", "statistic": "maximum", "value": 1},
                    {"quantity": "energy.heat.impact", "statistic": "maximum", "value": 0},
                    {"quantity": "energy.heat.impact", "value": 0}]})json");
    World world = scene.world();
    Judge judge(scene, world);
    run(world, 1.9, 0.01, [&](const World& now) { judge.observe(now); });
    const auto verdicts = judge.verdicts();
    EXPECT_EQ(verdicts[0].value, 1);
    EXPECT_NEAR(verdicts[1].value, verdicts[2].value, 1e-12);
    EXPECT_GT(verdicts[2].value, 1);
}

TEST(Judge, ExtremesAtTheEndsCount) {
    EXPECT_EQ(judged("5 - t", R"("statistic": "maximum")", 0.1), 5);
    EXPECT_NEAR(judged("5 - t", R"("statistic": "minimum")", 0.1), 3, 1e-12);
}

TEST(Judge, MeanIsOfSecondOrder) {
    EXPECT_NEAR(judged("3 + 2*t", R"("statistic": "mean")", 0.1), 5, 1e-13);
    EXPECT_NEAR(judged("3 + 2*t", R"("statistic": "mean", "at": 1.03)", 0.1), 4.03, 1e-13);
    EXPECT_NEAR(order("sin(3*t)", R"("statistic": "mean")", (1 - std::cos(6)) / 6), 2, 0.1);
}

TEST(Judge, ZeroIsOfFourthOrder) {
    EXPECT_NEAR(judged("t - 0.77", R"("statistic": "zero")", 0.1), 0.77, 1e-14);
    EXPECT_GT(order("sin(3*t)", R"("statistic": "zero")", std::numbers::pi / 3), 3.5);
    EXPECT_NEAR(judged("cos(9*t)", R"("statistic": "zero", "number": 3)", 0.01), 2.5 * std::numbers::pi / 9, 1e-7);
    EXPECT_TRUE(std::isnan(judged("1 + t", R"("statistic": "zero")", 0.1)));
}

TEST(Judge, AStartAtZeroIsNoChangeOfSignWhicheverWayItGoes) {
    const double exact = std::numbers::pi / 3;
    EXPECT_NEAR(judged("sin(3*t)", R"("statistic": "zero")", 0.01), exact, 1e-8);
    EXPECT_NEAR(judged("-sin(3*t)", R"("statistic": "zero")", 0.01), exact, 1e-8);
}

TEST(Judge, AZeroOnAStepIsThere) {
    EXPECT_EQ(judged("t - 1", R"("statistic": "zero")", 0.125), 1);
    EXPECT_TRUE(std::isnan(judged("(t - 1)^2", R"("statistic": "zero")", 0.125)));  // touched, not crossed
}

TEST(Judge, ZerosAfterTheTimeGivenDoNotCount) {
    EXPECT_TRUE(std::isnan(judged("t - 1.5", R"("statistic": "zero", "at": 1)", 0.1)));
}

TEST(Judge, AQuantityThatIsNoNumberIsNeverRight) {
    const Scene scene = Scene::parse(R"json({"carom": 1, "bodies": [{"name": "b"}],
        "expects": [{"quantity": "sqrt(0.5 - t)", "statistic": "maximum", "value": 0.7, "tolerance": 1}]})json");
    World world = scene.world();
    Judge judge(scene, world);
    run(world, 1, 0.1, [&](const World& now) { judge.observe(now); });
    EXPECT_FALSE(judge.verdicts().at(0).ok);
    EXPECT_TRUE(std::isnan(judge.verdicts().at(0).value));
}

TEST(Judge, ToleranceIsAbsoluteOrRelative) {
    const auto ok = [](const std::string& rest) {
        const Scene scene = Scene::parse(
            R"({"carom": 1, "bodies": [{"name": "b", "position": [10, 0]}], "expects": [{"quantity": "b.x", )" + rest +
            "}]}");
        const World world = scene.world();
        return Judge(scene, world).verdicts().at(0).ok;
    };
    EXPECT_TRUE(ok(R"("value": 10)"));
    EXPECT_FALSE(ok(R"("value": 10.1)"));
    EXPECT_TRUE(ok(R"("value": 10.5, "tolerance": 0.5)"));
    EXPECT_FALSE(ok(R"("value": 10.6, "tolerance": 0.5)"));
    EXPECT_TRUE(ok(R"("value": 9.5, "tolerance": 0.1, "relative": true)"));
    EXPECT_FALSE(ok(R"("value": 9, "tolerance": 0.1, "relative": true)"));
}

TEST(Judge, SaysWhichExpectationIsWrong) {
    const Scene scene = Scene::parse(
        R"({"carom": 1, "bodies": [{"name": "ball"}], "expects": [{"quantity": "t", "value": 0}, {"quantity": "bal.x", "value": 0}]})",
        "s.json");
    const World world = scene.world();
    try {
        Judge(scene, world);
        FAIL();
    } catch (const Error& e) {
        EXPECT_STREQ(
            e.what(),
            "s.json: expects[1].quantity is wrong: in \"bal.x\": there is no body 'bal'; did you mean 'ball'?");
    }
}

TEST(Judge, SaysWhereAClosedFormWasAskedForWhatItIsNotFor) {
    const Scene scene = Scene::parse(
        R"json({"carom": 1, "bodies": [{"name": "b"}], "expects": [{"quantity": "kepler_x(t, 1, 2, 1)", "value": 0}],
            "twins": [{"quantity": "b.x", "formula": "pendulum(t, 3 + t, 1)"}], "run": {"duration": 1, "step": 0.1}})json",
        "s.json");
    World world = scene.world();
    const auto error = [](const auto& action) -> std::string {
        try {
            action();
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(error([&] { Judge(scene, world); }),
              "s.json: expects[0].quantity is wrong at t = 0 s: 'kepler_x' needs 0 <= e < 1, got e = 2");
    Twins twins(scene, world);
    world.step(0.25);
    EXPECT_EQ(error([&] { twins.observe(world); }),
              "s.json: twins[0] is wrong at t = 0.25 s: 'pendulum' needs |angle| < pi, got angle = 3.25");
}

}  // namespace
