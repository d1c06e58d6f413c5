// After 512 blows of a whole world in a substep every bounce was taken for coming to rest; and who turns fast does not
// rest on his corner, so that nothing held him. A capsule that a wall had set spinning went through it with its other
// end, because of rows of discs that rattled 300 m away.
#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

constexpr double dt = 0.0178, speed = 63;

/// A capsule that strikes a wall with one end and then, turning at 750 rad/s, with the other; and the world's blows in
/// that step.
struct Struck {
    double x, spin;
    std::uint64_t blows;
};
Struck strikes_a_wall(int rows) {
    constexpr double r = 0.0721;
    World world({.solver = SoftStep{}});
    world.add(Body{.kind = Kind::fixed, .shapes = {{.geometry = Segment{{0, -500}, {0, 500}}}}, .restitution = 0.3});
    const BodyId capsule = world.add(Body{.position = {-1.101, 301},
                                          .angle = 4.411,
                                          .velocity = {speed, 1.1},
                                          .angular_velocity = 20.3,
                                          .mass = 0.004,
                                          .shapes = {{.geometry = Capsule{{-r, 0}, {r, 0}, r / 4}}},
                                          .restitution = 0.5,
                                          .friction = 0.3});
    for (int row = 0; row < rows; ++row)
        for (int k = 0; k < 30; ++k)
            world.add(Body{.position = {-1.05 - 0.0202 * k, 0.1 * row},
                           .velocity = {speed, 0},
                           .mass = 0.004,
                           .radius = 0.01,
                           .restitution = 0.9});
    world.step(dt);
    world.step(dt);
    return {world.position(capsule).x, world.angular_velocity(capsule), world.collisions()};
}

TEST(SpinningBodyAtAWall, StaysBeforeItWhateverRattlesFarAway) {
    const Struck alone = strikes_a_wall(0), beside = strikes_a_wall(3);
    ASSERT_GT(beside.blows, 1000U);
    ASSERT_LT(alone.x, 0);
    EXPECT_NEAR(beside.x, alone.x, 1e-9);  // other places of the same bodies round otherwise
    EXPECT_NEAR(beside.spin, alone.spin, 1e-6);
}

}  // namespace
}  // namespace carom
