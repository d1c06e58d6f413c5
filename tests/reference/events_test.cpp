#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/scene.hpp>

#include "reference/exact_gas.hpp"
#include "reference/truth.hpp"

// Exact facts about collisions of a few bodies that a scene cannot say.

namespace carom {
namespace {

/// Runs there and back; returns the worst coordinate's way from where it was.
double there_and_back(World& world, double duration, double step) {
    const World start = world;
    run(world, duration, step);
    const auto there = world.collisions();
    EXPECT_GT(there, 0u);
    turn_back(world);
    run(world, duration, step);
    EXPECT_EQ(world.collisions(), 2 * there);
    double worst = 0;
    for (std::size_t i = 0; i < world.size(); ++i) {
        const Vec2 x = world.positions()[i] - start.positions()[i], v = world.velocities()[i] + start.velocities()[i];
        worst = std::max({worst, std::abs(x.x), std::abs(x.y), std::abs(v.x), std::abs(v.y)});
    }
    return worst;
}

TEST(Truth, gas_time_reversal_of_two_discs) {
    World world;
    world.add(Rectangle{});
    world.add(Body{.position = {0.3, 0.4}, .velocity = {0.7, 0.2}, .radius = 0.15});
    world.add(Body{.position = {0.7, 0.6}, .velocity = {-0.3, 0.5}, .radius = 0.15});
    EXPECT_LT(there_and_back(world, 4, 0.01), truth_entry("gas.time.reversal")["tolerance"].get<double>());
}

TEST(Truth, gas_time_reversal_of_galperins_blocks) {
    World world;
    world.add(HalfPlane{.normal = {1, 0}});
    world.add(Body{.position = {1, 0}, .radius = 0.1});
    world.add(Body{.position = {2, 0}, .velocity = {-1, 0}, .mass = 1e4, .radius = 0.2});
    EXPECT_LT(there_and_back(world, 8, 0.01), truth_entry("gas.time.reversal")["tolerance"].get<double>());
    EXPECT_EQ(world.collisions(), 2 * truth("ed.galperin")[2].get<std::uint64_t>());
}

TEST(Truth, ed_galperin) {
    const auto& counts = truth("ed.galperin");
    for (int n = 0; n <= 5; ++n) {
        Scene scene = Scene::load(std::string(CAROM_SOURCE_DIR) + "/scenes/galperin.json");
        scene.set("n", std::to_string(n));
        World world = scene.world();
        run(world, 10, 0.01);
        EXPECT_EQ(world.collisions(), counts[n].get<std::uint64_t>()) << n;
    }
}

TEST(Truth, ed_gas1d) {
    const auto& counts = truth("ed.gas1d");
    const int sizes[] = {3, 10, 100, 1000};
    for (int k = 0; k < 4; ++k) {
        World world;
        const int n = sizes[k];
        Random random(7);
        std::vector<double> v(n);
        for (int i = 0; i < n; ++i) v[i] = 1 - 2 * (i + random.uniform(0, 0.5)) / n;  // strictly decreasing
        for (int i = 0; i < n; ++i) world.add(Body{.position = {1.0 * i, 0}, .velocity = {v[i], 0}, .radius = 0.2});
        // Two of them m places apart are 0.6 m apart, and approach by at least (m - 0.5) 2/n: all is over by 0.6 n.
        run(world, 0.65 * n, 1);
        EXPECT_EQ(world.collisions(), counts[k].get<std::uint64_t>()) << n;
        for (int i = 0; i < n; ++i) EXPECT_NEAR(world.velocities()[i].x, v[n - 1 - i], 1e-12) << n << " " << i;
    }
}

/// Three equal particles on a line, the outer ones flying at the middle one; how many impacts there are, and how fast
/// they part in the end.
std::pair<std::uint64_t, double> three_on_a_line(double restitution) {
    World world;
    const double x[] = {0, 1, 2.1}, v[] = {1, 0, -1};
    for (int i = 0; i < 3; ++i)
        world.add(Body{.position = {x[i], 0}, .velocity = {v[i], 0}, .radius = 0.1, .restitution = restitution});
    run(world, 20, 20);
    return {world.collisions(), world.velocities()[2].x - world.velocities()[0].x};
}

/// The same by the map of velocities alone: the middle one is struck from either side in turn.
std::pair<std::uint64_t, double> map_of_three(double restitution) {
    double v[] = {1, 0, -1};
    std::uint64_t impacts = 0;
    for (int left = 0; v[left] > v[left + 1] && impacts < 1000; left = 1 - left, ++impacts) {
        const double mean = 0.5 * (v[left] + v[left + 1]), half = 0.5 * restitution * (v[left] - v[left + 1]);
        v[left] = mean - half;
        v[left + 1] = mean + half;
    }
    return {impacts, v[2] - v[0]};
}

// Above the threshold there are as many impacts as the map has, and they part as fast. Below it the map never ends;
// here it is cut off when a flight would be a rounding of the radius, and nothing is left to part them.
TEST(Truth, ed_collapse3) {
    const double threshold = truth("ed.collapse3");
    const auto [above, parting] = three_on_a_line(1.05 * threshold);
    const auto [impacts, exact] = map_of_three(1.05 * threshold);
    EXPECT_LT(impacts, 1000u);
    EXPECT_EQ(above, impacts);
    EXPECT_NEAR(parting, exact, 1e-6 * exact);
    EXPECT_EQ(map_of_three(0.95 * threshold).second, 0);  // until no bit is left
    const auto [below, rest] = three_on_a_line(0.95 * threshold);
    EXPECT_GT(below, above / 2);
    EXPECT_LT(std::abs(rest), 1e-12);
}

TEST(Truth, ed_bounce) {
    World world = Scene::load(std::string(CAROM_SOURCE_DIR) + "/scenes/bounce.json").world();
    const BodyId ball = world.find("ball");
    // The way between two steps without impact, and by the parabola's own closed form if it turned at the top; of a
    // step with an impact the way down and the way up again.
    const double g = 9.81, h = 1e-4;
    double way = 0;
    while (world.time() < 4.1) {
        const double y = world.position(ball).y, v = world.velocity(ball).y;
        const auto before = world.collisions();
        world.step(h);
        const double y2 = world.position(ball).y, v2 = world.velocity(ball).y;
        if (world.collisions() != before)
            way += y + y2;
        else if (v > 0 && v2 < 0)
            way += (v * v + v2 * v2) / (2 * g);
        else
            way += std::abs(y2 - y);
    }
    // Bounces within one step are missed once they take less than h, at 1e-8 m.
    EXPECT_NEAR(way, truth("ed.bounce")[1].get<double>(), 1e-7);
    EXPECT_NEAR(world.position(ball).y, 0, 1e-12);
    EXPECT_EQ(world.velocity(ball).y, 0);
}

}  // namespace
}  // namespace carom
