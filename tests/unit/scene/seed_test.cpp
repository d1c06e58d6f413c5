// One seed is behind all random numbers of a scene.

#include <gtest/gtest.h>

#include <carom/analysis.hpp>
#include <carom/scene.hpp>

namespace carom {
namespace {

/// The state of two discs after some hundred blows of warm walls.
std::uint64_t end_of(const std::string& solver, int seed) {
    Scene scene = Scene::parse(R"({"carom": 1, "world": {"solver": )" + solver + R"(},
        "walls": [{"type": "rectangle", "low": [0, 0], "high": [2, 2],
                   "left": {"temperature": 1}, "right": {"temperature": 2}}],
        "bodies": [{"position": [1, 1], "velocity": [1, 0.3], "radius": 0.1},
                   {"position": [1.5, 0.5], "velocity": [-1, 0.3], "radius": 0.1}]})");
    scene.set("seed", std::to_string(seed));
    World world = scene.world();
    world.step(20);
    return state_hash(world);
}

// Seeds 1, 2 and 3 were one run three times: a mean over seeds had an error of which nobody knew.
TEST(Seed, OfTheSceneReachesThermalWalls) {
    for (const char* solver : {R"("events")", R"({"method": "events", "substeps": 2})"}) {
        EXPECT_NE(end_of(solver, 1), end_of(solver, 2)) << solver;
        EXPECT_NE(end_of(solver, 2), end_of(solver, 3)) << solver;
    }
    const char* own = R"({"method": "events", "seed": 3})";
    EXPECT_EQ(end_of(own, 1), end_of(own, 2));
    EXPECT_EQ(end_of(own, 1), end_of(R"("events")", 3));
}

}  // namespace
}  // namespace carom
