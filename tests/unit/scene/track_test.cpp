// A curve that a scene writes as expressions is a chain.

#include <gtest/gtest.h>

#include <carom/scene.hpp>
#include <cmath>

#include "error_of.hpp"

namespace carom {
namespace {

World world_with(const std::string& track) {
    return Scene::parse(R"({"carom": 1, "parameters": {"R": 2}, "world": {"gravity": [0, -9.81]},
        "builders": [{"type": "track", )" +
                            track + R"(}], "bodies": [{"name": "ball", "position": [0, 5], "radius": 0.1}]})",
                        "f")
        .world();
}
const Chain& chain_of(const World& world) { return std::get<Chain>(world.shapes()[1][0].geometry); }

TEST(Tracks, GoWhereTheirExpressionsSay) {
    const World world = world_with(R"-("x": "R*cos(s)", "y": "R*sin(s)", "from": "-pi", "to": 0, "segments": 4, "body":
                      {"name": "bowl", "position": [1, 3], "friction": 0.2})-");
    EXPECT_EQ(world.size(), 2u);
    EXPECT_EQ(world.kinds()[1], Kind::fixed);
    const BodyId bowl = world.find("bowl");
    EXPECT_EQ(world.position(bowl), (Vec2{1, 3}));
    EXPECT_EQ(world.body(bowl).friction, 0.2);
    const Chain& chain = chain_of(world);
    ASSERT_EQ(chain.points.size(), 5u);
    for (int k = 0; k < 5; ++k) {
        const double angle = -std::acos(-1.0) * (1 - k / 4.0);
        EXPECT_NEAR(chain.points[static_cast<std::size_t>(k)].x, 2 * std::cos(angle), 1e-15);  // rounding
        EXPECT_NEAR(chain.points[static_cast<std::size_t>(k)].y, 2 * std::sin(angle), 1e-15);
    }
    EXPECT_TRUE(std::holds_alternative<SoftStep>(world.settings().solver));  // whatever has shapes needs it
}

TEST(Tracks, ThatAreClosedEndWhereTheyBegin) {
    const World world = world_with(R"-("x": "cos(s)", "y": "-sin(s)", "to": "2*pi", "segments": 6, "closed": true)-");
    EXPECT_TRUE(chain_of(world).closed);
    EXPECT_EQ(chain_of(world).points.size(), 6u);
}

TEST(Tracks, SayWhatIsWrongWithThem) {
    const auto complaint = [](const std::string& track) { return test::error_of([&] { world_with(track); }); };
    EXPECT_EQ(complaint(R"-("y": "log(s)")-"),
              "f: builders[0].y must be a finite number in m all along, got \"log(s)\": it is -inf at s = 0");
    EXPECT_EQ(complaint(R"-("y": "t")-"),
              "f: builders[0].y must be an expression of s and the parameters, got \"t\": there is no 't' here");
    EXPECT_EQ(complaint(R"-("body": {"kind": "dynamic"})-"),
              "f: builders[0].body.kind must be fixed or driven, for a curve has no mass, got \"dynamic\"");
    EXPECT_EQ(complaint(R"-("segments": 1, "closed": true)-"),
              "f: builders[0].segments must be 2 lines or more, for a curve that is closed, got 1");
    EXPECT_EQ(complaint(R"-("x": "0", "segments": 4)-"),
              "f: builders[0] must lead on, and does not before s = 0.25: it is at (0, 0) m again");
}

}  // namespace
}  // namespace carom
