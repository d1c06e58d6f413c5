#include "reference/gas.hpp"

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>
#include <functional>

#include "reference/truth.hpp"

// Gases of hard discs against statistical mechanics. Every tolerance is about four standard errors of what a run of a
// few seconds can know; where more would have to be said, the comment beside it says it. The seeds are fixed, so that a
// test passes always or never.

namespace carom {
namespace {

TEST(Truth, gas_finiteN_rate) {
    const double degrees[] = {2, 4, 8, 20, 200};
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(finite_rate(degrees[k]), truth("gas.finiteN.rate")[k].get<double>(), 1e-10);
}

/// A crystal at kT = 1: rows of a triangular lattice that nearly touch in close packing.
World crystal(int columns, int rows, double eta) {
    const double a = std::sqrt(truth("gas.closepacking").get<double>() / eta), height = a * std::sqrt(0.75);
    World world;
    world.add(Periodic{{0, 0}, {columns * a, rows * height}});
    Random random(5);
    std::vector<Vec2> v;
    Vec2 mean{};
    for (int i = 0; i < columns * rows; ++i) {
        const double x = random.normal();
        v.push_back({x, random.normal()});
        mean += v.back() / (columns * rows);
    }
    double energy = 0;
    for (Vec2& each : v) each -= mean, energy += 0.5 * squared_length(each);
    for (int i = 0; i < columns * rows; ++i)
        world.add(Body{.position = {(i % columns + 0.5 * (i / columns % 2)) * a, (i / columns) * height},
                       .velocity = std::sqrt((columns * rows - 1) / energy) * v[i],
                       .radius = 0.5});
    return world;
}

// 400 discs, some ten thousand collisions: 1 % for four standard errors of the count, and O(1/N) of the fluid's size.
TEST(Truth, gas_enskog_rate_and_mfp_and_diffusion) {
    const auto& rates = truth("gas.enskog.rate");
    const auto& paths = truth("gas.mfp");
    const Equilibrium dilute = measure(periodic_gas(400, 0.1), 10, 300, 12);
    std::printf("eta 0.1: rate off by %.2g, speed %.2g, D/D_E %.3f\n", dilute.rate / rates[2][2].get<double>() - 1,
                dilute.mean_speed / truth("gas.maxwell")[0].get<double>() - 1,
                dilute.diffusion / truth("gas.enskog.diffusion")[1].get<double>());
    EXPECT_NEAR(dilute.rate, rates[2][2].get<double>(), 0.015 * dilute.rate);
    EXPECT_NEAR(dilute.mean_speed / dilute.rate, paths[1].get<double>(), 0.025 * paths[1].get<double>());
    // Enskog's first Sonine formula is itself good to some percent: 5 %, and 4 × 1/√(400 · 12) of the run.
    EXPECT_NEAR(dilute.diffusion, truth("gas.enskog.diffusion")[1].get<double>(), 0.11 * dilute.diffusion);
}

TEST(Truth, gas_eos_from_the_collision_rate) {
    // The fit that predicts below, against its own table.
    for (const auto& row : truth("gas.eos.kr"))
        EXPECT_NEAR(kolafa_rottner(row[0]), row[1].get<double>(), 2e-9 * row[1].get<double>());
    const auto& table = truth("gas.eos.krtable");
    for (const int k : {0, 2, 4}) {  // ρ* = 0.4, 0.5, 0.6
        const double eta = M_PI / 4 * table[k][0].get<double>(), z = table[k][1];
        const double measured = compressibility(measure(periodic_gas(400, eta), 5, 40, 4).rate);
        std::printf("rho* %.2f: Z %.4f, measured %.4f\n", table[k][0].get<double>(), z, measured);
        EXPECT_NEAR(measured - 1, z - 1, 0.015 * (z - 1));
    }
    // The first eight virial coefficients say all of it at η = 0.1.
    double virial = 1 + 0.2, power = 0.2;
    for (const auto& b : truth("gas.virial")) virial += b.get<double>() * (power *= 0.2);
    EXPECT_NEAR(compressibility(measure(periodic_gas(400, 0.1), 10, 150, 4).rate) - 1, virial - 1, 0.02 * (virial - 1));
}

TEST(Truth, gas_solid) {
    const auto& z = truth("gas.solid");
    const double measured = compressibility(measure(crystal(20, 20, 0.80), 2, 6, 4).rate);
    std::printf("solid at eta 0.80: Z %.3f, measured %.3f\n", z[1].get<double>(), measured);
    EXPECT_NEAR(measured, z[1].get<double>(), 0.015 * measured);
}

// Points among fixed discs: the uniform start is the equilibrium. A count of c impacts is known to 1/√c; here to 0.25 %
// and better, so that four standard errors are a percent where truth.json's 0.1 % would need 2e7 impacts.
TEST(Truth, gas_sinai_mft) {
    const auto& times = truth("gas.sinai.mft.list");
    for (int k = 0; k < 4; ++k) {
        const double radius = 0.1 * (k + 1), duration = 400 * times[k].get<double>();
        std::uint64_t impacts = 0;
        for (std::uint64_t seed = 0; seed < 10; ++seed) {  // ten boxes of 40, as points do not meet
            World world = sinai_billiard(radius, 40, seed);
            run(world, duration, 0.25);
            impacts += world.collisions();
        }
        const double measured = 400 * duration / static_cast<double>(impacts);
        std::printf("R %.1f: mean free time off by %.2g of it\n", radius, measured / times[k].get<double>() - 1);
        EXPECT_NEAR(measured, times[k].get<double>(), 0.01 * measured);
    }
}

/// What befalls two discs in a box, impact by impact: a step with several impacts is taken again in halves.
void step_to_single_impacts(World& world, double h,
                            const std::function<void(const World& before, const World& after)>& impact) {
    const World before = world;
    world.step(h);
    const auto impacts = world.collisions() - before.collisions();
    if (impacts == 1) impact(before, world);
    if (impacts < 2) return;
    world = before;
    for (int half = 0; half < 2; ++half) step_to_single_impacts(world, h / 2, impact);
}

// truth.json gives 4e-3 for 1e7 events; with 1e5 it is ten times that.
TEST(Truth, gas_twodisc_box) {
    World world;
    world.add(Rectangle{});
    const double sigma = 0.3;
    world.add(Body{.position = {0.3, 0.4}, .velocity = {0.7, 0.2}, .radius = sigma / 2});
    world.add(Body{.position = {0.7, 0.6}, .velocity = {-0.3, 0.5}, .radius = sigma / 2});
    const double scale = 1 / std::sqrt(energy(world).kinetic);
    for (const BodyId id : world.ids()) world.set_velocity(id, scale * world.velocity(id), 0);

    double discs = 0, hits_x = 0, hits_y = 0, push_x = 0, push_y = 0, v2 = 0, v4 = 0;
    const auto impact = [&](const World& before, const World& after) {
        Vec2 change[2];
        for (int i = 0; i < 2; ++i) change[i] = after.velocities()[i] - before.velocities()[i];
        if (change[0] != Vec2{} && change[1] != Vec2{}) return void(++discs);
        const Vec2 by = change[0] + change[1];
        (by.x != 0 ? hits_x : hits_y) += 1;
        push_x += std::abs(by.x), push_y += std::abs(by.y);
    };
    const double duration = 20000, h = 0.1;
    const int steps = static_cast<int>(duration / h);
    for (int n = 0; n < steps; ++n) {
        step_to_single_impacts(world, h, impact);
        for (const Vec2 v : world.velocities()) v2 += squared_length(v), v4 += squared_length(v) * squared_length(v);
    }
    ASSERT_NEAR(energy(world).kinetic, 1, 1e-10);

    const auto& exact = truth("gas.twodisc.box");
    const double events = static_cast<double>(world.collisions());
    const double tolerance = 4e-3 * std::sqrt(1e7 / events);
    const auto expect = [&](const char* what, double value) {
        const double expected = exact[what];
        std::printf("%s off by %.2g of it, allowed %.2g (%.0f events)\n", what, value / expected - 1, tolerance,
                    events);
        EXPECT_NEAR(value, expected, tolerance * expected) << what;
    };
    expect("force_x_wall", push_x / 2 / duration);
    expect("force_y_wall", push_y / 2 / duration);
    expect("rate_one_x_wall", hits_x / 2 / duration);
    expect("rate_one_y_wall", hits_y / 2 / duration);
    expect("rate_disc_disc", discs / duration);
    expect("v4_over_v2sq", v4 / (2 * steps) / std::pow(v2 / (2 * steps), 2));
}

// <v⁴>/<v²>² of N discs in a hard box over a few thousand independent configurations: four standard errors are 3 %.
TEST(Truth, gas_maxwell_finiteN) {
    const int sizes[] = {2, 5, 10, 100};
    for (int k = 1; k < 3; ++k) {
        const int n = sizes[k];
        World world;
        world.add(Rectangle{});
        build(world, Gas{.fill = {.count = n, .smallest_radius = 0.06, .largest_radius = 0.06, .seed = 2}});
        double v2 = 0, v4 = 0;
        const int samples = 6000;
        for (int s = 0; s < samples; ++s) {
            world.step(0.3);
            for (const Vec2 v : world.velocities())
                v2 += squared_length(v), v4 += squared_length(v) * squared_length(v);
        }
        const double ratio = v4 / (samples * n) / std::pow(v2 / (samples * n), 2);
        std::printf("N %d: <v4>/<v2>^2 %.4f\n", n, ratio);
        EXPECT_NEAR(ratio, truth("gas.maxwell.finiteN")[k].get<double>(), 0.03 * ratio);
    }
}

// 40000 velocities as the builder draws them: 4/√N = 2 % of each quantity's own spread.
TEST(Truth, gas_maxwell) {
    World world;
    build(world, Gas{.fill = {.high = {400, 400}, .count = 40000, .smallest_radius = 0.1, .largest_radius = 0.1}});
    const double n = static_cast<double>(world.size());
    std::vector<double> speeds;
    double mean = 0, square = 0, fourth = 0, above2 = 0, above3 = 0;
    for (const Vec2 v : world.velocities()) {
        const double s = length(v);
        speeds.push_back(s);
        mean += s / n, square += s * s / n, fourth += s * s * s * s / n;
        above2 += (s > 2) / n, above3 += (s > 3) / n;
    }
    std::nth_element(speeds.begin(), speeds.begin() + speeds.size() / 2, speeds.end());
    const auto& exact = truth("gas.maxwell");
    EXPECT_NEAR(mean, exact[0].get<double>(), 4 * 0.655 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(square), exact[1].get<double>(), 1e-12);  // made exact by the builder
    EXPECT_NEAR(speeds[speeds.size() / 2], exact[3].get<double>(), 4 * 0.85 / std::sqrt(n));
    EXPECT_NEAR(fourth / square / square, exact[4].get<double>(), 4 * 2.0 / std::sqrt(n));
    EXPECT_NEAR(above2, exact[5].get<double>(), 4 * std::sqrt(0.135 * 0.865 / n));
    EXPECT_NEAR(above3, exact[6].get<double>(), 4 * std::sqrt(0.011 / n));
}

// Equal speeds become Maxwell's: a2 after s collisions of each disc. 10000 discs know a2 to 0.01; what is measured at
// an s between the table's is held against the line between its rows, whose curvature is 0.01 at most.
TEST(Truth, gas_relax_a2) {
    const int n = 10000;
    const double side = std::sqrt(n * M_PI / 4 / 0.01);
    World world;
    world.add(Periodic{{0, 0}, {side, side}});
    build(world, Fill{.high = {side, side}, .count = n, .smallest_radius = 0.5, .largest_radius = 0.5});
    Random random(8);
    for (const BodyId id : world.ids()) {
        const double angle = random.uniform(0, 2 * M_PI);
        world.set_velocity(id, {std::sqrt(2) * std::cos(angle), std::sqrt(2) * std::sin(angle)}, 0);
    }
    const auto& table = truth("gas.relax.a2");
    for (int k = 0; k < 8; ++k) {
        world.step(15);
        const double s = 2.0 * static_cast<double>(world.collisions()) / n;
        double v2 = 0, v4 = 0;
        for (const Vec2 v : world.velocities())
            v2 += squared_length(v) / n, v4 += squared_length(v) * squared_length(v) / n;
        const double a2 = v4 / (2 * v2 * v2) - 1;
        std::size_t row = 0;
        while (row + 2 < table.size() && table[row + 1][0].get<double>() < s) ++row;
        const double s0 = table[row][0], s1 = table[row + 1][0], y0 = table[row][1], y1 = table[row + 1][1];
        std::printf("s %.2f: a2 %.4f, table %.4f\n", s, a2, y0 + (y1 - y0) * (s - s0) / (s1 - s0));
        EXPECT_NEAR(a2, y0 + (y1 - y0) * (s - s0) / (s1 - s0), 0.05) << s;
    }
}

/// Mean height above the lowest place and shares of heights above given ones, of discs under gravity without a lid.
std::vector<double> heights(int n, double radius, double energy_of_all, const std::vector<double>& above, int samples,
                            double apart) {
    World world({.gravity = {0, -1}});
    world.add(HalfPlane{});
    world.add(HalfPlane{.normal = {1, 0}});
    world.add(HalfPlane{.point = {1, 0}, .normal = {-1, 0}});
    Random random(6);
    const double mean = energy_of_all / (2 * n);
    for (int i = 0; i < n; ++i)
        world.add(Body{.position = {(i + 0.5) / n, radius + mean},
                       .velocity = {random.normal(), random.normal()},
                       .radius = radius});
    double kinetic = energy(world).kinetic;
    for (const BodyId id : world.ids())
        world.set_velocity(id, std::sqrt(energy_of_all / 2 / kinetic) * world.velocity(id), 0);
    run(world, 30 * apart, 0.02);
    std::vector<double> out(above.size() + 1);
    for (int s = 0; s < samples; ++s) {
        // Short steps: an impact comes to rest below g h / 512, which must be nothing beside the heat.
        run(world, apart, 0.02);
        for (const Vec2 x : world.positions()) {
            out[0] += (x.y - radius) / n / samples;
            for (std::size_t k = 0; k < above.size(); ++k)
                out[k + 1] += (x.y - radius > above[k]) / double(n) / samples;
        }
    }
    return out;
}

// Five discs that cover a thousandth of the place they have, over some thousand times in which they mix: 5 %.
TEST(Truth, gas_barometric_finiteN) {
    const auto& exact = truth("gas.barometric.finiteN");
    const auto measured = heights(5, 0.004, 1, {0.2}, 20000, 2.0);
    std::printf("five discs: mean height %.4f, above 0.2: %.4f\n", measured[0], measured[1]);
    EXPECT_NEAR(measured[0], exact[0].get<double>(), 0.05 * exact[0].get<double>());
    EXPECT_NEAR(measured[1], exact[1].get<double>(), 0.05 * exact[1].get<double>());
}

// Forty discs, kT = 1: (1 − h/80)^79 in place of exp(−h) is within 2 % up to h = 2.
TEST(Truth, gas_barometric) {
    const auto& exact = truth("gas.barometric");
    const auto measured = heights(40, 0.01, 80, {1, 2, 3}, 2000, 2.0);
    std::printf("forty discs: mean height %.4f, above 1, 2, 3: %.4f %.4f %.4f\n", measured[0], measured[1], measured[2],
                measured[3]);
    EXPECT_NEAR(measured[0], exact[0].get<double>(), 0.03);
    EXPECT_NEAR(measured[1], exact[1].get<double>(), 0.02);
    EXPECT_NEAR(measured[2], exact[2].get<double>(), 0.015);
    EXPECT_NEAR(measured[3], exact[3].get<double>(), 0.01);
}

}  // namespace
}  // namespace carom
