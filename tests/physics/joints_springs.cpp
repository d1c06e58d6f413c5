// Springs in joints, of any stiffness and damping, between bodies of any mass.

#include <array>

#include "joints.hpp"

namespace carom {
namespace {

using namespace test;

/// Five boxes welded by springs, from the ground on or in free flight, that spin and are thrown apart.
World whirling(bool held, double stiffness, double damping, const std::array<double, 5>& masses) {
    World world = mechanism_world();
    std::optional<BodyId> last;
    for (std::size_t i = 0; i < masses.size(); ++i) {
        const double x = 0.5 * static_cast<double>(i), m = masses[i];
        const BodyId next = world.add(Body{.position = {x, 0},
                                           .velocity = {0, 4 * x},
                                           .angular_velocity = i == 2 ? 1.0 : 4.0,
                                           .mass = m,
                                           .moment_of_inertia = m / 24});
        const JointSpring spring{.stiffness = stiffness, .damping = damping};
        if (held || last)
            world.add(Joint{.a = last, .b = next, .at = Vec2{x - 0.25, 0}, .type = WeldJoint{.spring = spring}});
        last = next;
    }
    return world;
}

class SprungWelds : public testing::TestWithParam<std::tuple<bool, std::array<double, 5>>> {};
INSTANTIATE_TEST_SUITE_P(Masses, SprungWelds,
                         testing::Combine(testing::Bool(), testing::Values(std::array<double, 5>{1, 1, 1, 1, 1},
                                                                           std::array<double, 5>{1, 100, 1, 100, 1},
                                                                           std::array<double, 5>{1, 1, 1, 1, 1e4})));

/// A substep may make a thousandth before it is taken back, and a method that neither makes nor loses energy shows some
/// that comes and goes: what is above the least so far stays below a hundredth of what there is.
TEST_P(SprungWelds, NeverGainEnergy) {
    const auto [held, masses] = GetParam();
    for (const double stiffness : {0.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8, 1e10})
        for (const double damping : {0.0, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
            World world = whirling(held, stiffness, damping, masses);
            const Energy start = energy(world);
            double least = HUGE_VAL, gained = 0, there = start.kinetic + start.rotational;
            for (const double m : world.masses()) there += m * gravity * 2.25;
            watch(world, 5, [&] {
                const double total = energy(world).total();
                least = std::min(least, total), gained = std::max(gained, total - least);
            });
            EXPECT_LE(gained, 1e-2 * there) << stiffness << " N m, " << damping << " N m s";
        }
}

/// Without damping they lose nothing: of bodies that are alike not more than comes and goes.
TEST(SprungWelds, LoseNothingWithoutDamping) {
    for (const double stiffness : {1e2, 1e3, 1e4, 1e5, 1e6, 1e8, 1e10}) {
        World world = whirling(false, stiffness, 0, {1, 1, 1, 1, 1});
        run(world, frame, frame);  // they are thrown apart: what joints can not have is lost
        const double start = energy(world).total();
        watch(world, 10, [] {});
        EXPECT_NEAR(energy(world).total(), start, 1e-5 * start) << stiffness << " N m";
    }
}

}  // namespace
}  // namespace carom
