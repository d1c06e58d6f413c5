// Mistakes that people make, and what they are told.

#include <gtest/gtest.h>

#include <carom/scene.hpp>

#include "error_of.hpp"
#include "scene/expression.hpp"
#include "scene/json.hpp"

namespace {

using namespace carom;
using test::error_of;

std::string refused(const std::string& rest) {
    return error_of([&] { Scene::parse("{\"carom\": 1, " + rest + "}", "f").world(); });
}
std::string wrong_formula(const std::string& text) {
    return error_of([&] { Function(text, {"x"}, {}); });
}

TEST(Mistakes, AFieldThatIsNoNumberAtTheStartWasSaidOfItsBodyAfterAStep) {
    const auto field = [](const std::string& forces) {
        return refused(R"("bodies": [{"name": "wall", "kind": "fixed"}, {"name": "A", "position": [0.5, 0]}, {}],
                        "forces": [{"type": "field", )" +
                       forces + "}]");
    };
    EXPECT_EQ(field(R"x("body": "A", "x": "sqrt(-x-1)")x"),
              "f: forces[0].x must be a finite number in N where bodies start, got \"sqrt(-x-1)\": it is no number for "
              "body 'A' at (0.5, 0) m with velocity (0, 0) m/s, at 0 s");
    EXPECT_EQ(field(R"("y": "1/x")"),
              "f: forces[0].y must be a finite number in N where bodies start, got \"1/x\": it is inf for body 2 at "
              "(0, 0) m with velocity (0, 0) m/s, at 0 s");
    EXPECT_EQ(field(R"x("body": "A", "x": "1/x", "potential": "ln(x - 1)")x"),
              "f: forces[0].potential must be a finite number in J where bodies start, got \"ln(x - 1)\": it is no "
              "number for body 'A' at (0.5, 0) m with velocity (0, 0) m/s, at 0 s");
    EXPECT_EQ(field(R"("body": "wall", "x": "1/x")"), "no error");  // feels no force
    EXPECT_EQ(field(R"x("body": "A", "x": "kepler_x(1, 1, 2, 1)")x").substr(0, 65),
              "f: forces[0].x must be a finite number in N where bodies start, g");
}

TEST(Mistakes, TheRestitutionOfAWallHadNoHintAtItsSide) {
    EXPECT_EQ(refused(R"("walls": [{"type": "half-plane", "restitution": 0}])"),
              "f: walls[0] has no field \"restitution\"; did you mean 'side.restitution'?");
}

TEST(Mistakes, ATypographicMinusWasAnInvalidLiteral) {
    const auto json = [](const std::string& text) { return error_of([&] { parse_json(text, "f"); }); };
    const std::string minus = "'−' is a typographic minus (U+2212), and what is meant is written '-'";
    EXPECT_EQ(json("[0, −5]"), "f:1:5: " + minus);
    EXPECT_EQ(json("[−1]"), "f:1:2: " + minus);
    EXPECT_EQ(json("{\"a\": 3−1}"), "f:1:8: " + minus);
    EXPECT_EQ(json("{\"a\": 1e−3}"), "f:1:9: " + minus);
    EXPECT_EQ(json("[1,\u00a02]"), "f:1:4: '\u00a0' is no plain blank (U+00A0), and what is meant is written ' '");
    EXPECT_EQ(json("{“a”: 1}"), "f:1:2: texts stand in quotes like \"these\", and not in “");
    EXPECT_EQ(wrong_formula("−5*x"), minus);
    EXPECT_EQ(wrong_formula("3 − x"), minus);
    EXPECT_EQ(wrong_formula("−sin(x)"), minus);
    EXPECT_EQ(wrong_formula("2·x"), "'·' is a typographic times sign (U+00B7), and what is meant is written '*'");
    EXPECT_EQ(wrong_formula("x²"), "'²' is a raised 2 (U+00B2), and what is meant is written '^2'");
    EXPECT_EQ(wrong_formula("2π"), "'π' is a Greek letter (U+03C0), and what is meant is written 'pi'");
    EXPECT_EQ(wrong_formula("x ≤ 3"), "'≤' is a typographic sign (U+2264), and what is meant is written '<='");
    EXPECT_EQ(wrong_formula("x≠3"), "'≠' is a typographic sign (U+2260), and what is meant is written '!='");
    EXPECT_EQ(wrong_formula("‘x’"), "'‘' is a typographic quote (U+2018), and what is meant is written '''");
    // JSON has a minus, but no product.
    EXPECT_EQ(json("{\"a\": 3×2}"),
              "f:1:8: '×' is a typographic times sign (U+00D7), and what is meant is written '*'; expressions stand in "
              "quotes like \"2*pi\"");
    EXPECT_EQ(error_of([] { Function("a−b", {"a−b"}, {}); }), "no error");  // a name may have any letter
}

TEST(Mistakes, WordsFromElsewhereWereAnsweredByAList) {
    const auto asks = [](const std::string& said, const char* ours) {
        EXPECT_TRUE(said.ends_with(std::string("; did you mean '") + ours + "'?")) << said;
    };
    asks(refused(R"("body": [])"), "bodies");
    asks(refused(R"("bodies": [], "joints": [{"type": "hinge"}])"), "revolute");
    asks(refused(R"("bodies": [{"kind": "static"}])"), "fixed");
    asks(refused(R"("bodies": [{"omega": 1}])"), "angular_velocity");
    asks(refused(R"("bodies": [{"shapes": [{"type": "circle"}]}])"), "disc");
    asks(refused(R"("world": {"integrator": "leapfrog"})"), "verlet");
    asks(refused(R"("run": {"dt": 1})"), "step");
    asks(refused(R"("run": {"time": 1})"), "duration");
    asks(refused(R"("gravity": [0, -1])"), "world.gravity");
    asks(refused(R"("Gravity": [0, -1])"), "world.gravity");
    asks(refused(R"("dt": 1)"), "run.step");
    const auto set = [](const char* name) {
        return error_of([&] { Scene::parse(R"({"carom": 1, "parameters": {"durations": 1}})", "f").set(name, "1"); });
    };
    EXPECT_EQ(set("duration"), "f: has no parameter \"duration\"; did you mean 'run.duration'?");
    asks(set("run.dt"), "step");
    asks(set("gravity"), "world.gravity");
    asks(set("duratons"), "durations");
}

TEST(Mistakes, AMethodUnderTheOthersKeyAndGravityAmongForcesWereAnsweredByAList) {
    const auto ends = [](const std::string& said, const std::string& hint) {
        EXPECT_TRUE(said.ends_with(hint)) << said;
    };
    ends(refused(R"("world": {"solver": "euler"})"), "got \"euler\"; did you mean 'world.integrator'?");
    ends(refused(R"("world": {"integrator": "softstep"})"), "got \"softstep\"; did you mean 'world.solver'?");
    ends(refused(R"("bodies": [{}], "joints": [{"type": "rope"}])"), "got \"rope\"; did you mean 'distance'?");
    ends(refused(R"("forces": [{"type": "wind"}])"), "got \"wind\"; did you mean 'drag'?");
    EXPECT_EQ(refused(R"("forces": [{"type": "gravity"}])"),
              "f: forces[0].type \"gravity\" is none: what all bodies fall with is world.gravity, and between bodies "
              "it is \"attraction\"");
}

TEST(Mistakes, TheDecimalLogarithmWasSaidToBeTheNaturalOne) {
    EXPECT_EQ(wrong_formula("log10(x)"), "there is no function 'log10'; that is written ln(x)/ln(10)");
    EXPECT_EQ(wrong_formula("sgn(x)"), "there is no function 'sgn'; that is written sign(x)");  // and not sin
    EXPECT_EQ(wrong_formula("sqr(x)"), "there is no function 'sqr'; that is written x^2");      // and not sqrt
    EXPECT_EQ(wrong_formula("if(x > 0, 1, 2)"), "there is no function 'if'; that is written c ? a : b");
    EXPECT_EQ(wrong_formula("round(x)"), "there is no function 'round'; that is written floor(x + 0.5)");
    EXPECT_EQ(wrong_formula("cbrt(x)"), "there is no function 'cbrt'; that is written sign(x)*abs(x)^(1/3)");
    EXPECT_EQ(wrong_formula("x % 2"), "expected an operator at character 3, got % 2; that is written mod(a, b)");
    EXPECT_EQ(wrong_formula("x and 2"), "expected an operator at character 3, got and 2; that is written a && b");
    EXPECT_EQ(wrong_formula("x = 2"), "expected an operator at character 3, got = 2; that is written a == b");
    EXPECT_EQ(wrong_formula("x order"), "expected an operator at character 3, got order");
    EXPECT_EQ(wrong_formula("e^2"), "there is no 'e' here; that is written exp(1)");
    EXPECT_EQ(wrong_formula("2*PI"), "there is no 'PI' here; did you mean 'pi'?");
}

TEST(Mistakes, ACoordinateOfABodyWithoutANameWasNothing) {
    World world;
    world.add(Body{});
    EXPECT_EQ(error_of([&] { Quantity("2*x", world); }),
              "in \"2*x\": there is no 'x'; it is of a body, which needs a \"name\": of one that is called ball it is "
              "ball.x");
}

TEST(Mistakes, PartsOfAListThatThereIsNotMadeItAnObject) {
    const auto set = [](const std::string& scene, const std::string& name) {
        return error_of([&] { Scene::parse("{\"carom\": 1" + scene + "}", "f").set(name, "3"); });
    };
    const std::string no_bodies = " cannot be set: the scene has no \"bodies\"";
    EXPECT_EQ(set("", "bodies[99].mass"), "f: \"bodies[99].mass\"" + no_bodies);
    EXPECT_EQ(set(R"(, "builders": [])", "bodies.a.mass"),
              "f: \"bodies.a.mass\"" + no_bodies + "; what its bodies have in common its \"builders\" say");
    EXPECT_EQ(set("", "walls[0].low"), "f: \"walls[0].low\" cannot be set: the scene has no \"walls\"");
}

TEST(Mistakes, APotentialWithoutAForceWasTakenForABookkeeperOfNothing) {
    EXPECT_EQ(refused(R"("bodies": [{}], "forces": [{"type": "field", "potential": "x^2"}])"),
              "f: forces[0] must have the field \"x\" or \"y\": the force, which is not made from its potential");
}

TEST(Mistakes, AnEmptyQuantityWasSaidToBeAbsent) {
    const auto expects = [](const std::string& fields) {
        return refused("\"expects\": [{\"value\": 1" + fields + "}]");
    };
    EXPECT_EQ(expects(R"(, "quantity": "")"), "f: expects[0].quantity must be an expression, got \"\"");
    EXPECT_EQ(expects(""), "f: expects[0] must have the field \"quantity\": what is expected to have a value");
    EXPECT_EQ(refused(R"("twins": [{"quantity": "t", "formula": " "}])"),
              "f: twins[0].formula must be an expression, got \" \"");
}

TEST(Mistakes, ALineBreakWithinATextWasToldInTheParsersWords) {
    const auto json = [](const std::string& text) { return error_of([&] { parse_json(text, "f"); }); };
    const std::string line = "a text ends on its line, with a \"; a line break within one is written \\n";
    EXPECT_EQ(json("{\"title\": \"a\nb\"}"), "f:1:13: " + line);
    EXPECT_EQ(json("{\"title\": \"a,\r\n\"b\": 1}"), "f:1:14: " + line);
    EXPECT_EQ(json("{\"title\": \"a\tb\"}"), "f:1:13: a tab within a text is written \\t");
}

TEST(Mistakes, ColoursThatEverybodyKnowsWereRefused) {
    const auto read = [](const std::string& colour) {
        const World world = Scene::parse(R"({"carom": 1, "bodies": [{"colour": ")" + colour + "\"}]}", "f").world();
        return *world.body(world.ids()[0]).colour;
    };
    EXPECT_EQ(read("red"), (Colour{255, 0, 0, 255}));
    EXPECT_EQ(read("grey"), read("#808080"));
    EXPECT_EQ(read("#0af"), read("#00aaff"));
    EXPECT_EQ(read("#0AF8"), read("#00aaff88"));
    EXPECT_EQ(refused(R"("bodies": [{"colour": "#0000a"}])").substr(0, 36), "f: bodies[0].colour must be a colour");
    EXPECT_EQ(refused(R"("bodies": [{"colour": ""}])").substr(0, 36), "f: bodies[0].colour must be a colour");
}

TEST(Mistakes, PowersAndProductsOfOtherLanguages) {
    EXPECT_EQ(wrong_formula("2**3"), "a power is written a^b, and not a**b");
    EXPECT_EQ(wrong_formula("2 sin(30)"),
              "expected an operator at character 3, got sin(30); did you mean '2*sin(30)'?");
    EXPECT_EQ(wrong_formula("(2pi)"), "expected ) at character 3, got pi); did you mean '(2*pi)'?");
    EXPECT_EQ(wrong_formula("2(x + 1)"), "expected an operator at character 2, got (x + 1); did you mean '2*(x + 1)'?");
    EXPECT_EQ(wrong_formula("(x)(x)"), "expected an operator at character 4, got (x); did you mean '(x)*(x)'?");
    EXPECT_EQ(wrong_formula("x(x + 1)"), "there is no function 'x'; did you mean 'x*('?");
    EXPECT_EQ(wrong_formula("1 2"), "expected an operator at character 3, got 2");
    EXPECT_EQ(wrong_formula("2 x"), "expected an operator at character 3, got x; did you mean '2*x'?");
    EXPECT_EQ(wrong_formula("x y"), "expected an operator at character 3, got y");
    EXPECT_EQ(wrong_formula("2 * * 3"), "expected a number, a name or ( at character 5, got * 3");
}

TEST(Mistakes, DegreesAndUnitsWithinFormulasWereSaidToLackAnOperator) {
    const auto asks = [](const std::string& formula, const std::string& helps) {
        EXPECT_TRUE(wrong_formula(formula).ends_with("; " + helps)) << wrong_formula(formula);
    };
    asks("sin(30 deg)", "did you mean 'sin(30*deg)'?");
    asks("30deg+x", "did you mean '30*deg+x'?");
    asks("90 deg", "angles are in rad, and so many degrees are 90*deg");
    asks("5 N", "numbers are in SI units, which are not written");
    // What a name means goes before what it may be a unit of.
    EXPECT_TRUE(error_of([] { Function("2 m", {"m"}, {}); }).ends_with("; did you mean '2*m'?"));
}

}  // namespace
