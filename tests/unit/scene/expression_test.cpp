#include "scene/expression.hpp"

#include <gtest/gtest.h>

#include <carom/error.hpp>
#include <cmath>
#include <thread>

#include "error_of.hpp"
#include "math/elementary.hpp"

namespace {

using namespace carom;

double value(const std::string& text) { return Function(text, {"x"}, {{"k", 2.5}})(3.0); }

std::string expression_error(const std::string& text) {
    return test::error_of([&] { value(text); });
}

TEST(Expression, FollowsTheUsualPrecedence) {
    EXPECT_EQ(value("1 + 2*3"), 7);
    EXPECT_EQ(value("(1 + 2)*3"), 9);
    EXPECT_EQ(value("8/4/2"), 1);
    EXPECT_EQ(value("1 - 2 - 3"), -4);
    EXPECT_EQ(value("2^3^2"), 512);
    EXPECT_EQ(value("-2^2"), -4);
    EXPECT_EQ(value("2^-1"), 0.5);
    EXPECT_EQ(value("- -1"), 1);
    EXPECT_EQ(value("+1"), 1);
    EXPECT_EQ(value("2*-3"), -6);
}

TEST(Expression, ComparesAndChooses) {
    EXPECT_EQ(value("x > 2 ? 10 : 20"), 10);
    EXPECT_EQ(value("x < 2 ? 10 : x == 3 ? 5 : 6"), 5);
    EXPECT_EQ(value("x >= 3 && x <= 3 && !(x != 3)"), 1);
    EXPECT_EQ(value("x > 3 || x < 3"), 0);
    EXPECT_EQ(value("1 || 0 && 0"), 1);
}

TEST(Expression, ReadsNumbersOfAllForms) {
    EXPECT_EQ(value("007"), 7);
    EXPECT_EQ(value(".5"), 0.5);
    EXPECT_EQ(value("5."), 5);
    EXPECT_EQ(value("1.25e-3"), 1.25e-3);
    EXPECT_EQ(value("1E+2"), 100);
    EXPECT_EQ(value("0.1"), 0.1);
    EXPECT_EQ(value("123456789.123456789"), 123456789.123456789);
    EXPECT_EQ(value("5e-324"), 5e-324);
    EXPECT_EQ(value("1e-400"), 0);
}

TEST(Expression, NamesMayHaveDotsBracketsAndQuotes) {
    const auto resolve = [](const std::string& name) -> Expression::Meaning {
        return name == "cloth[3][4].vx" || name == "my ball-1.x" || name == "größe" || name == "it's.x" ? 1.0 : 0.0;
    };
    EXPECT_EQ(Expression("cloth[3][4].vx", resolve)({}), 1);
    EXPECT_EQ(Expression("'my ball-1'.x", resolve)({}), 1);
    EXPECT_EQ(Expression("'my ball-1.x'", resolve)({}), 1);
    EXPECT_EQ(Expression("größe", resolve)({}), 1);
    EXPECT_EQ(Expression("'it''s'.x", resolve)({}), 1);
    EXPECT_EQ(Expression("'it'''.x", resolve)({}), 0);
    EXPECT_EQ(Expression("other", resolve)({}), 0);
}

TEST(Expression, FunctionsArePortable) {
    const std::pair<const char*, double (*)(double)> table[] = {
        {"sin", portable::sin},   {"cos", portable::cos},   {"tan", portable::tan},   {"atan", portable::atan},
        {"sinh", portable::sinh}, {"cosh", portable::cosh}, {"tanh", portable::tanh}, {"exp", portable::exp},
        {"ln", portable::log},    {"log", portable::log}};
    for (const auto& [name, function] : table) {
        const Function f(std::string(name) + "(x)", {"x"}, {});
        for (double x = 0.1; x < 20; x += 0.37) EXPECT_EQ(f(x), function(x)) << name << " of " << x;
    }
    EXPECT_EQ(value("asin(0.3)"), portable::asin(0.3));
    EXPECT_EQ(value("acos(0.3)"), portable::acos(0.3));
    EXPECT_EQ(value("atan2(x, k)"), portable::atan2(3, 2.5));
    EXPECT_EQ(value("hypot(x, 4)"), 5);
    EXPECT_EQ(value("pow(x, 2.7)"), portable::pow(3, 2.7));
    EXPECT_EQ(value("x^2.7"), portable::pow(3, 2.7));
    EXPECT_EQ(value("0.1^2"), 0.1 * 0.1);
    EXPECT_EQ(value("min(3, 1, 2)"), 1);
    EXPECT_EQ(value("max(3, 1, 2)"), 3);
    EXPECT_EQ(value("floor(-0.5) + ceil(0.5) + abs(-2) + sign(-3) + sqrt(16)"), -1 + 1 + 2 - 1 + 4);
    EXPECT_EQ(value("sin(30*deg)"), portable::sin(30 * 3.14159265358979323846 / 180));
    EXPECT_EQ(value("pi"), 3.14159265358979323846);
}

// There was none: `a - b*floor(a/b)` was to be written, which is b and not 0 where a/b is rounded up to a whole number.
TEST(Expression, ThereWasNoModulus) {
    const Function mod("mod(a, b)", {"a", "b"}, {});
    EXPECT_EQ(mod(7.0, 3.0), 1);
    EXPECT_EQ(mod(-7.0, 3.0), 2);
    EXPECT_EQ(mod(7.0, -3.0), -2);
    EXPECT_EQ(mod(-7.0, -3.0), -1);
    EXPECT_EQ(mod(5.5, 0.25), 0);
    EXPECT_EQ(mod(2.0, 3.0), 2);
    EXPECT_TRUE(std::isnan(mod(1.0, 0.0)));
    EXPECT_TRUE(std::isnan(mod(INFINITY, 1.0)));
    EXPECT_EQ(mod(5.0, INFINITY), 5);
    EXPECT_EQ(mod(-5.0, INFINITY), INFINITY);
    std::uint64_t seed = 1;
    const auto next = [&seed] { return seed = seed * 6364136223846793005u + 1442695040888963407u; };
    for (int k = 0; k < 100000; ++k) {  // fmod is exact: to 2^2098 times as much
        const double a = std::bit_cast<double>(next()), b = std::bit_cast<double>(k % 2 ? next() : next() % 100000);
        if (!std::isfinite(a) || !std::isfinite(b) || b == 0) continue;
        const double rest = std::fmod(std::abs(a), std::abs(b));
        const double floored = rest != 0 && std::signbit(a) != std::signbit(b) ? std::abs(b) - rest : rest;
        ASSERT_EQ(mod(a, b), std::copysign(floored, b)) << a << " by " << b;
    }
    EXPECT_EQ(expression_error("mod(1)"), "'mod' takes two numbers, got 1");
    EXPECT_EQ(expression_error("fmod(1, 2)"),
              "there is no function 'fmod'; that is written sign(a)*mod(abs(a), abs(b)), or mod(a, b)");
}

TEST(Expression, DivisionByZeroIsNoError) {
    EXPECT_TRUE(std::isinf(value("1/0")));
    EXPECT_TRUE(std::isnan(value("0/0")));
    EXPECT_TRUE(std::isnan(value("sqrt(-1)")));
}

TEST(Expression, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(expression_error("1 + * 2"), "expected a number, a name or ( at character 5, got * 2");
    EXPECT_EQ(expression_error("1 + "), "expected a number, a name or (, and there it ends");
    EXPECT_EQ(expression_error(""), "expected a number, a name or (, and there it ends");
    EXPECT_EQ(expression_error("(1 + 2"), "expected ), and there it ends");
    EXPECT_EQ(expression_error("2,5"), "a number has a point and no comma at character 2, got ,5");
    EXPECT_EQ(expression_error("1 2"), "expected an operator at character 3, got 2");
    EXPECT_EQ(expression_error("sin(1, 2)"), "'sin' takes one number, got 2");
    EXPECT_EQ(expression_error("atan2(1)"), "'atan2' takes two numbers, got 1");
    EXPECT_EQ(expression_error("min(1)"), "'min' takes two numbers or more, got 1");
    EXPECT_EQ(expression_error("sine(1)"), "there is no function 'sine'; did you mean 'sin'?");
    EXPECT_EQ(expression_error("sin + 1"), "'sin' is a function and needs (");
    EXPECT_EQ(expression_error("kk"), "there is no 'kk' here; did you mean 'k'?");
    EXPECT_EQ(expression_error("1e999"), "the number 1e999 is too large");
    EXPECT_EQ(expression_error("1e+"), "expected the digits of an exponent after this at character 2, got e+");
    EXPECT_EQ(expression_error("'ball"), "expected another ' after this one at character 1, got 'ball");
    EXPECT_EQ(expression_error("1 < 2 < 3"),
              "a comparison has two sides; join two with && before this at character 9, got 3");
}

TEST(Expression, HasNoAssignmentsAndNoLists) {
    EXPECT_NE(expression_error("k = 3"), "no error");
    EXPECT_NE(expression_error("1, 2"), "no error");
    EXPECT_NE(expression_error("\"text\""), "no error");
}

TEST(Expression, IsBoundedInDepthAndLength) {
    EXPECT_EQ(expression_error(std::string(1000, '(') + "1" + std::string(1000, ')')), "it is nested too deeply");
    EXPECT_EQ(expression_error(std::string(1000, '-') + "1"), "it is nested too deeply");
    EXPECT_EQ(expression_error(std::string(5000, '1')), "an expression must be at most 4096 characters long");
    std::string tower = "1";
    for (int i = 0; i < 200; ++i) tower += "^1";
    EXPECT_EQ(expression_error(tower), "it is nested too deeply");
    std::string sum = "1", choices = "1";
    for (int i = 0; i < 1000; ++i) sum += "+1";
    EXPECT_EQ(value(sum), 1001);
    for (int i = 0; i < 200; ++i) choices += "?1:1";
    EXPECT_EQ(expression_error(choices), "it is nested too deeply");
}

TEST(Expression, AVariableAndAParameterOfOneNameAreAnError) {
    EXPECT_THROW(Function("m", {"m"}, {{"m", 1}}), Error);
    EXPECT_NO_THROW(Function("1", {"m"}, {{"m", 1}}));
}

TEST(Expression, ACopyLivesOnItsOwnAndThreadsShareOne) {
    auto first = std::make_unique<Function>("x*x + k", std::vector<std::string>{"x"}, Function::Constants{{"k", 1}});
    const Function copy = *first;
    first.reset();
    EXPECT_EQ(copy(3.0), 10);
    bool right[2] = {true, true};
    const auto work = [&](int which) {
        for (int i = 0; i < 20000; ++i)
            right[which] = right[which] && copy(i + 0.5 * which) == (i + 0.5 * which) * (i + 0.5 * which) + 1;
    };
    std::thread other(work, 1);
    work(0);
    other.join();
    EXPECT_TRUE(right[0] && right[1]);
}

}  // namespace
