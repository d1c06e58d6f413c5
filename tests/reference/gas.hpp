#pragma once
// Gases that several tests need, and what is known about them.

#include <carom/carom.hpp>
#include <cmath>
#include <deque>
#include <vector>

namespace carom {

/// The collision rate of N discs in equilibrium is that of Maxwell's velocities times this, D = degrees of freedom.
inline double finite_rate(double degrees) {
    return std::sqrt(degrees / 2) * std::exp(std::lgamma(degrees / 2) - std::lgamma((degrees + 1) / 2));
}

struct Equilibrium {
    double rate;  ///< collisions of a disc per time, for N → ∞
    double mean_speed;
    double diffusion;  ///< from the mean squared way over the time between origins
};

/// Discs of unit diameter and mass at kT = 1 in a periodic box, at random places.
inline World periodic_gas(int count, double eta, const Settings& settings = {}, int seed = 4) {
    World world(settings);
    const double side = std::sqrt(count * M_PI / 4 / eta);
    world.add(Periodic{{0, 0}, {side, side}});
    build(world, Gas{.fill = {.low = {0, 0},
                              .high = {side, side},
                              .count = count,
                              .smallest_radius = 0.5,
                              .largest_radius = 0.5,
                              .seed = seed}});
    return world;
}

/// <v(0)·v(t)>/2 at t = 0, h, 2h, ... of a gas in a periodic box at kT = 1, with every step an origin. The momentum is
/// held at 0, which takes 1/N from it at all times.
inline std::vector<double> velocity_memory(World world, double h, int steps, std::size_t times) {
    const std::size_t n = world.size();
    run(world, 20 * h, h);
    std::deque<std::vector<Vec2>> past;  // the latest first
    std::vector<double> sum(times);
    for (int s = 0; s < steps; ++s) {
        world.step(h);
        past.emplace_front(world.velocities().begin(), world.velocities().end());
        if (past.size() < times) continue;
        for (std::size_t k = 0; k < times; ++k)
            for (std::size_t i = 0; i < n; ++i) sum[k] += dot(past[0][i], past[k][i]);
        past.pop_back();
    }
    for (double& each : sum)
        each = each / (2.0 * static_cast<double>(n) * (steps - static_cast<int>(times) + 1)) +
               1.0 / static_cast<double>(n);
    return sum;
}

inline Equilibrium measure(World world, double relax, double duration, int origins) {
    const double n = static_cast<double>(world.size()), degrees = 2 * n - 2;
    const double step = duration / origins;
    run(world, relax, relax / 4);
    const auto before = world.collisions();
    Equilibrium out{};
    for (int k = 0; k < origins; ++k) {
        const World origin = world;
        run(world, step, step / 4);
        for (std::size_t i = 0; i < world.size(); ++i) {
            out.mean_speed += length(world.velocities()[i]) / (n * origins);
            out.diffusion += squared_length(world.positions()[i] - origin.positions()[i]) / (4 * step * n * origins);
        }
    }
    out.rate = 2 * static_cast<double>(world.collisions() - before) / (n * duration) / finite_rate(degrees);
    return out;
}

inline double compressibility(double rate) { return 1 + rate * std::sqrt(M_PI) / 4; }

/// Kolafa and Rottner's equation of state, as truth.json's set-up has it.
inline double kolafa_rottner(double eta) {
    const std::pair<int, double> A[] = {{0, 1.0},
                                        {1, 2.0},
                                        {2, 1.12801775},
                                        {3, 0.00181895291},
                                        {4, -0.0526134737},
                                        {5, 0.0504960168},
                                        {6, -0.0325537792},
                                        {7, 0.0134578632},
                                        {8, 0.00140888182},
                                        {9, -0.00834273601},
                                        {10, 0.00694127367},
                                        {11, -0.00262254723},
                                        {12, 0.000355746352},
                                        {22, -5.24672938e-09},
                                        {57, 5.88054639e-23}};
    double z = 0;
    for (const auto& [power, a] : A) z += a * std::pow(eta / (1 - eta), power);
    return z;
}

/// Discs of unit mass and diameter under gravity, n over a unit of width, each layer as dense as a fluid would be under
/// the weight above it (the local density approximation).
class Column {
  public:
    Column(double n, double g, double kT) : n_(n), g_(g), kT_(kT) {}

    /// η of the layer that carries a share of the column.
    double eta(double share) const {
        double low = 0, high = 0.69;  // P = ρ kT Z rises with η
        while (high - low > 1e-14) {
            const double middle = 0.5 * (low + high);
            (4 / M_PI * middle * kT_ * kolafa_rottner(middle) < share * n_ * g_ ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    /// dP = −ρ g dy with P ∝ η Z: y = (kT/g) ∫ (Z/η + dZ/dη) dη from η to the floor's.
    double height(double eta_there) const {
        const int intervals = 200;  // Simpson's rule in ln η
        const double floor = eta(1), from = std::log(eta_there), h = (std::log(floor) - from) / intervals;
        double sum = 0;
        for (int k = 0; k <= intervals; ++k)
            sum += (k == 0 || k == intervals ? 1 : k % 2 ? 4 : 2) * kolafa_rottner(std::exp(from + k * h));
        return kT_ / g_ * (sum * h / 3 + kolafa_rottner(floor) - kolafa_rottner(eta_there));
    }

    /// Share of the column above a height.
    double share_above(double y) const {
        double low = 0, high = 1;
        while (high - low > 1e-9) {
            const double middle = 0.5 * (low + high);
            (height(eta(middle)) > y ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

  private:
    double n_, g_, kT_;
};

/// Points of speed 1 in a unit torus around a fixed disc (Sinai's billiard); places and directions are uniform, which
/// is the equilibrium.
inline World sinai_billiard(double radius, int points, std::uint64_t seed) {
    World world;
    world.add(Periodic{{-0.5, -0.5}, {0.5, 0.5}});
    world.add(Body{.kind = Kind::fixed, .radius = radius});
    Random random(seed);
    for (int i = 0; i < points;) {
        const Vec2 x{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
        if (length(x) <= radius) continue;
        const double angle = random.uniform(0, 2 * M_PI);
        world.add(Body{.position = x, .velocity = {std::cos(angle), std::sin(angle)}});
        ++i;
    }
    return world;
}

}  // namespace carom
