#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>
#include <map>

#include "reference/gas.hpp"
#include "reference/truth.hpp"

// Laws of gases that are compressed, that stand under gravity, that forget and that remember. As in gas_test.cpp, a
// tolerance is about four standard errors of a run of a few seconds, and the seeds are fixed.

namespace carom {
namespace {

/// Points in a box of height 1 and with a round piston for its right side; inside is a fixed disc. Both turn what flies
/// between parallel walls, which a flat piston would long not: all directions are alike at any time.
struct Cylinder {
    World world;
    BodyId piston;

    static constexpr double piston_radius = 1, disc_radius = 0.3;
    static constexpr Vec2 disc{0.45, 0.4};

    double area() const {
        const double r = piston_radius, segment = 0.5 * std::sqrt(r * r - 0.25) + r * r * std::asin(0.5 / r);
        return world.position(piston).x - segment - M_PI * disc_radius * disc_radius;
    }
    void move(double velocity) { world.set_velocity(piston, {velocity, 0}, 0); }
};

Cylinder cylinder(int points, double piston_at, Random& random) {
    const double r = Cylinder::piston_radius;
    Cylinder out{.world = World{}, .piston = {}};
    out.world.add(HalfPlane{.normal = {1, 0}});
    out.world.add(HalfPlane{});
    out.world.add(HalfPlane{.point = {0, 1}, .normal = {0, -1}});
    out.world.add(Body{.kind = Kind::fixed, .position = Cylinder::disc, .radius = Cylinder::disc_radius});
    const Vec2 piston{piston_at, 0.5};
    out.piston = out.world.add(Body{.kind = Kind::driven, .position = piston, .radius = r});
    for (int i = 0; i < points;) {
        const Vec2 x{random.uniform(0, piston.x), random.uniform()};
        if (length(x - Cylinder::disc) <= Cylinder::disc_radius || length(x - piston) <= r) continue;
        const double vx = random.normal();
        out.world.add(Body{.position = x, .velocity = {vx, random.normal()}});
        ++i;
    }
    return out;
}

/// What the left wall, 1 high, takes up of x momentum while the piston stands.
double push(Cylinder& gas, double duration, double step) {
    const double before = momentum_balance(gas.world).walls.linear.x;
    run(gas.world, duration, step);
    return momentum_balance(gas.world).walls.linear.x - before;
}

// Points do not meet, so forty boxes with 25 each are one gas of 1000. A point's energy is doubled to 17 %, hence the
// temperature to 0.5 %, and a piston of this speed heats by half a percent more than a slow one: 2 %, as truth.json has
// it. The left wall is hit 30000 times before and 80000 times after, by the same points again and again: 5 %.
TEST(Truth, gas_adiabat) {
    const int boxes = 40, points = 25;
    const double speed = 0.005, hold = 120, step = 0.6;
    double kinetic1 = 0, kinetic2 = 0, push1 = 0, push2 = 0, area = 0, worst = 0;
    Random random(11);
    for (int k = 0; k < boxes; ++k) {
        Cylinder gas = cylinder(points, 2.9, random);
        area = gas.area();
        push1 += push(gas, hold, step);
        const double initial = energy(gas.world).kinetic;
        gas.move(-speed);
        run(gas.world, area / 2 / speed, step);
        gas.move(0);
        ASSERT_NEAR(gas.area(), area / 2, 1e-9);
        const Energy now = energy(gas.world);
        kinetic1 += initial, kinetic2 += now.kinetic;
        push2 += push(gas, hold, step);
        worst = std::max(worst, std::abs(now.work.driven / (now.kinetic - initial) - 1));
    }
    const auto& exact = truth("gas.adiabat");
    const double p1 = push1 / hold, p2 = push2 / hold;  // of all boxes at once, as kinetic = N kT is
    std::printf("T2/T1 %.4f, P2/P1 %.4f, P A/(N kT) %.4f and %.4f, work of the piston off by %.1g\n",
                kinetic2 / kinetic1, p2 / p1, p1 * area / kinetic1, p2 * area / 2 / kinetic2, worst);
    EXPECT_NEAR(kinetic2 / kinetic1, exact[0].get<double>(), 0.02 * exact[0].get<double>());
    EXPECT_NEAR(p2 / p1, exact[1].get<double>(), 0.05 * exact[1].get<double>());
    EXPECT_NEAR(p1 * area / kinetic1, 1, 0.04);
    EXPECT_NEAR(p2 * area / 2 / kinetic2, 1, 0.03);
    EXPECT_LT(worst, 1e-10);  // rounding of some hundred impacts
}

constexpr double gravity = 0.05, per_width = 20, width = 40;

/// The column at kT = 1 in rows of equal numbers, on a floor of fixed discs; no disc comes below y = 0.
World atmosphere() {
    const Column column(per_width, gravity, 1);
    World world({.gravity = {0, -gravity}});
    world.add(Periodic{{0, -500}, {width, 500}});  // 25 times what a disc can climb: the top is never reached
    for (int i = 0; i < 2 * width; ++i) world.add(Body{.kind = Kind::fixed, .position = {0.5 * i, -1}, .radius = 0.5});
    Random random(7);
    const int rows = 2 * static_cast<int>(per_width), per_row = static_cast<int>(width) / 2;
    for (int row = 0; row < rows; ++row) {
        const double y = column.height(column.eta(1 - (row + 0.5) / rows));
        for (int i = 0; i < per_row; ++i) {
            const double vx = random.normal();
            world.add(Body{.position = {2 * i + row % 2 + 0.25, y}, .velocity = {vx, random.normal()}, .radius = 0.5});
        }
    }
    return world;
}

/// Kinetic energy of a disc, which is kT.
double temperature(const World& world) { return energy(world).kinetic / (per_width * width); }

/// Lets the discs forget their rows and gives them kT = 1 in the mean, not just for an instant.
void relax(World& world, double duration, double step) {
    run(world, duration, step);
    double mean = 0;
    const int samples = 40;
    for (int k = 0; k < samples; ++k) {
        run(world, duration / samples, step);
        mean += temperature(world) / samples;
    }
    for (const BodyId id : world.ids())
        if (world.velocity(id) != Vec2{})
            world.set_velocity(id, world.velocity(id) / std::sqrt(mean), world.angular_velocity(id));
    run(world, duration / 4, step);
}

struct Profile {
    std::map<int, double> eta;  ///< mean packing fraction in bins from the floor up
    double kT = 0;
};

Profile profile(World& world, double bin, int samples, double apart, double step) {
    Profile out;
    for (int s = 0; s < samples; ++s) {
        run(world, apart, step);
        out.kT += temperature(world) / samples;
        for (const Vec2 x : world.positions())
            out.eta[static_cast<int>(std::floor(x.y / bin))] += M_PI / 4 / (samples * width * bin);
    }
    return out;
}

// 800 discs for 1600 units of time. What is warmer here and colder there passes away slowly, so that a bin knows its η
// to 1 % and the height of η = 0.1 is known to 0.4, as runs from other seeds show. The layers that the floor makes, all
// in the first bin, hold 0.16 discs a width more than the column has there: what is above lies 0.4 lower.
TEST(Truth, gas_hydrostatic) {
    const auto& exact = truth("gas.hydrostatic");
    const Column cold(per_width, gravity, 1);
    EXPECT_NEAR(cold.eta(1), exact[0].get<double>(), 1e-6);
    EXPECT_NEAR(cold.height(0.1), exact[1].get<double>(), 1e-6);

    World world = atmosphere();
    relax(world, 80, 0.3);
    const double bin = 4, before = momentum_balance(world).held.linear.y, began = world.time();
    Profile found = profile(world, bin, 750, 2.1, 0.3);
    const double pressure = (momentum_balance(world).held.linear.y - before) / (world.time() - began) / width;
    const Column column(per_width, gravity, found.kT);
    double worst = 0, at_floor = 0;
    int last = 0;  // the last bin denser than 0.1
    for (int k = 1; k < 14; ++k) {
        const double expected =
            M_PI / 4 * per_width * (column.share_above(k * bin) - column.share_above((k + 1) * bin)) / bin;
        EXPECT_NEAR(found.eta[k], expected, 0.04 * expected) << k * bin;
        worst = std::max(worst, std::abs(found.eta[k] / expected - 1));
        // Near the floor η falls in a line: that of least squares through four bins goes on to this at y = 0.
        if (k <= 4) at_floor += found.eta[k] * (0.25 - 0.15 * (bin * k - 10));
    }
    while (found.eta[last + 1] > 0.1) ++last;
    const double falls = std::log(found.eta[last] / found.eta[last + 1]);  // where η is 0.1, as an exponential
    const double height = bin * (last + 0.5 + std::log(found.eta[last] / 0.1) / falls);
    std::printf("kT %.4f, P0 %.4f, worst bin off by %.3f, eta at the floor %.4f, eta = 0.1 at %.2f\n", found.kT,
                pressure, worst, at_floor, height);
    EXPECT_NEAR(found.kT, 1, 0.04);   // the heat that was given at once, and what potential energy then took of it
    EXPECT_NEAR(pressure, 1, 0.004);  // n g, but for the momentum that is in the column at either end
    EXPECT_NEAR(at_floor, exact[0].get<double>(), 0.04 * exact[0].get<double>());
    EXPECT_NEAR(height, exact[1].get<double>(), 2);
}

// The same billiard twice, the points of the second 1e-8 beside those of the first; what has grown is shrunk again.
struct Growth {
    double per_time, per_collision;
};

Growth growth(double radius, int points, double relax, double duration) {
    const double beside = 1e-8, every = 1, step = 0.25;
    World world = sinai_billiard(radius, points, 3);
    World other = world;
    for (const BodyId id : other.ids())
        if (other.body(id).kind == Kind::dynamic) other.set_position(id, other.position(id) + Vec2{beside, 0}, 0);
    double sum = 0, from = 0;
    std::uint64_t impacts = 0;
    while (world.time() < duration + relax - 0.5 * every) {
        run(world, every, step);
        run(other, every, step);
        const bool counts = world.time() > relax + 0.5 * every;
        if (!counts) from = world.time(), impacts = world.collisions();
        for (const BodyId id : world.ids()) {
            if (world.body(id).kind == Kind::fixed) continue;
            const Vec2 x = world.position(id), v = world.velocity(id);
            const Vec2 dx = other.position(id) - x, dv = other.velocity(id) - v;
            const double apart = std::sqrt(squared_length(dx) + squared_length(dv));
            if (counts) sum += std::log(apart / beside) / points;
            other.set_position(id, x + beside / apart * dx, 0);
            other.set_velocity(id, v + beside / apart * dv, 0);
        }
    }
    const double time = world.time() - from;
    return {sum / time, sum * points / static_cast<double>(world.collisions() - impacts)};
}

// A hundred points for 400 units of time, as seen from others: λ per collision is known to 0.3 %. Per time it also
// depends on how often there are collisions, and points that fly long ways between them make that uneven, the more the
// smaller the disc is: 0.9 %, 0.6 % and 0.2 %.
TEST(Truth, gas_sinai_lyapunov) {
    const std::map<double, double> tolerances{{0.1, 0.036}, {0.2, 0.024}, {0.4, 0.009}};
    std::size_t found = 0;
    for (const auto& row : truth("gas.sinai.lyapunov")) {
        const auto tolerance = tolerances.find(row[0]);
        if (tolerance == tolerances.end()) continue;
        const Growth measured = growth(row[0], 100, 20, 400);
        std::printf("R %.1f: lambda %.4f (off by %.2g), per collision %.4f (%.2g)\n", tolerance->first,
                    measured.per_time, measured.per_time / row[1].get<double>() - 1, measured.per_collision,
                    measured.per_collision / row[2].get<double>() - 1);
        EXPECT_NEAR(measured.per_time, row[1].get<double>(), tolerance->second * measured.per_time);
        EXPECT_NEAR(measured.per_collision, row[2].get<double>(), 0.012 * measured.per_collision);
        ++found;
    }
    EXPECT_EQ(found, tolerances.size());
}

// The prefactor is known to 4 %, as other seeds show, and Enskog's coefficients to as much. The exponent is that
// between the mean memory over 3 to 6 and over 6 to 12: 8 %, and before 6 what is forgotten at once still adds 10 %.
// After 12 the sound that a disc sends meets that of its images.
TEST(Truth, gas_vacf_tail) {
    const double eta = 0.3, h = 0.5, rho = 4 / M_PI * eta, contact = (kolafa_rottner(eta) - 1) / (2 * eta);
    // Enskog's coefficients (Gass, J. Chem. Phys. 54, 1898 (1971)).
    const double y = 2 * eta * contact, D = 1 / (2 * rho * contact * std::sqrt(M_PI));
    const double viscosity = 1.022 / (2 * std::sqrt(M_PI)) * 2 * eta * (1 / y + 1 + 0.8729 * y);
    const auto memory = velocity_memory(periodic_gas(2000, eta), h, 1600, 25);
    const auto mean = [&](double from, double to, int power) {  // of t^power C(t), by the trapezoidal rule
        double sum = 0;
        const int first = static_cast<int>(from / h), last = static_cast<int>(to / h);
        for (int k = first; k <= last; ++k)
            sum += (k == first || k == last ? 0.5 : 1) * std::pow(k * h, power) * memory[static_cast<std::size_t>(k)];
        return sum / (last - first);
    };
    const double prefactor = mean(4, 12, 1) * rho * (D + viscosity / rho);
    const double exponent = std::log2(mean(6, 12, 0) / mean(3, 6, 0));
    const auto& exact = truth("gas.vacf.tail");
    std::printf("tail of the velocities' memory: prefactor %.4f (of the truth %.3f), exponent %.3f\n", prefactor,
                prefactor / exact[1].get<double>(), exponent);
    EXPECT_NEAR(prefactor, exact[1].get<double>(), 0.2 * exact[1].get<double>());
    EXPECT_NEAR(exponent, exact[0].get<double>(), 0.4);
}

// Henderson, Mol. Phys. 30, 971 (1975), and Santos, López de Haro and Yuste, J. Chem. Phys. 103, 4622 (1995).
double henderson(double eta) { return (1 + eta * eta / 8) / ((1 - eta) * (1 - eta)); }
double santos(double eta) {
    const double closest = truth("gas.closepacking").get<double>();
    return 1 / (1 - 2 * eta + (2 * closest - 1) * eta * eta / closest / closest);
}

// A fluid's Z − 1 is known to 1.5 % from its collision rate, as in gas_eos_from_the_collision_rate. Henderson's formula
// is good to 1 % of Z, as truth.json says; Santos' is up to 1.6 % of Z from gas.eos.kr at
// these densities: 2 %.
TEST(Truth, gas_eos_henderson_and_santos) {
    const double etas[] = {0.1, 0.3, 0.5, 0.65};
    for (int k = 0; k < 4; ++k) {
        const double eta = etas[k];
        EXPECT_NEAR(henderson(eta), truth("gas.eos.henderson")[k].get<double>(), 1e-12);
        EXPECT_NEAR(santos(eta), truth("gas.eos.santos")[k].get<double>(), 1e-12);
        if (k == 3) break;  // more than random places can be found for
        const double z = compressibility(measure(periodic_gas(400, eta), 10, eta < 0.2 ? 200 : 40, 4).rate);
        std::printf("eta %.1f: Z %.4f, Henderson %.4f, Santos %.4f\n", eta, z, henderson(eta), santos(eta));
        EXPECT_NEAR(z, henderson(eta), 0.01 * z + 0.015 * (z - 1));
        EXPECT_NEAR(z, santos(eta), 0.02 * z + 0.015 * (z - 1));
    }
}

// A blow of 1 N s at the end of a rod of 1 m and 1 kg, in a step in which the rod turns by 3e-8: no more than its
// square is lost of the lever.
TEST(Truth, mech_spinrod) {
    const double h = 1e-8, half = 0.5;
    World world({.solver = NoContact{}});
    const BodyId rod = world.add(Body{.mass = 1, .moment_of_inertia = 1.0 / 12});
    world.add(ConstantForce{.body = rod, .force = {0, 1 / h}, .point = {half, 0}});
    world.step(h);
    const double v = world.velocity(rod).y, omega = world.angular_velocity(rod);
    const auto& exact = truth("mech.spinrod");
    EXPECT_NEAR(v, exact[0].get<double>(), 1e-12);
    EXPECT_NEAR(omega, exact[1].get<double>(), 1e-12);
    EXPECT_NEAR(v + omega * half, exact[2].get<double>(), 1e-12);
    EXPECT_NEAR(v - omega * half, exact[3].get<double>(), 1e-12);
    EXPECT_NEAR(half + v / omega, exact[4].get<double>(), 1e-12);  // from the struck end to the point that rests
    const Energy e = energy(world);
    EXPECT_NEAR(e.kinetic + e.rotational, 0.5 * exact[2].get<double>(), 1e-12);  // ½ J times the struck end's speed
}

}  // namespace
}  // namespace carom
