// A study said "refine it" of where a stack comes to stand, which was right to 4e-5 of the way it settles: without a
// reference, whatever the method had made or lost of the energy was held against all that is judged. But the finer runs
// lose less and less, and their heights agree.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/convergence.hpp>

namespace carom {
namespace {

TEST(Regression, CheckRefusedNumbersThatALossDidNotTouch) {
    // The first scene of docs/guide/17, a heavy box on five light ones.
    constexpr double gap = 0.001;
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{});
    for (int i = 0; i <= 5; ++i)
        world.add(Body{.position = {0, i + 0.5 + (i + 1) * gap},
                       .mass = i == 5 ? 1000.0 : 1.0,
                       .shapes = {{.geometry = Box{1, 1}}},
                       .restitution = 0,
                       .friction = 0.6});
    const BodyId top = world.ids()[5];
    const std::vector<Probe> height{{.name = "top.y", .value = [top](const World& w) { return w.position(top).y; }}};
    const Convergence c = study(world, height, {.duration = 1, .step = 1.0 / 60, .judge_state = false});
    EXPECT_EQ(c.reference, "");
    EXPECT_GT(c.made_or_lost, c.tolerance);
    EXPECT_EQ(c.trust, Trust::trust) << c.sentence();
    EXPECT_NEAR(c.quantities[0].value, 5.5, 1e-6);  // as high as its boxes
}

}  // namespace
}  // namespace carom
