#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "reference/truth.hpp"

namespace carom {
namespace {

constexpr double g = 9.81;

/// Half the period of mode n of a hanging rope of so many segments, from two zeros of its part of the motion.
double frequency(int segments, double expected) {
    World world({.gravity = {0, -g}, .solver = NoContact{}});
    const double stiffness = 1e6;  // N; the rope's own weight stretches it by 5e-6
    build(
        world,
        Rope{.anchor_a = {0, 0}, .anchor_b = {0, -1}, .fixed_b = false, .segments = segments, .stiffness = stiffness});
    // Each bead where the rope below it stretches the rope to, and aside by Bernoulli's J0.
    std::vector<double> shape;
    for (std::size_t i = 0; i < world.size(); ++i) {
        const double s = 1 + world.positions()[i].y;  // from the free end
        shape.push_back(std::cyl_bessel_j(0, 2 * expected * std::sqrt(s / g)));
        if (i > 0) world.set_position(world.ids()[i], {1e-5 * shape[i], -(1 - s) - g / stiffness * (1 - s * s) / 2}, 0);
    }
    const auto part = [&] {
        double sum = 0;
        for (std::size_t i = 1; i < world.size(); ++i) sum += world.masses()[i] * shape[i] * world.positions()[i].x;
        return sum;
    };
    std::vector<double> zeros;
    const double step = 1e-3;
    double before = part();
    while (zeros.size() < 2) {
        world.step(step);
        const double now = part();
        if ((now > 0) != (before > 0)) zeros.push_back(world.time() - step * now / (now - before));
        before = now;
    }
    return M_PI / (zeros[1] - zeros[0]);
}

// Beads are a rule of second order for the rope: a quarter of the error with half the segments, and next to none after
// Richardson's extrapolation. What is left is the fourth order, the weight's stretch of 5e-6, and the other modes, of
// which 1e-4 is in the start, since beads have a shape that is not quite J0.
TEST(Truth, mech_hangchain) {
    const auto& exact = truth("mech.hangchain");
    for (int n = 0; n < 4; ++n) {
        SCOPED_TRACE(n + 1);
        const double w = exact[n], coarse = frequency(80, w), fine = frequency(160, w);
        std::printf("mode %d: %.8f %.8f, extrapolated error %.2g\n", n + 1, coarse / w - 1, fine / w - 1,
                    (4 * fine - coarse) / 3 / w - 1);
        EXPECT_NEAR((4 * fine - coarse) / 3, w, 1e-4 * w);
    }
}

}  // namespace
}  // namespace carom
