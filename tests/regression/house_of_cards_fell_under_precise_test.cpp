// The precise solve moved the bounds of friction once more before it looked whether its solution was one, and threw it
// away: with `precise` a house of cards fell, which stood without.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

namespace carom {
namespace {

TEST(HouseOfCards, StandsToRoundingIfSolvedPrecisely) {
    constexpr double length = 0.4, thick = 0.002, lean = 0.45;  // rad
    const double sine = std::sin(lean), cosine = std::cos(lean);
    const double reach = 0.5 * (length * sine + thick * cosine), rise = 0.5 * (length * cosine + thick * sine);
    World world({.gravity = {0, -9.81}, .solver = SoftStep{.precise = Precise::all}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.7}});
    std::vector<Vec2> places;
    const auto add = [&](Vec2 at, double angle) {
        world.add(Body{.position = at,
                       .angle = angle,
                       .shapes = {{.geometry = Box{thick, length}, .density = 1}},
                       .restitution = 0,
                       .friction = 0.7});
        places.push_back(at);
    };
    for (int level = 0; level < 3; ++level)
        for (int i = 0; i < 3 - level; ++i) {
            const double x = (i - 0.5 * (2 - level)) * length, floor = level * (2 * rise + thick);
            add({x - reach, floor + rise}, -lean), add({x + reach, floor + rise}, lean);
            if (i < 2 - level) add({x + 0.5 * length, floor + 2 * rise + 0.5 * thick}, std::acos(0.0));
        }
    for (int step = 0; step < 300; ++step) world.step(1.0 / 60);
    for (std::size_t i = 0; i < places.size(); ++i)
        EXPECT_NEAR(carom::length(world.positions()[i] - places[i]), 0, 1e-6);
}

}  // namespace
}  // namespace carom
