// A study said "trust it" of the heat of a stack's impacts that was 13 times farther off than it allowed: where
// contacts are solved in parts of the step its reference took the steps of the finest run, was that run, and agreed
// with it. The 0.8 J that were missing stood in the ledger. Where that was held against all that is judged, a study
// said "refine it" of where the stack comes to stand, which was right to 4e-5 of the way it settles: finer runs lose
// less and less, and their heights agree.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/convergence.hpp>
#include <cmath>

namespace carom {
namespace {

/// A heavy box on five light ones, each a hair above the one below: docs/guide/17.
World stack() {
    constexpr double gap = 0.001;
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{});
    for (int i = 0; i <= 5; ++i)
        world.add(Body{.position = {0, i + 0.5 + (i + 1) * gap},
                       .mass = i == 5 ? 1000.0 : 1.0,
                       .shapes = {{.geometry = Box{1, 1}}},
                       .restitution = 0,
                       .friction = 0.6});
    return world;
}

const std::vector<Probe> heat{
    {.name = "heat", .value = [](const World& w) { return energy(w).heat.impact; }, .is_account = true}};

TEST(Regression, CheckTrustedRunsThatLostAlike) {
    const World world = stack();
    const double exact = energy(world).gravity - 9.81 * (0.5 + 1.5 + 2.5 + 3.5 + 4.5 + 1000 * 5.5);
    const StudyPlan plan{.duration = 0.25, .step = 1.0 / 120, .judge_state = false};
    const Convergence c = study(world, heat, plan);
    EXPECT_GT(std::abs(c.quantities[0].value - exact), 10 * plan.tolerance * exact);
    EXPECT_EQ(c.trust, Trust::refine) << c.sentence();
    EXPECT_EQ(c.reference, "");
    EXPECT_NE(c.sentence().find("made or lost 0.013 of the energies at play"), std::string::npos) << c.sentence();
    // What it names is what a study with that would trust, and rightly.
    ASSERT_TRUE(c.refined_was_run);
    StudyPlan fine = plan;
    fine.step = *c.refined;
    const Convergence again = study(world, heat, fine);
    EXPECT_EQ(again.trust, Trust::trust) << again.sentence();
    EXPECT_NEAR(again.quantities[0].value, exact, plan.tolerance * exact);
}

TEST(Regression, CheckRefusedNumbersThatALossDidNotTouch) {
    const World world = stack();
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
