// A scene file that ended within a comment made the program end without a word, where the error's place was worked out.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/scene.hpp>
#include <string>

namespace carom {
namespace {

TEST(Regression, UnfinishedTextEndedTheProgram) {
    // Found by the fuzzer; every beginning of a scene is one that was cut off.
    const std::string scene = R"({"carom": 1, "title": "a\u0041\n", /* x */ "run": {"duration": 1e-11, "step": nan}})";
    for (std::size_t end = 0; end < scene.size(); ++end) {
        for (const char* tail : {"", "\n", "\"", "\xc3", "\\", "//", "/*"})
            EXPECT_THROW(Scene::parse(scene.substr(0, end) + tail), Error) << end;
    }
}

}  // namespace
}  // namespace carom
