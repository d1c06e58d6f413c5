// Boxes fell on a bridge that is as long as its way and has some friction in its hinges: sooner or later, most often in
// the first second, they flew off at 60 to 1600 m/s, with up to 2 MJ. Where a chain is at a dead point rounds of its
// projection did not lead on while all frictions were held, and what was found in the end was taken though these bore
// thousands of times what they can; after the drift they had to give it back.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

constexpr double gravity = 10, top = 4.5;  // m: no box is higher at first

Body box(Vec2 at, double width, double height, double density) {
    return {.position = at,
            .shapes = {{.geometry = Box{width, height}, .density = density}},
            .restitution = 0,
            .friction = 0.6};
}

World bridge(int planks, double friction) {
    World world({.gravity = {0, -gravity}, .solver = SoftStep{.sleep = false}});
    const auto pin = [&](std::optional<BodyId> a, BodyId b, Vec2 at) {
        world.add(Joint{.a = a, .b = b, .at = at, .type = RevoluteJoint{.motor = JointMotor{.maximum = friction}}});
    };
    std::optional<BodyId> last;
    for (int i = 0; i < planks; ++i) {
        const BodyId next = world.add(box({i + 0.5, 0}, 0.9, 0.2, 1));
        pin(last, next, {1.0 * i, 0}), last = next;
    }
    pin(std::nullopt, *last, {1.0 * planks, 0});
    constexpr int loads = 4;
    for (int i = 0; i < loads; ++i) world.add(box({planks * (i + 0.7) / (loads + 0.4), 1.0 + i}, 0.6, 0.6, 1 + i));
    return world;
}

TEST(TautBridge, BearsWhatFallsOnIt) {
    for (const int planks : {6, 12, 20})
        for (const double friction : {0.1, 1.0, 10.0}) {
            World world = bridge(planks, friction);
            double fastest = 0, most = 0, last = energy(world).total();
            run(world, 7, 1.0 / 60, [&](const World& w) {
                for (const BodyId id : w.ids())
                    if (w.position(id).y > -top) fastest = std::max(fastest, length(w.velocity(id)));
                const double now = energy(w).total();
                most = std::max(most, now - last), last = now;
            });
            EXPECT_LE(fastest, std::sqrt(4 * gravity * top)) << planks << ", " << friction;  // one that fell so far
            // Brakes and blows take energy alone. Of the 100 J with which the boxes land the method may give some back.
            EXPECT_LE(most, 2) << planks << ", " << friction;
        }
}

}  // namespace
}  // namespace carom
