// What a scene says is what it gets: nothing that is written in it is passed over, and nothing that is not is made up.

#include <gtest/gtest.h>

#include <carom/scene.hpp>

#include "error_of.hpp"

namespace {

using namespace carom;

Scene written(const std::string& rest) { return Scene::parse("{\"carom\": 1, " + rest + "}", "f"); }
std::string complaint_of(const std::string& rest) {
    return test::error_of([&] { written(rest).world(); });
}

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

}  // namespace
