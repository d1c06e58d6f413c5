// A disc that fell back at the very rim between two cells of the exact gas went to and fro between them in no time: the
// time that it needed to turn back was less than the rounding of the clock. The run ended with "the gas is jammed".
#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom::test {
namespace {

TEST(ExactGas, ADiscThatTurnsBackAtTheRimOfACellGoesOn) {
    constexpr double r = 0.004, width = 0.2;
    World world({.gravity = {0, -1}, .solver = Events{}});
    world.add(HalfPlane{});
    world.add(HalfPlane{.normal = {1, 0}});
    world.add(HalfPlane{.point = {width, 0}, .normal = {-1, 0}});
    for (int k = 0; k < 5; ++k) world.add(Body{.position = {0.03 + 0.035 * k, 0.1 + 0.05 * k + r}, .radius = r});
    world.set_velocity(world.ids()[0], {1e-3, 0}, 0);
    for (int k = 0; k < 40; ++k) world.step(0.5);
    double sum = 0;
    for (std::size_t i = 0; i < 5; ++i)
        sum += world.positions()[i].y - r + 0.5 * dot(world.velocities()[i], world.velocities()[i]);
    EXPECT_NEAR(sum, 1 + 0.5e-6, 1e-12);  // what they had at first: E = 1, and the one that was pushed
}

}  // namespace
}  // namespace carom::test
