#include "scene/json.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "error_of.hpp"

namespace {

using namespace carom;

std::string syntax_error(const std::string& text) {
    return test::error_of([&] { parse_json(text, "f"); });
}

TEST(Json, MistakesHaveLineAndColumn) {
    EXPECT_EQ(syntax_error("{\"a\": 1,\n \"b\" 2}"), "f:2:5: a colon is missing after \"b\"");
    EXPECT_EQ(syntax_error("{\"a\": [1, 2"), "f:1:12: the text ends here, and a ] is missing");
    EXPECT_EQ(syntax_error("{\"a\": [1, 2]"), "f:1:13: the text ends here, and a } is missing");
    EXPECT_EQ(syntax_error("{}}"), "f:1:3: } stands behind the end");
    EXPECT_TRUE(syntax_error("x").starts_with("f:1:1: syntax error while parsing value - invalid literal"));
}

// It was said where reading stopped, which is a line or more behind a comma that is missing.
TEST(Json, MistakesAreSaidInThePersonsWords) {
    EXPECT_EQ(syntax_error("{\"a\": 1\n \"b\": 2}"), "f:1:8: a comma is missing after 1");
    EXPECT_EQ(syntax_error("{\"a\": {} // so\n\n \"b\": 2}"), "f:1:9: a comma is missing after }");
    EXPECT_EQ(syntax_error("[1 2]"), "f:1:3: a comma is missing after 1");
    EXPECT_EQ(syntax_error("[{}\n{}]"), "f:1:4: a comma is missing after }");
    EXPECT_EQ(syntax_error("{\"a\": [1, 2,\n]}"), "f:1:12: nothing stands between this comma and ]");
    EXPECT_EQ(syntax_error("{\"a\": 1,}"), "f:1:8: nothing stands between this comma and }");
    EXPECT_EQ(syntax_error("{\"a\": +1}"), "f:1:7: a number has no + before it");
    EXPECT_EQ(syntax_error("{\"a\": .5}"), "f:1:7: a number begins with a digit, as 0.5 does");
    EXPECT_EQ(syntax_error("{\"a\": 2,5}"), "f:1:8: a number has a point and no comma");
    EXPECT_EQ(syntax_error("{“a”: 1}"), "f:1:2: texts stand in quotes like \"these\", and not in “");
    EXPECT_EQ(syntax_error("{'a': 1}"), "f:1:2: texts stand in quotes like \"these\", and not in '");
}

// A comma was missing in 1/60 and in 5 kg, and of the rest was said what nlohmann's parser says.
TEST(Json, WhatHasToStandInQuotesWasCalledALiteralOrAMissingComma) {
    EXPECT_EQ(syntax_error("{\"a\": 1/60}"), "f:1:7: an expression stands in quotes, like \"1/60\"");
    EXPECT_EQ(syntax_error("{\"a\": sqrt(2)}"), "f:1:7: texts and expressions stand in quotes, like \"sqrt(2)\"");
    EXPECT_EQ(syntax_error("{\"a\": 2*pi}"), "f:1:7: an expression stands in quotes, like \"2*pi\"");
    EXPECT_EQ(syntax_error("{\"a\": 5 kg}"),
              "f:1:8: a comma is missing after 5; numbers are in SI units, which are not written");
    EXPECT_EQ(syntax_error("{a: 1}"), "f:1:2: a name stands in quotes, like \"a\"");
    EXPECT_EQ(syntax_error("{\"a\": True}"), "f:1:7: true and false have small letters");
    EXPECT_EQ(syntax_error("{\"a\": 1, # one\n \"b\": 2}"), "f:1:10: a comment begins with //");
}

TEST(Json, NumbersMustBeFinite) {
    EXPECT_EQ(syntax_error("[NaN]"), "f:1:2: numbers are finite here, and NaN is none");
    EXPECT_EQ(syntax_error("[Infinity]"), "f:1:2: numbers are finite here, and Infinity is none");
    EXPECT_EQ(syntax_error("[-Infinity]"), "f:1:3: numbers are finite here, and Infinity is none");
    EXPECT_EQ(syntax_error("[1, 1e999]"), "f:1:9: the number is too large: '1e999'");
}

TEST(Json, AKeyTwiceHasItsPlace) {
    EXPECT_EQ(syntax_error(R"({"a": 1, "a": 2})"), "f: has the key \"a\" twice");
    EXPECT_EQ(syntax_error(R"({"x": [0, {"y": {"a": 1, "a": 2}}]})"), "f: x[1].y has the key \"a\" twice");
    EXPECT_EQ(syntax_error(R"([{"a": 1}, {"a": 1}])"), "no error");
}

TEST(Json, DepthAndWidthAreBounded) {
    EXPECT_EQ(syntax_error(std::string(100000, '[')), "f: objects and lists must be nested at most 64 deep");
    EXPECT_EQ(syntax_error(std::string(64, '[') + std::string(64, ']')), "no error");
    std::string wide = "{\"key\": 1";
    for (int i = 0; i < 2000; ++i) wide += fmt::format(", \"{}\": 1", i);
    EXPECT_EQ(syntax_error(wide + "}"), "f: must have at most 1000 keys");
}

TEST(Json, WhatIsNoTextIsSaidToBeNone) {
    EXPECT_EQ(syntax_error(""), "f: is empty, and must be a scene");
    EXPECT_EQ(syntax_error(" \n\t"), "f: is empty, and must be a scene");
    EXPECT_EQ(syntax_error(std::string("{\0}", 3)), "f: is not a text, and must be a scene in JSON");
    EXPECT_EQ(syntax_error("\x7f\x45\xff\xfe"),
              "f:1:1: syntax error while parsing value - invalid literal; last read: ' '");
    EXPECT_NE(syntax_error("{\"a\": \"\xff\xfe\"}"), "no error");
}

TEST(Json, ErrorsAreOneShortLineOfText) {
    for (const std::string& text : std::vector<std::string>{
             "{\"" + std::string(100000, 'x'), "[" + std::string(10000, '9') + "x", std::string("{\n\n\"a\n\": }"),
             "[\"" + std::string(1000, '\xc3') + "\"]", "{\"a\x1b[31m\": "}) {
        const std::string what = syntax_error(text);
        EXPECT_LT(what.size(), 300u);
        for (const char c : what) EXPECT_TRUE(c >= 32 && c < 127) << what;
    }
}

TEST(Json, CommentsAreAllowed) { EXPECT_EQ(syntax_error("// one\n{} /* two */"), "no error"); }

TEST(Json, ShownIsOneShortLineThatCutsNoCharacter) {
    EXPECT_EQ(shown(Json("a\nb")), R"("a\nb")");
    for (std::size_t pad = 0; pad < 6; ++pad) {
        std::string text(50 + pad, 'x');
        for (int i = 0; i < 20; ++i) text += "≥";
        const std::string cut = shown(Json(text));
        EXPECT_LE(cut.size(), 60u);
        EXPECT_NO_THROW(Json(cut).dump()) << cut;  // dump throws for half of a character
    }
    EXPECT_EQ(shown(Json(std::vector<int>(1000))), "a long list");
}

TEST(Json, PrettyPutsOnOneLineWhatFits) {
    EXPECT_EQ(pretty(Json::parse(R"({"a":[1,2],"b":{}})")), "{\"a\":[1,2],\"b\":{}}\n");
    const Json list(std::vector<double>(40, 0.25));
    const std::string text = pretty(Json{{"list", list}, {"other", 1}});
    EXPECT_EQ(text.substr(0, 12), "{\n  \"list\": ");
    EXPECT_EQ(pretty(parse_json(text, "f")), text);
}

TEST(Json, NumbersKeepTheirBits) {
    for (const double x : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 1e22, 123456789012345678.0}) {
        const double back = parse_json(pretty(Json(x)), "f").get<double>();
        EXPECT_EQ(back, x);
        EXPECT_EQ(std::signbit(back), std::signbit(x));
    }
}

}  // namespace
