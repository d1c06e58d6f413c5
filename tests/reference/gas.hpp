#pragma once
// Gases that several tests need, and what is known about them.

#include <carom/carom.hpp>
#include <cmath>

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

/// Discs of unit diameter and mass at kT = 1 in a periodic box.
inline World periodic_gas(int count, double eta) {
    World world;
    const double side = std::sqrt(count * M_PI / 4 / eta);
    world.add(Periodic{{0, 0}, {side, side}});
    build(world, Gas{.fill = {.low = {0, 0},
                              .high = {side, side},
                              .count = count,
                              .smallest_radius = 0.5,
                              .largest_radius = 0.5,
                              .seed = 4}});
    return world;
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
