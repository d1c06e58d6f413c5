// The limits that the world's substeps rely on, held against the methods themselves.

#include <gtest/gtest.h>

#include "integrators/propose.hpp"
#include "scenes.hpp"

namespace carom::test {
namespace {

/// The largest |x| in the last steps of an oscillation x'' = −ω² x − γ x' from x = 1, in n steps of h.
double amplitude_after(const Integrator& method, double frequency, double damping_rate, double h, int n) {
    State state;
    Bodies bodies;
    const BodyId origin = bodies.add(Body{.kind = Kind::fixed}, state);
    const BodyId bob = bodies.add(Body{.position = {1, 0}}, state);
    Forces forces;
    forces.springs.push_back(Spring{.a = origin,
                                    .b = bob,
                                    .stiffness = frequency * frequency,
                                    .damping = damping_rate,
                                    .damping_law = DampingLaw::isotropic});
    const Dynamics dynamics(forces, bodies);
    Memory memory;
    double largest = 0;
    for (int k = 0; k < n; ++k) {
        propose(method, dynamics, state, h, memory);
        if (k >= n - 20) largest = std::max(largest, std::abs(state.x.linear[1].x));
        if (!(std::abs(state.x.linear[1].x) < 1e100)) return 1e100;
    }
    return largest;
}

std::vector<Named> limited() {
    std::vector<Named> all;
    for (const Named& m : every_method)
        if (std::isfinite(stability_limit(m.method))) all.push_back(m);
    return all;
}

class Limits : public testing::TestWithParam<Named> {};
INSTANTIATE_TEST_SUITE_P(EveryMethod, Limits, testing::ValuesIn(limited()),
                         [](const auto& test) { return test.param.name; });

// At 99.9 % of the limit an oscillation stays (an elliptic map stretches it by at most 1/√(1 − (ωh/2)²) = 22); at 102 %
// it grows, dormand_prince5's by 1e-5 a step only.
TEST_P(Limits, OfAnUndampedOscillation) {
    const double limit = stability_limit(GetParam().method);
    if (limit == 1) {
        // Explicit Euler and the methods of order 2 grow at any step; 1 keeps their growth below one half a step.
        EXPECT_GT(amplitude_after(GetParam().method, 1, 0, 0.3, 100000), 1e3);
        EXPECT_LT(amplitude_after(GetParam().method, 1, 0, 1, 10), 100);
        return;
    }
    EXPECT_LT(amplitude_after(GetParam().method, 1, 0, 0.999 * limit, 100000), 30);
    EXPECT_GT(amplitude_after(GetParam().method, 1, 0, 1.02 * limit, 100000), limit < 1 ? 2 : 1e9);
}

// The step that a world takes for damped springs never lets them grow.
TEST_P(Limits, OfDampedOscillations) {
    const double limit = stability_limit(GetParam().method);
    for (const double damping : {0.01, 0.03, 0.1, 0.3, 1.0, 2.0, 3.0, 10.0, 30.0, 100.0, 1e4}) {
        const double h = longest_stable_step({1, damping}, limit);
        if (limit == 1 && damping < 1) continue;  // those methods grow
        EXPECT_LT(amplitude_after(GetParam().method, 1, damping, h, 20000), 30) << "γ/ω = " << damping << ", h = " << h;
    }
}

TEST(Stability, MethodsThatChooseTheirStepHaveNoLimit) {
    EXPECT_TRUE(std::isinf(stability_limit(Adaptive{})));
    EXPECT_TRUE(std::isinf(stability_limit(GaussRadau{})));
    EXPECT_TRUE(std::isinf(stability_limit(Implicit{})));
    EXPECT_LT(amplitude_after(Implicit{}, 1, 0, 1000, 1000), 1.0001);
}

}  // namespace
}  // namespace carom::test
