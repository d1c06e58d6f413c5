#pragma once
// Contact points of an island as Newton's method sees them.

#include <algorithm>
#include <cmath>
#include <span>

#include "solvers/island_row.hpp"

namespace carom::newton {

/// A direction in which a contact point pushes: impulse = weight (target − speed), within bounds.
struct Direction {
    IslandRow row;
    double mass, wanted;  ///< effective mass, and the speed that is wanted
    double warm;          ///< impulse that the force before gives
    double arm;           ///< by which turning is compared with what moves [m]; else 1
    double weight = 0, target = 0;
    double speed = 0, change = 0;  ///< at the velocities of now, and along the step that Newton's method makes
    double given = 0;              ///< impulse that was found
    double inside = 0;             ///< that of the interior point

    /// Between light ones the heaviest may have to be borne: they are as stiff as if one were a part of its mass.
    void stiffen(double heaviest) {
        constexpr double lightest = 1e-4, compliance = 1e-6;  // of the inverse effective mass
        weight = std::max(mass, lightest * heaviest * arm * arm) / compliance;
        target = wanted + warm / weight;
    }
};

/// One that pushes only.
struct Normal : Direction {
    double* impulse;
    double ease = 0;      ///< speed that 1 N s gives where joints hold
    bool closed = false;  ///< pushes

    double impulse_at(double v) const { return std::max(0.0, weight * (target - v)); }
};
/// Friction of sliding or of rolling.
struct Friction : Direction {
    double coefficient;
    double* impulse;
    double bound = 0;  ///< largest impulse
    int slides = 0;    ///< the sign of the impulse at its bound

    double impulse_at(double v) const { return std::clamp(weight * (target - v), -bound, bound); }
    int sliding() const {
        const double sticking = weight * (target - speed);
        return sticking >= bound ? 1 : sticking <= -bound ? -1 : 0;
    }
};

struct Point {
    Normal normal;
    Friction friction[2];  ///< of sliding, and of rolling
    int frictions;

    /// By Coulomb's law, at the speeds of now.
    double bound_of(const Friction& f) const { return f.coefficient * normal.impulse_at(normal.speed); }

    /// From the impulses and velocities of the interior point: what is more of the two.
    void guess_sets() {
        normal.closed = normal.inside > normal.mass * (normal.speed - normal.wanted);
        for (Friction& f : all_friction()) {
            f.bound = normal.closed ? f.coefficient * normal.inside : 0;
            const bool sticks = f.bound - std::abs(f.inside) > f.mass * std::abs(f.speed - f.wanted);
            f.slides = f.bound == 0 ? 1 : sticks ? 0 : f.inside > 0 ? 1 : -1;
        }
    }
    std::span<Friction> all_friction() { return {friction, static_cast<std::size_t>(frictions)}; }
    std::span<const Friction> all_friction() const { return {friction, static_cast<std::size_t>(frictions)}; }
};

}  // namespace carom::newton
