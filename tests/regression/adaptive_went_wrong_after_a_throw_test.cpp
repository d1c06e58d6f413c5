// A force of the user's threw in the middle of a step of the method 'adaptive'. Whoever tried the step again got
// another motion: the method had noted a step that it never finished.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <stdexcept>

namespace carom {
namespace {

TEST(AdaptiveAfterAThrow, GoesOnFromTheState) {
    for (const Pair pair : {Pair::dormand_prince54, Pair::dormand_prince853})
        for (const double again : {0.3, 0.1}) {
            int in_vain = 0;
            for (int at = 1; at <= 40; ++at) {
                int left = 0;  // calls until it throws, if more than none
                World world({.integrator = Adaptive{.pair = pair}, .solver = NoContact{}});
                const BodyId body = world.add(Body{.position = {1, 0}});
                world.add(ForceField{.name = "spring", .force = [&](Vec2 x, Vec2, double, double) {
                                         if (left > 0 && --left == 0) throw std::runtime_error("mine");
                                         return -1.0 * x;
                                     }});
                for (int i = 0; i < 10; ++i) world.step(0.3);
                left = at;
                try {
                    for (int i = 0; i < 20; ++i) world.step(0.3);
                } catch (const std::runtime_error&) {
                    ++in_vain;
                }
                left = 0;
                world.step(again);
                EXPECT_NEAR(world.position(body).x, std::cos(world.time()), 1e-6) << at;
                EXPECT_NEAR(energy(world).residual, 0, 1e-6) << at;
            }
            EXPECT_EQ(in_vain, 40);
        }
}

}  // namespace
}  // namespace carom
