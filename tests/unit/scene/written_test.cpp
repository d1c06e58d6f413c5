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

TEST(Written, MassBesideADensityWasPassedOver) {
    const auto body = [](const std::string& fields, const std::string& shape) {
        return R"("bodies": [{"name": "b")" + fields + R"(, "shapes": [{"type": "box", "width": 2, "height": 3)" +
               shape + "}]}]";
    };
    const std::string heavy = R"(, "mass": 100)", dense = R"(, "density": 2)", fixed = R"(, "kind": "fixed")";
    EXPECT_EQ(complaint_of(body(heavy, dense)),
              "f: bodies[0].mass must be absent beside a density, which makes it 12 kg, got 100");
    EXPECT_EQ(written(body("", dense)).world().masses()[0], 12);
    EXPECT_EQ(written(body(heavy, "")).world().masses()[0], 100);
    EXPECT_EQ(written(body(R"(, "mass": "2*6")", dense)).world().masses()[0], 12);  // as saved scenes have it
    EXPECT_EQ(written(body(heavy + fixed, dense)).world().masses()[0], 100);        // what attracts
    EXPECT_EQ(complaint_of(R"("builders": [{"type": "grid", "nx": 2, "ny": 2, "body": {"mass": 3,
                           "shapes": [{"type": "box", "density": 2}]}}])"),
              "f: builders[0].body.mass must be absent beside a density, which makes it 2 kg, got 3");
    const std::string fill = R"("fill": {"count": 3, "high": [9, 9], "density": 2, "body": {"mass": 3}})";
    EXPECT_TRUE(complaint_of("\"builders\": [{\"type\": \"gas\", " + fill + "}]")
                    .starts_with("f: builders[0].fill.body.mass must be absent beside a density, which makes it "));
    const Scene saved = Scene::of(written(body("", dense)).world());
    EXPECT_EQ(Scene::of(Scene::parse(saved.text()).world()).text(), saved.text());
}

}  // namespace
