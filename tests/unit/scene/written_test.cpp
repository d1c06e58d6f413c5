// What a scene says is what it gets: nothing that is written in it is passed over, and nothing that is not is made up.

#include <gtest/gtest.h>

#include <array>
#include <carom/scene.hpp>

#include "error_of.hpp"

namespace {

using namespace carom;

Scene written(const std::string& rest) { return Scene::parse("{\"carom\": 1, " + rest + "}", "f"); }
std::string complaint_of(const std::string& rest) {
    return test::error_of([&] { written(rest).world(); });
}

// With x alone the body went to y = 0, wherever it had been placed.
TEST(Written, DriveAlongOneAxisPutTheBodyOnTheOther) {
    const auto with = [](const std::string& drive) {
        return written(R"("bodies": [{"name": "b", "kind": "driven", "position": [1, 2], "angle": 0.5}],
            "forces": [{"type": "drive", "body": "b")" +
                       drive + "}]")
            .world();
    };
    World along_x = with(R"(, "x": "3 + t")"), along_y = with(R"(, "y": "t")"), turning = with(R"(, "angle": "t")");
    for (World* world : {&along_x, &along_y, &turning}) world->step(0.5);
    const auto pose = [](const World& w) {
        const BodyId b = w.find("b");
        return std::array{w.position(b).x, w.position(b).y, w.angle(b)};
    };
    EXPECT_EQ(pose(along_x), (std::array{3.5, 2., 0.5}));
    EXPECT_EQ(pose(along_y), (std::array{1., 0.5, 0.5}));
    EXPECT_EQ(pose(turning), (std::array{1., 2., 0.5}));
    EXPECT_EQ(pose(with("")), (std::array{1., 2., 0.5}));
}

// A mass that was written beside densities counted for nothing.
TEST(Written, MassBesideADensityWasPassedOver) {
    const auto body = [](const std::string& fields, const std::string& shape) {
        return R"("bodies": [{"name": "b")" + fields + R"(, "shapes": [{"type": "box", "width": 2, "height": 3)" +
               shape + "}]}]";
    };
    const std::string heavy = R"(, "mass": 100)", dense = R"(, "density": 2)", fixed = R"(, "kind": "fixed")";
    EXPECT_EQ(complaint_of(body(heavy, dense)),
              "f: bodies[0].mass must not be given beside a density, which makes it 12 kg, got 100");
    EXPECT_EQ(written(body("", dense)).world().masses()[0], 12);
    EXPECT_EQ(written(body(heavy, "")).world().masses()[0], 100);
    EXPECT_EQ(written(body(R"(, "mass": "2*6")", dense)).world().masses()[0], 12);  // as saved scenes have it
    EXPECT_EQ(written(body(heavy + fixed, dense)).world().masses()[0], 100);        // what attracts
    EXPECT_EQ(complaint_of(R"("builders": [{"type": "grid", "nx": 2, "ny": 2, "body": {"mass": 3,
                           "shapes": [{"type": "box", "density": 2}]}}])"),
              "f: builders[0].body.mass must not be given beside a density, which makes it 2 kg, got 3");
    const std::string fill = R"("fill": {"count": 3, "high": [9, 9], "density": 2, "body": {"mass": 3}})";
    EXPECT_TRUE(complaint_of("\"builders\": [{\"type\": \"gas\", " + fill + "}]")
                    .starts_with("f: builders[0].fill.body.mass must not be given beside a density, which makes it "));
    const Scene saved = Scene::of(written(body("", dense)).world());
    EXPECT_EQ(Scene::of(Scene::parse(saved.text()).world()).text(), saved.text());
}

TEST(Written, WhatIsWrongIsSaidInTheWordsOfTheScene) {
    // It was "must be a text", where a number had been meant.
    EXPECT_EQ(complaint_of(R"("forces": [{"type": "field", "x": -9.81}])"),
              "f: forces[0].x must be a text, for example \"-9.81\", got -9.81");
    // There was no 'b' at all, it said.
    EXPECT_EQ(complaint_of(R"("parameters": {"a": "b+1", "b": 2})"),
              "f: parameters.a must be a finite number or an expression of the parameters, got \"b+1\": 'b' comes "
              "later: an expression knows the parameters before it");
    EXPECT_TRUE(complaint_of(R"("parameters": {"a": "a+1"})").ends_with("\"a+1\": there is no 'a' here"));
    // It was "not both", of neither.
    for (const auto& [given, has] : {std::pair{"", "neither"}, {R"("count": 3, "fraction": 0.1)", "both"}})
        EXPECT_EQ(complaint_of(std::string(R"("builders": [{"type": "gas", "fill": {)") + given + "}}]"),
                  std::string("f: builders[0].fill must have either a fraction or a count, and has ") + has);
    // It was World::drive's curve, at (-nan, 0) m.
    const std::string drive =
        R"("bodies": [{"name": "b", "kind": "driven"}], "forces": [{"type": "drive", "body": "b", )";
    EXPECT_EQ(complaint_of(drive + R"f("x": "sqrt(t-1)"}])f"),
              "f: forces[0].x must be a finite number in m from 2 ms before the start on, got \"sqrt(t-1)\": it is no "
              "number at 0 s");
    EXPECT_EQ(complaint_of(drive + R"("angle": "1/t"}])"),
              "f: forces[0].angle must be a finite number in rad from 2 ms before the start on, got \"1/t\": it is inf "
              "at 0 s");
    // It did -nan J of work.
    EXPECT_TRUE(complaint_of(drive + R"f("y": "sqrt(t)"}])f").ends_with("it is no number at -0.002 s"));
    // The second one was taken, and the first forgotten.
    EXPECT_EQ(complaint_of(drive + R"("x": "t"}, {"type": "drive", "body": "b", "y": "t"}])"),
              "f: forces[1].body must be a body that follows no curve yet, got \"b\"");
    // Capital letters were as far from small ones as from any other.
    EXPECT_TRUE(complaint_of(R"("world": {"integrator": "RK4"})").ends_with("got \"RK4\"; did you mean 'rk4'?"));
    EXPECT_TRUE(complaint_of(R"("World": {})").ends_with("has no field \"World\"; did you mean 'world'?"));
}

// It named a part, heat.damping, though there is a sum.
TEST(Written, SumOfAnAccountWasNotSuggested) {
    const World world;
    for (const std::string account : {"energy.heat", "energy.work", "energy"})
        EXPECT_EQ(test::error_of([&] { Quantity(account, world, {}); }),
                  "in \"" + account + "\": there is no '" + account + "'; did you mean '" + account + ".total'?");
}

}  // namespace
