// A crate of a ton on a box of 1 kg, or a tower whose boxes grow, is not jammed because a bob hangs on it by a hinge:
// when forces were held against the little energy that lies still, such islands were left to sweeps, the crate sank in
// by 8 cm and the tower fell over.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <vector>

namespace carom {
namespace {

/// How far the topmost box of a pile, on which a bob hangs, is from where it was put at the end [m].
double sunk(const std::vector<double>& masses, Precise precise) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{.precise = precise, .sleep = false, .statics = false}});
    world.add(HalfPlane{.side = {0, 0.6, {}}});
    BodyId top{};
    double height = 0.5;
    for (const double mass : masses) {
        top = world.add(Body{.position = {0, height},
                             .mass = mass,
                             .shapes = {{.geometry = Box{1, 1}}},
                             .restitution = 0,
                             .friction = 0.6});
        height += 1;
    }
    const Vec2 hook = world.position(top) + Vec2{0, 0.5};
    const BodyId bob = world.add(Body{.position = hook + Vec2{0, 0.5}, .mass = 0.1, .radius = 0.05});
    world.add(Joint{.a = top, .b = bob, .at = hook, .type = RevoluteJoint{}});
    const Vec2 put = world.position(top);
    for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
    return length(world.position(top) - put);
}

TEST(HeavyLoad, BesideAJointStaysWhereItIsPut) {
    std::vector<double> tower{1};
    while (tower.size() < 10) tower.push_back(1.63 * tower.back());
    // Precise solves leave a micrometre; sweeps leave centimetres.
    EXPECT_LE(sunk({1, 1000}, Precise::some), 1e-5);
    EXPECT_LE(sunk({1, 3000}, Precise::some), 1e-5);
    EXPECT_LE(sunk(tower, Precise::all), 1e-5);
}

}  // namespace
}  // namespace carom
