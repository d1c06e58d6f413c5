// The order of every method, measured on the full state at a time that is no multiple of any period. An error
// C h^p (1 + c h) gives log2(e(h)/e(h/2)) = p + c' h, so that two such numbers, at h and h/2, give p without c.

#include <gtest/gtest.h>

#include "scenes.hpp"

namespace carom::test {
namespace {

constexpr double duration = 1.7;

struct Case {
    Named method;
    double order;
    int steps;  ///< of the coarsest run: the errors lie where h^p rules and rounding does not
};
const std::vector<Case> cases = {{{"euler", Euler{}}, 1, 1088},
                                 {{"symplectic_euler", SymplecticEuler{}}, 1, 1088},
                                 {{"verlet", Verlet{}}, 2, 272},
                                 {{"pefrl", Pefrl{}}, 4, 136},
                                 {{"rk4", Rk4{}}, 4, 272},
                                 {{"midpoint", RungeKutta{Tableau::midpoint}}, 2, 272},
                                 {{"heun", RungeKutta{Tableau::heun}}, 2, 272},
                                 {{"ralston", RungeKutta{Tableau::ralston}}, 2, 272},
                                 {{"kutta3", RungeKutta{Tableau::kutta3}}, 3, 272},
                                 {{"kutta38", RungeKutta{Tableau::kutta38}}, 4, 272},
                                 {{"dormand_prince5", RungeKutta{Tableau::dormand_prince5}}, 5, 68},
                                 {{"implicit", Implicit{}}, 2, 272}};

std::vector<double> truth(const Scene& scene) { return everything(after(scene.make(GaussRadau{}), duration, 10)); }

std::vector<double> accounts(const std::vector<double>& all) { return {all.end() - 5, all.end()}; }

class Orders : public testing::TestWithParam<std::tuple<Scene, Case>> {};

TEST_P(Orders, OfTheFullStateAndOfHeatAndWork) {
    const auto& [scene, c] = GetParam();
    const auto exact = truth(scene);
    double all[3], flown[3];
    for (int k = 0; k < 3; ++k) {
        const auto got = everything(after(scene.make(c.method.method), duration, c.steps << k));
        all[k] = largest_difference(got, exact);
        flown[k] = largest_difference(accounts(got), accounts(exact));
    }
    const auto order = [](const double(&e)[3]) { return 2 * std::log2(e[1] / e[2]) - std::log2(e[0] / e[1]); };
    RecordProperty("order", std::to_string(order(all)));
    RecordProperty("error", std::to_string(all[2]));
    EXPECT_NEAR(order(all), c.order, 0.1);
    if (flown[0] == 0) return;
    EXPECT_NEAR(order(flown), c.order, 0.15) << "of heat and work";
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, Orders, testing::Combine(testing::ValuesIn(scenes), testing::ValuesIn(cases)),
                         [](const auto& test) {
                             return std::get<1>(test.param).method.name + "_on_" + std::get<0>(test.param).name;
                         });

// Rounding leaves the method of order 8 a decade and a half of step sizes, too few for the extrapolation. On Kepler's
// orbit, e = 0.6 from the apse near the mass, its leading term rules from 16 steps a second on.
TEST(OrderEight, OnKeplersOrbit) {
    const auto error = [exact = everything(after(kepler_orbit(GaussRadau{}), 1, 10))](int n) {
        return largest_difference(everything(after(kepler_orbit(RungeKutta{Tableau::dormand_prince8}), 1, n)), exact);
    };
    EXPECT_NEAR(std::log2(error(16) / error(32)), 8, 0.1);
    EXPECT_NEAR(std::log2(error(24) / error(48)), 8, 0.1);
}

class Orders8 : public testing::TestWithParam<Scene> {};
TEST_P(Orders8, NearEight) {
    const auto exact = truth(GetParam());
    const auto error = [&](int n) {
        const World w = after(GetParam().make(RungeKutta{Tableau::dormand_prince8}), duration, n);
        return largest_difference(everything(w), exact);
    };
    // The next term is still a tenth of the leading one: ±1.
    EXPECT_NEAR(std::log2(error(17) / error(34)), 8, 1.05);
    EXPECT_LT(error(34), 1e-8);
}
INSTANTIATE_TEST_SUITE_P(EveryScene, Orders8, testing::ValuesIn(scenes),
                         [](const auto& test) { return std::string(test.param.name); });

// The reference of all these tests against a method that shares no coefficient with it. 1e-12: a thousand steps round
// some 1e-14 each way, and the velocity on the driven curve, a difference quotient, is good to 1e-13.
class Reference : public testing::TestWithParam<Scene> {};
TEST_P(Reference, TwoMethodsAgree) {
    const World fine = after(GetParam().make(RungeKutta{Tableau::dormand_prince8}), duration, 1000);
    EXPECT_LT(largest_difference(everything(fine), truth(GetParam())), 1e-12);
}
INSTANTIATE_TEST_SUITE_P(EveryScene, Reference, testing::ValuesIn(scenes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace carom::test
