// In a world of more than 63 bodies without any contact the first one that was found in the midst of a step was written
// to rows that were never made: World::step crashed.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

/// A box beside a disc, and discs far away; what pulls the box moves it farther in a step than was foreseen.
struct Scene {
    World world{{.gravity = {0, -9.81}, .solver = SoftStep{}}};
    BodyId box = world.add(Body{.position = {0, 0}, .shapes = {{.geometry = Box{0.7, 0.4}}}});

    Scene() {
        world.add(Body{.position = {0.95, 0}, .radius = 0.3});
        for (int i = 0; i < 62; ++i) world.add(Body{.position = {1000 + 3.0 * i, 0}, .radius = 0.3});
    }
    /// Whether the disc is struck.
    bool strikes() {
        std::size_t impacts = 0;
        for (int i = 0; i < 3; ++i) world.step(1.0 / 60), impacts += world.events().impacts.size();
        return impacts > 0;
    }
};

TEST(FirstContactInMidstep, OfABodyOnAHandleIsSolved) {
    Scene scene;
    scene.world.add(Joint{.b = scene.box, .anchor_a = {9, 0.2}, .type = DragHandle{}});
    EXPECT_TRUE(scene.strikes());
    EXPECT_NEAR(energy(scene.world).unaccounted(), 0, 1e-9 * std::abs(energy(scene.world).initial_total));
}

TEST(FirstContactInMidstep, OfABodyOnASpringIsSolved) {
    Scene scene;
    const BodyId nail = scene.world.add(Body{.kind = Kind::fixed, .position = {9, 0.2}});
    scene.world.add(Spring{.a = nail, .b = scene.box, .stiffness = 900});
    EXPECT_TRUE(scene.strikes());
    EXPECT_NEAR(energy(scene.world).unaccounted(), 0, 1e-9 * std::abs(energy(scene.world).initial_total));
}

}  // namespace
}  // namespace carom
