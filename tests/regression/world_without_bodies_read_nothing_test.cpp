// A world without bodies read through a null pointer in every step, harmlessly where nothing looks: the sanitizers do.

#include <gtest/gtest.h>

#include <carom/carom.hpp>

namespace carom {
namespace {

TEST(Regression, WorldWithoutBodiesReadNothing) {
    for (const Integrator& method : {Integrator{Euler{}}, Integrator{SymplecticEuler{}}, Integrator{Verlet{}},
                                     Integrator{Rk4{}}, Integrator{Adaptive{}}, Integrator{GaussRadau{}}}) {
        World world({.gravity = {0, -1}, .integrator = method});
        world.add(HalfPlane{});
        world.step(0.5);
        EXPECT_EQ(world.time(), 0.5);
        EXPECT_EQ(energy(world).total(), 0);
    }
}

}  // namespace
}  // namespace carom
