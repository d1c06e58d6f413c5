// A contact that is looked at again in every substep had all others begin with sums taken anew: a disc that rolled over
// another one far away changed the last bits of a pile, and made its steps dearer.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

constexpr int rows = 8;

World pile() {
    World world({.gravity = {0, -10}, .solver = SoftStep{}});
    world.add(HalfPlane{});
    for (int i = 0; i < rows; ++i)
        for (int k = i; k < rows; ++k)
            world.add(Body{.position = {1.1 * k - 0.55 * i, 0.55 + 1.05 * i},
                           .shapes = {{.geometry = Box{1, 1}, .density = 1}},
                           .restitution = 0,
                           .friction = 0.6});
    return world;
}

void add_disc_on_disc(World& world, Vec2 at) {
    const Shape disc{.geometry = Disc{{}, 0.5}, .density = 1};
    world.add(Body{.kind = Kind::fixed, .position = at, .shapes = {{.geometry = Disc{{}, 0.5}}}, .friction = 0.6});
    world.add(Body{.position = at + Vec2{0.3, 0.95}, .shapes = {disc}, .restitution = 0, .friction = 0.6});
}

TEST(Regression, FarDiscThatRollsOverAnotherLeavesAPileAsItIs) {
    World alone = pile(), beside = pile();
    add_disc_on_disc(beside, {100, 5});
    for (int k = 0; k < 60; ++k) {
        alone.step(1.0 / 60), beside.step(1.0 / 60);
        for (std::size_t i = 0; i < alone.size(); ++i) {
            ASSERT_EQ(alone.positions()[i].x, beside.positions()[i].x) << "body " << i << ", step " << k;
            ASSERT_EQ(alone.positions()[i].y, beside.positions()[i].y) << "body " << i << ", step " << k;
        }
    }
}

}  // namespace
}  // namespace carom
