// A ball in two wells, pushed to and fro: x'' + δ x' − x + x³ = γ cos ωt with δ = 0.3 and ω = 1.2, from x = 1 at rest.
// As the push grows its motion repeats after one, two, four, five periods, never, and after two again: the figures of
// the article "Duffing equation" in Wikipedia.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <set>

namespace carom {
namespace {

constexpr double w = 1.2;
constexpr double period = 2 * 3.14159265358979323846 / w;

/// Of so many periods the last ones, once in each.
std::size_t places(double push, int periods, int last) {
    World world({.integrator = Rk4{}, .solver = NoContact{}});
    const BodyId ball = world.add(Body{.position = {1, 0}});
    world.add(ForceField{.force = [push](Vec2 x, Vec2 v, double, double t) {
        return Vec2{x.x - x.x * x.x * x.x - 0.3 * v.x + push * std::cos(w * t), 0};
    }});
    std::set<std::pair<long, long>> found;
    for (int n = 1; n <= periods; ++n) {
        for (int k = 0; k < 100; ++k) world.step(period / 100);
        // Transients have died out by then, e^(−0.15 t); what is left is far smaller than between two of the places.
        const auto rounded = [](double a) { return std::lround(1e4 * a); };
        if (n > periods - last) found.insert({rounded(world.position(ball).x), rounded(world.velocity(ball).x)});
    }
    return found.size();
}

TEST(Duffing, RepeatsAfterAsManyPeriodsAsWasPublished) {
    const std::pair<double, std::size_t> published[] = {{0.20, 1}, {0.28, 2}, {0.29, 4}, {0.37, 5}, {0.65, 2}};
    for (const auto& [push, count] : published) EXPECT_EQ(places(push, 600, 40), count) << push;
    EXPECT_GT(places(0.50, 600, 40), 38u);
}

}  // namespace
}  // namespace carom
