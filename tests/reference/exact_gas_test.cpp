#include "reference/exact_gas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <carom/gas.hpp>
#include <cmath>

#include "reference/truth.hpp"

// The solver 'events' held against what is known of hard discs. Runs are a few seconds long; with CAROM_NIGHTLY set
// they are thirty times as long, and the tolerances, four standard errors each, accordingly smaller.

namespace carom {
namespace {

TEST(ExactTruth, gas_eos_kr) {
    const auto& table = truth("gas.eos.kr");
    for (const int k : {2, 4, 6, 8}) {  // η = 0.1, 0.3, 0.5, 0.6
        const double eta = table[k][0], exact = table[k][1], rate = 4 / std::sqrt(M_PI) * (exact - 1);
        const Pressure p = pressure(lattice_gas(40, 46, eta), rate, 1000 * much());
        std::printf("eta %.2f: Z %.5f ± %.5f, exact %.5f; rate %.4f, exact %.4f\n", eta, p.z, p.error, exact,
                    p.rate / finite_rate(2 * 1840 - 2), rate);
        // The box of N discs has a Z that differs by some 1/N of Z − 1.
        EXPECT_NEAR(p.z, exact, 4 * p.error + 2 * (exact - 1) / 1840) << eta;
        EXPECT_LT(p.error, 2e-3 * exact / many());
        EXPECT_NEAR(p.rate / finite_rate(2 * 1840 - 2), rate,
                    (4 * p.error + 2 * (exact - 1) / 1840) * 4 / std::sqrt(M_PI));
    }
}

// The fit at its two densities and at two between. It is met within 0.1 % from 0.76 on, and falls short of the crystal
// the nearer that comes to melting: by 0.5 % at 0.74, 0.9 % at 0.73 and 1.3 % at 0.72, where Z is 9.899 ± 0.003 for
// 1020 discs after 3000 collisions of each and over 20000, 9.913 ± 0.004 for 4200, 9.921 ± 0.004 for 11600 and 9.909 ±
// 0.002 for 29440. So it is not the size. The fit goes near the million discs of gas_melting_engel, 10.069 at 0.72,
// which took 1e6 collisions of each to become what they are, no crystal but just about to melt; a crystal that starts
// without defects keeps out of that: 1020 discs still have 9.91 after 1e6 collisions of each. So it is not the time
// alone either. There 1.5 % is what holds, and not the 1 % of the entry.
TEST(ExactTruth, gas_solid) {
    const auto& entry = truth_entry("gas.solid");
    const double tolerance = entry["tolerance"];
    const auto fit = [](double eta) {
        const double alpha = M_PI / 2 / std::sqrt(3) / eta - 1;
        return 2 / alpha + 1.9 + alpha - 5.2 * alpha * alpha + 114.48 * std::pow(alpha, 4);
    };
    ASSERT_NEAR(fit(0.72), entry["value"][0].get<double>(), 1e-12);
    ASSERT_NEAR(fit(0.80), entry["value"][1].get<double>(), 1e-12);
    for (const double eta : {0.72, 0.74, 0.76, 0.80}) {
        const double exact = fit(eta), rate = 4 / std::sqrt(M_PI) * (exact - 1);
        const Pressure p = pressure(lattice_gas(30, 34, eta), rate, 1000 * much());
        std::printf("eta %.2f: Z %.4f ± %.4f, fit %.4f\n", eta, p.z, p.error, exact);
        EXPECT_NEAR(p.z, exact, (eta == 0.72 ? 0.015 : tolerance) * exact) << eta;
        EXPECT_LT(p.error, 2.5e-3 * exact);
    }
}

TEST(ExactTruth, gas_twodisc_box) {
    World world({.solver = Events{}});
    world.add(Rectangle{});
    world.add(Body{.position = {0.3, 0.4}, .velocity = {1, 0.2}, .radius = 0.15});
    const double rest = 2 - 1.04;
    world.add(
        Body{.position = {0.7, 0.6}, .velocity = {-0.6 * std::sqrt(rest), 0.8 * std::sqrt(rest)}, .radius = 0.15});
    ASSERT_NEAR(energy(world).kinetic, 1, 1e-12);
    const double time = 1e5 * much();
    double fourth = 0, second = 0;
    const int samples = 20000;
    for (int k = 0; k < samples; ++k) {
        world.step(time / samples);
        for (const Vec2 v : world.velocities()) second += squared_length(v), fourth += std::pow(squared_length(v), 2);
    }
    const auto& exact = truth("gas.twodisc.box");
    const GasTally tally = world.gas();
    const double tolerance = 0.02 / many();  // some 1e6 events; truth.json has 4e-3 for 1e7
    const auto near = [&](double value, const char* name) {
        const double e = exact[name];
        std::printf("%s %.5f, exact %.5f\n", name, value, e);
        EXPECT_NEAR(value, e, tolerance * e) << name;
    };
    near(tally.wall_impulse / (4 * time), "force_x_wall");
    near(static_cast<double>(tally.wall_collisions) / (4 * time), "rate_one_x_wall");
    near(static_cast<double>(tally.disc_collisions) / time, "rate_disc_disc");
    near(2 * samples * fourth / (second * second), "v4_over_v2sq");
}

TEST(ExactTruth, gas_sinai_mft) {
    const auto& exact = truth("gas.sinai.mft.list");
    const double radii[] = {0.1, 0.2, 0.3, 0.4};
    // Of one such run, measured over 60 of them: paths along the rows of discs can be very long.
    const double spread[] = {0.0100, 0.0066, 0.0046, 0.0032};
    for (int k = 0; k < 4; ++k) {
        World world = exact_sinai(radii[k], 200);
        const double time = 500 * much();
        run(world, time, time / 4);
        const double free = 200 * time / static_cast<double>(world.collisions());
        std::printf("R %.1f: mean free time %.5f, exact %.5f\n", radii[k], free, exact[k].get<double>());
        EXPECT_NEAR(free, exact[k].get<double>(), 4 * spread[k] / many() * exact[k].get<double>());
    }
}

// Pairs of neighbours: how fast they part, with their distance set back to 1e-7 after every unit of time. Points do not
// meet.
double sinai_exponent(double radius, int pairs) {
    World world = exact_sinai(radius, 2 * pairs);
    const auto ids = world.ids();
    const double apart = 1e-7;
    double sum = 0, time = 0;
    const auto join = [&](int k) {
        const BodyId a = ids[1 + 2 * k], b = ids[2 + 2 * k];
        Vec2 dx = world.position(b) - world.position(a), dv = world.velocity(b) - world.velocity(a);
        const double distance = std::sqrt(squared_length(dx) + squared_length(dv));
        if (time == 0) {
            dx = 1e-7 * perpendicular(world.velocity(a)), dv = {};
        } else {
            sum += std::log(distance / apart);
            dx *= apart / distance, dv *= apart / distance;
        }
        const Vec2 v = world.velocity(a) + dv;
        world.set_position(b, world.position(a) + dx, 0);
        world.set_velocity(b, v / length(v), 0);
    };
    for (int k = 0; k < pairs; ++k) join(k);
    const int steps = static_cast<int>(200 * much());
    for (int s = 0; s < steps + 10; ++s) {
        world.step(1);
        if (s == 10) sum = 0;  // until the distances have the direction that grows
        time += 1;
        // A pair of which one has missed the disc is no pair of neighbours any more.
        for (int k = 0; k < pairs; ++k) join(k);
    }
    return sum / (pairs * steps);
}

// Of smaller discs the impacts are too rare for a second of computing.
TEST(ExactTruth, gas_sinai_lyapunov) {
    const auto& table = truth("gas.sinai.lyapunov");
    for (std::size_t k = 3; k < table.size(); ++k) {
        const double radius = table[k][0], exact = table[k][1];
        const double lambda = sinai_exponent(radius, 100);
        std::printf("R %.2f: Lyapunov exponent %.4f, exact %.4f\n", radius, lambda, exact);
        EXPECT_NEAR(lambda, exact, 0.025 * exact);
    }
}

TEST(ExactTruth, ed_galperin) {
    const auto& counts = truth("ed.galperin");
    const auto collisions = [](double ratio) {
        World world({.solver = Events{}});
        world.add(HalfPlane{.normal = {1, 0}});
        world.add(Body{.position = {1, 0}, .radius = 0.1});
        world.add(Body{.position = {2, 0}, .velocity = {-1, 0}, .mass = ratio, .radius = 0.2});
        world.step(1e5);  // the last one may come late
        return world.collisions();
    };
    for (int n = 0; n <= (much() > 1 ? 7 : 6); ++n)
        EXPECT_EQ(collisions(std::pow(100.0, n)), counts[n].get<std::uint64_t>()) << n;
    for (int n = 0; n <= 20; ++n)  // π in binary
        EXPECT_EQ(collisions(std::pow(4.0, n)), static_cast<std::uint64_t>(std::floor(std::ldexp(M_PI, n)))) << n;
}

TEST(ExactTruth, ed_gas1d) {
    const auto& counts = truth("ed.gas1d");
    const int sizes[] = {3, 10, 100, 1000};
    for (int k = 0; k < 4; ++k) {
        World world({.solver = Events{}});
        const int n = sizes[k];
        Random random(7);
        std::vector<double> v(static_cast<std::size_t>(n));
        for (int i = 0; i < n; ++i) v[i] = 1 - 2 * (i + random.uniform(0, 0.5)) / n;  // strictly decreasing
        for (int i = 0; i < n; ++i) world.add(Body{.position = {1.0 * i, 0}, .velocity = {v[i], 0}, .radius = 0.2});
        world.step(0.65 * n);
        EXPECT_EQ(world.collisions(), counts[k].get<std::uint64_t>()) << n;
        for (int i = 0; i < n; ++i) EXPECT_NEAR(world.velocities()[i].x, v[n - 1 - i], 1e-13) << n << " " << i;
    }
}

TEST(ExactTruth, ed_bounce) {
    World world({.gravity = {0, -9.81}, .solver = Events{.collapse = 1e-12}});
    world.add(HalfPlane{});
    world.add(Body{.position = {0, 1}, .restitution = 0.8});
    const double tenth = truth("ed.bounce")[2];
    const double tolerance = truth_entry("ed.bounce")["tolerance"];
    world.step(tenth - tolerance);
    EXPECT_EQ(world.collisions(), 9u);
    world.step(2 * tolerance);
    EXPECT_EQ(world.collisions(), 10u);
    // Just before the end of all bounces nothing is left of the energy: 1 − e^2n of it is heat.
    world.step(truth("ed.bounce")[0].get<double>() - world.time() - 1e-6);
    EXPECT_GT(world.collisions(), 60u);
    EXPECT_NEAR(energy(world).heat.impact, 9.81, 1e-9);
}

// As in events_test.cpp: above the threshold the map of velocities ends, and as the gas does.
TEST(ExactTruth, ed_collapse3) {
    const double threshold = truth("ed.collapse3");
    const auto run_with = [](double restitution) {
        World world({.solver = Events{.collapse = 1e-12}});
        const double x[] = {0, 1, 2.1}, v[] = {1, 0, -1};
        for (int i = 0; i < 3; ++i)
            world.add(Body{.position = {x[i], 0}, .velocity = {v[i], 0}, .radius = 0.1, .restitution = restitution});
        world.step(20);
        return world.gas();
    };
    EXPECT_EQ(run_with(1.05 * threshold).made_elastic, 0u);
    EXPECT_GT(run_with(0.9 * threshold).made_elastic, 0u);
}

TEST(ExactTruth, gas_relax_a2) {
    // All of one speed: Maxwell's distribution comes by collisions, as fast as Boltzmann's equation says.
    World world = lattice_gas(300, 306, 0.02);
    Random random(9);
    for (const BodyId id : world.ids()) {
        const double angle = random.uniform(0, 2 * M_PI);
        world.set_velocity(id, {std::cos(angle), std::sin(angle)}, 0);
    }
    const double n = static_cast<double>(world.size());
    const auto& table = truth("gas.relax.a2");
    std::size_t next = 1;
    while (next < table.size()) {
        world.step(2.5);
        const double s = 2 * static_cast<double>(world.gas().disc_collisions) / n;
        while (next < table.size() && s > table[next][0]) ++next;
        if (next == table.size()) break;
        // Between two rows it falls as an exponential.
        const double s0 = table[next - 1][0], s1 = table[next][0], a0 = table[next - 1][1], a1 = table[next][1];
        const double exact = a0 * std::pow(a1 / a0, (s - s0) / (s1 - s0));
        double second = 0, fourth = 0;
        for (const Vec2 v : world.velocities())
            second += squared_length(v) / n, fourth += std::pow(squared_length(v), 2) / n;
        const double a2 = fourth / (2 * second * second) - 1;
        std::printf("%.2f collisions of a disc: a2 %.4f, exact %.4f\n", s, a2, exact);
        // Two standard errors of 9e4 discs, the rows between, and a density that is not 0.
        EXPECT_NEAR(a2, exact, 0.02);
    }
}

TEST(ExactTruth, haffs_law) {
    const double e = 0.95;
    World world = lattice_gas(60, 70, 0.05, {.restitution = e});
    collide(world, 1, 0.25);
    const double n = static_cast<double>(world.size()), before = energy(world).kinetic;
    const auto hits = world.gas().disc_collisions;
    run(world, 30, 1);
    const double each = static_cast<double>(world.gas().disc_collisions - hits) / n;
    const double law = std::exp(-(1 - e * e) * each), now = energy(world).kinetic / before;
    std::printf("%.3f collisions a disc: T/T0 %.4f, Haff %.4f\n", each, now, law);
    EXPECT_NEAR(now / law, 1, 0.01);  // some thousand collisions a percent, and correlations
    EXPECT_NEAR(energy(world).unaccounted(), 0, 1e-9);
}

TEST(ExactTruth, gas_maxwell_finiteN) {
    const int counts[] = {2, 5, 10, 100};
    for (int k = 0; k < 4; ++k) {
        const int n = counts[k], side = n > 10 ? 10 : 4;
        World world({.solver = Events{}});
        world.add(Rectangle{{0, 0}, {side + 2.0, side + 2.0}});
        Random random(1);
        for (int i = 0; i < n; ++i) {
            const double vx = random.normal();
            world.add(
                Body{.position = {1.0 + i % side, 1.0 + i / side}, .velocity = {vx, random.normal()}, .radius = 0.3});
        }
        const double kT = energy(world).kinetic / n;
        double second = 0, fourth = 0;
        const int samples = static_cast<int>(2e5 * much() / n);
        for (int s = 0; s < samples; ++s) {
            world.step(3 / std::sqrt(kT));
            for (const Vec2 v : world.velocities())
                second += squared_length(v), fourth += std::pow(squared_length(v), 2);
        }
        const double ratio = static_cast<double>(samples) * n * fourth / (second * second);
        std::printf("%d discs: %.4f, exact %.4f\n", n, ratio, truth("gas.maxwell.finiteN")[k].get<double>());
        // 2e5 speeds whose v⁴ scatters by some 2: four standard errors.
        EXPECT_NEAR(ratio, truth("gas.maxwell.finiteN")[k].get<double>(), 0.03 / many());
    }
}

TEST(ExactTruth, gas_barometric_finiteN) {
    // Five discs of next to no area under gravity, E = 1: mean heights of 0.1, and P(m g y > 0.2).
    const int n = 5;
    World world({.gravity = {0, -1}, .solver = Events{}});
    const double r = 0.004, width = 0.2;
    world.add(HalfPlane{});
    world.add(HalfPlane{.normal = {1, 0}});
    world.add(HalfPlane{.point = {width, 0}, .normal = {-1, 0}});
    for (int k = 0; k < n; ++k) world.add(Body{.position = {0.03 + 0.035 * k, 0.1 + 0.05 * k + r}, .radius = r});
    double potential = 0;
    for (const Vec2 x : world.positions()) potential += x.y - r;
    ASSERT_NEAR(potential, 1, 1e-12);
    world.set_velocity(world.ids()[0], {1e-3, 0}, 0);
    double mean = 0, above = 0;
    const int samples = static_cast<int>(200000 * much());
    for (int k = 0; k < samples; ++k) {
        world.step(0.5);
        for (const Vec2 x : world.positions()) mean += x.y - r, above += x.y - r > 0.2;
    }
    const double all = static_cast<double>(samples) * n;
    std::printf("mean %.5f, above %.5f\n", mean / all, above / all);
    EXPECT_NEAR(mean / all, truth("gas.barometric.finiteN")[0].get<double>(), 2e-3);
    EXPECT_NEAR(above / all, truth("gas.barometric.finiteN")[1].get<double>(), 5e-3);
}

TEST(ExactTruth, gas_adiabat) {
    // A wall that moves in slowly, as a driven segment, halves the room of 400 small discs.
    World world({.solver = Events{}});
    world.add(Rectangle{{-0.1, 0}, {2, 1}});
    const BodyId piston = world.add(Body{.kind = Kind::driven,
                                         .position = {0, 0.5},
                                         .velocity = {0.01, 0},
                                         .shapes = {{.geometry = Segment{{0, -0.5}, {0, 0.5}}}}});
    Random random(2);
    const double r = 0.0005;
    for (int k = 0; k < 400; ++k)
        world.add(Body{.position = {0.05 + 0.09 * (k % 20), 0.025 + 0.05 * (k / 20)},
                       .velocity = {random.normal(), random.normal()},
                       .radius = r});
    const double before = energy(world).kinetic;
    run(world, 100, 1);
    EXPECT_NEAR(world.position(piston).x, 1, 1e-12);
    const Energy now = energy(world);
    std::printf("T2/T1 %.4f\n", now.kinetic / before);
    EXPECT_NEAR(now.kinetic / before, truth("gas.adiabat")[0].get<double>(),
                0.05);  // 400 discs, and not infinitely slow
    EXPECT_NEAR(now.work.driven, now.kinetic - before, 1e-10);
}

TEST(ExactGasMeter, SeesMaxwellAndThePressure) {
    const double eta = 0.3, rate = truth("gas.enskog.rate")[4][2];
    World world = lattice_gas(30, 34, eta);
    collide(world, 30, rate);
    GasMeter meter(world);
    run(world, 100 * much(), 0.05, [&](const World& w) { meter.observe(w); });
    const auto value = [&](const std::string& name) {
        for (const GasNumber& n : meter.numbers())
            if (n.name == name) return n;
        ADD_FAILURE() << name;
        return GasNumber{};
    };
    for (const GasNumber& n : meter.numbers())
        std::printf("%-24s %.6f ± %.6f %s\n", n.name.c_str(), n.value, n.error, n.unit.c_str());
    EXPECT_NEAR(value("temperature k T").value, 1, 1e-12);
    const double density = 4 / M_PI * eta, exact = density * truth("gas.eos.kr")[4][1].get<double>();
    const GasNumber p = value("pressure by the virial");
    EXPECT_NEAR(p.value, exact, 4 * p.error + 3e-3);
    EXPECT_LT(p.error, 0.01 * exact);
    EXPECT_GT(p.error, 1e-4 * exact);
    const GasNumber hits = value("collisions of a disc");
    EXPECT_NEAR(hits.value, rate * finite_rate(2 * 1020 - 2), 4 * hits.error + 2e-3 * rate);
    for (const GasCurve& c : meter.curves()) {
        if (c.name == "speeds") {
            for (std::size_t k = 0; k < c.x.size(); ++k) EXPECT_NEAR(c.y[k], c.law[k], 5 * c.error[k] + 4e-3) << c.x[k];
        }
        if (c.name == "pair correlation") {
            // At contact g is χ = (Z − 1)/(2 η), and the last of the bins is far away.
            const auto first = static_cast<std::size_t>(std::ceil(1 / (c.x[1] - c.x[0])));
            EXPECT_EQ(c.y[first - 2], 0);
            EXPECT_NEAR(c.y[first], truth("gas.enskog.rate")[4][1].get<double>(), 0.12);  // a bin is 0.07 wide
            EXPECT_NEAR(c.y.back(), 1, 0.02);
        }
    }
}

}  // namespace
}  // namespace carom
