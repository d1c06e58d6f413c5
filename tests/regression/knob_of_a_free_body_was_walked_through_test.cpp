// A disc meets a free box with a knob on its side. The box's own side was taken for one that keeps the disc off the
// corner behind it, though the knob stands out from that side: the disc went 76 mm into it without an impact.
#include <algorithm>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(FreeBody, IsStruckAtAKnobThatStandsOutFromItsSide) {
    World world({.solver = SoftStep{}});
    const Shape box{.geometry = Box{.width = 1, .height = 1}}, knob{.geometry = Disc{{0.5, -0.2}, 0.1}};
    const BodyId body = world.add(Body{.mass = 2, .shapes = {box, knob}});
    const BodyId disc = world.add(Body{.position = {2.5, -0.3}, .velocity = {-6, 0}, .radius = 0.2});
    double nearest = 1;
    for (int step = 0; step < 20; ++step) {
        world.step(1.0 / 60);
        nearest = std::min(nearest, world.closest_points(body, disc)->distance);
    }
    // Instants of impacts are found to 1e-9 of a size.
    EXPECT_GT(nearest, -1e-9);
    EXPECT_EQ(world.collisions(), 1u);
}

}  // namespace
}  // namespace carom::test
