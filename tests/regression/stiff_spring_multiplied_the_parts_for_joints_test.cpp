// Where a stiff spring or strong drag had the step cut into many substeps, each of them was cut into eight more parts
// for a joint that turned, however far away: 0.4 s for a step of 25 bodies, and 9 times the work of the same world at
// rest.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

constexpr double dt = 1.0 / 60;

/// A disc that whirls on a hinge of the ground, perhaps beside a stiff spring, and how often forces were asked for.
struct Whirling {
    World world{{.solver = SoftStep{.sleep = false, .statics = false}}};
    BodyId disc;
    int asked = 0;

    Whirling(double spin, double stiffness) {
        disc = world.add(Body{.velocity = {0, -spin}, .angular_velocity = spin, .mass = 1, .radius = 0.5});
        world.add(Joint{.b = disc, .at = Vec2{1, 0}, .type = RevoluteJoint{}});
        const BodyId wall = world.add(Body{.kind = Kind::fixed, .position = {10, 0}});
        const BodyId bob = world.add(Body{.position = {11, 0}});
        world.add(Spring{.a = wall, .b = bob, .stiffness = stiffness, .rest_length = 1});
        world.add(ForceField{.name = "counter", .body = disc, .force = [this](Vec2, Vec2, double, double) {
                                 ++asked;
                                 return Vec2{};
                             }});
    }
    Whirling(const Whirling&) = delete;
    Whirling& operator=(const Whirling&) = delete;

    int asked_in_a_step() {
        const int before = asked;
        world.step(dt);
        return asked - before;
    }
    double energy_kept() {
        const Energy start = energy(world);
        for (int i = 0; i < 60; ++i) world.step(dt);
        const Energy end = energy(world);
        return (end.kinetic + end.rotational) / (start.kinetic + start.rotational);
    }
};

// A spring of 2e4 rad/s has the step cut into substeps of at most 0.9 * 2/2e4 s = 9e-5 s, a fortieth of the usual ones
// and less than an eighth.
constexpr double stiff = 4e8;

TEST(StiffSpring, IsNotMultipliedByJoints) {
    const int usual = Whirling(0, stiff).asked_in_a_step();
    EXPECT_GT(usual, 4 * 40);
    constexpr double spin = 1e5;  // [rad/s]: 9 rad in such a substep, of which 0.75 are too many
    EXPECT_EQ(Whirling(spin, stiff).asked_in_a_step(), usual);
}

TEST(StiffSpring, LeavesWhatWhirlsAsGoodAsItWasWithout) {
    constexpr double spin = 600;  // [rad/s]: cut into eight without the spring, and not at all beside it
    const double without = Whirling(spin, 0).energy_kept(), beside = Whirling(spin, stiff).energy_kept();
    EXPECT_LE(std::abs(beside - 1), std::abs(without - 1) + 1e-12);  // rounding in 10 000 substeps
}

}  // namespace
}  // namespace carom
