// The stable step that a study went by was that of a substep, while a step of SoftStep has several: the first run went
// at the step, the second at a half of a part of it. Of a method of second order it found the order 4.32, 5.00 or 6.24,
// and named parts into which no step was cut.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/convergence.hpp>
#include <cmath>

namespace carom {
namespace {

/// An oscillator beside a stiff pair at rest.
World beside_a_stiff_pair(double stiffness, const Solver& solver) {
    World world({.solver = solver});
    const BodyId wall = world.add(Body{.kind = Kind::fixed}), bob = world.add(Body{.position = {1, 0}, .name = "bob"});
    world.add(Spring{.a = wall, .b = bob, .stiffness = 9});
    const BodyId a = world.add(Body{.position = {10, 0}}), b = world.add(Body{.position = {11, 0}});
    world.add(Spring{.a = a, .b = b, .stiffness = stiffness, .rest_length = 1});
    return world;
}

TEST(Regression, StudyUnderSoftStepFoundAWrongOrder) {
    for (const double stiffness : {2e4, 1e5, 2e6}) {
        const World world = beside_a_stiff_pair(stiffness, SoftStep{});
        const Convergence c = study(world, {}, {.duration = 2, .step = 1.0 / 60});
        ASSERT_TRUE(c.state.order) << stiffness;
        EXPECT_NEAR(*c.state.order, 2, 0.05) << stiffness;  // (ω h)² = 2e-3 is the next term
        // The substep is a quarter; 0.9 · 2/ω with ω² = 2 k/m.
        EXPECT_EQ(c.parts, std::ceil(1.0 / 240 / (0.9 / std::sqrt(stiffness / 2)))) << stiffness;
    }
}

TEST(Regression, StableStepIsOneThatIsNotRefused) {
    for (const Solver& solver : {Solver{NoContact{}}, Solver{SoftStep{}}, Solver{SoftStep{.substeps = 7}}}) {
        World world = beside_a_stiff_pair(2e4, solver);
        world.configure({.solver = solver, .long_step = LongStep::refuse});
        const double h = world.stable_step();
        EXPECT_NO_THROW(world.step(h));
        EXPECT_THROW(world.step(1.0001 * h), Error);
    }
}

TEST(Regression, TooLongAStepNamesTheForcesThatThereAre) {
    const auto error = [](World world) -> std::string {
        world.configure({.solver = NoContact{}, .long_step = LongStep::refuse});
        try {
            world.step(1e3);
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    };
    World soft;
    soft.add(Body{.radius = 1}), soft.add(Body{.position = {2, 0}, .radius = 1});
    soft.add(SoftDiscs{});
    EXPECT_NE(error(soft).find("for the soft discs to be"), std::string::npos) << error(soft);
    soft.add(Drag{.linear = 1});
    EXPECT_NE(error(soft).find("for drag and soft discs to be"), std::string::npos) << error(soft);
}

}  // namespace
}  // namespace carom
