// Kepler's orbit, e = 0.6, GM = a = 1, a hundred times round in 600 steps each: the relative error of the energy.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

using std::numbers::pi;

struct Orbits {
    double first, last;  ///< the largest error of the energy during the first ten and the last ten orbits
    double place;        ///< how far from its start the body is at the end
};

Orbits run_orbits(const Integrator& method) {
    World world({.integrator = method});
    world.add(Body{.kind = Kind::fixed});
    const BodyId planet = world.add(Body{.position = {0.4, 0}, .velocity = {0, 2}});
    world.add(Attraction{});
    const double start = energy(world).total();
    Orbits result{};
    for (int orbit = 0; orbit < 100; ++orbit)
        for (int k = 0; k < 600; ++k) {
            world.step(2 * pi / 600);
            const double error = std::abs(energy(world).total() / start - 1);
            if (orbit < 10) result.first = std::max(result.first, error);
            if (orbit >= 90) result.last = std::max(result.last, error);
        }
    result.place = length(world.position(planet) - Vec2{0.4, 0});
    return result;
}

// Symplectic methods: the error is that of the first passage by the mass, again and again. 1 % is for the phase at
// which the frames meet the passage.
TEST(KeplerOrbit, SymplecticMethodsKeepTheEnergyWithoutDrift) {
    const Orbits verlet = run_orbits(Verlet{});
    EXPECT_LT(verlet.first, 1e-3);
    EXPECT_NEAR(verlet.last / verlet.first, 1, 0.01);
    const Orbits pefrl = run_orbits(Pefrl{});
    EXPECT_LT(pefrl.first, 1e-7);
    EXPECT_NEAR(pefrl.last / pefrl.first, 1, 0.01);
    EXPECT_LT(pefrl.place, 2e-4);
}

// Rk4 loses the same at every passage: accurate, and it drifts.
TEST(KeplerOrbit, Rk4Drifts) {
    const Orbits rk4 = run_orbits(Rk4{});
    EXPECT_LT(rk4.last, 1e-5);
    EXPECT_GT(rk4.last, 8 * rk4.first);
}

// The start, 0.4, is itself rounded: that alone moves the end by 5e-13 (see the unit tests of gauss_radau).
TEST(KeplerOrbit, GaussRadauComesBack) {
    const Orbits radau = run_orbits(GaussRadau{});
    EXPECT_LT(radau.last, 5e-15);
    EXPECT_LT(radau.place, 1e-12);
}

}  // namespace
}  // namespace carom::test
