// A bob on a pin touches a floor near its lowest point. In the midst of a substep its velocity misses the pin by what
// it has turned since the substep began, and what has one way left to go took an impulse without end to correct that:
// 7000 times its energy at the shallowest arm. Where friction held it, rounding alone parted it, by 1e19 N s.
#include <algorithm>
#include <cmath>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(PinnedBody, KeepsItsEnergyWhereItGrazesAFloor) {
    for (const double arm : {0.9, 0.901, 0.907, 0.913, 0.92})
        for (const double friction : {0.0, 0.3, 0.8}) {
            World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
            world.add(HalfPlane{.side = {.friction = friction}});
            const Vec2 pin{0, 1.1}, start{-0.8, 1.1 - std::sqrt(arm * arm - 0.64)};
            const BodyId bob = world.add(Body{.position = start, .radius = 0.2, .friction = friction});
            world.add(Joint{.b = bob, .at = pin, .type = RevoluteJoint{}});
            const double before = energy(world).total();
            double most = before, hardest = 0;
            for (int step = 0; step < 300; ++step) {
                world.step(1.0 / 60);
                most = std::max(most, energy(world).total());
                for (const Impact& i : world.events().impacts) hardest = std::max(hardest, i.impulse);
            }
            // The error of the swing itself is 1e-4 of its energy at this step.
            EXPECT_LT(most, before * (1 + 2e-4)) << arm << ' ' << friction;
            // An impulse along the normal turns the swing back: 2 m v / sin θ, 127 N s at the arm of 0.901. Of the one
            // that but grazes θ is what the swing's error leaves: 520 N s came out, and 0.012 J of residual; both
            // bounds are these with some room, where it was 1e6 to 1e19 N s and 1 to 1e18 J.
            EXPECT_LT(hardest, 600) << arm << ' ' << friction;
            EXPECT_LT(std::abs(energy(world).residual), 0.02) << arm << ' ' << friction;
        }
}

}  // namespace
}  // namespace carom::test
