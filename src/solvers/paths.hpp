#pragma once
// How bodies move within a step, as cubic polynomials in time, and when two of them first touch.

#include <optional>
#include <vector>

#include "collision/walls.hpp"
#include "state/bodies.hpp"

namespace carom {

/// x(s) = c0 + c1 τ + c2 τ² + c3 τ³ with τ = s − start.
struct Path {
    double start = 0;
    Vec2 c0{}, c1{}, c2{}, c3{};

    Vec2 position(double s) const {
        const double t = s - start;
        return c0 + t * (c1 + t * (c2 + t * c3));
    }
    Vec2 velocity(double s) const {
        const double t = s - start;
        return c1 + t * (2 * c2 + 3 * t * c3);
    }
    Vec2 acceleration(double s) const { return 2 * c2 + 6 * (s - start) * c3; }
};

/// Uniform acceleration from `start` on.
Path parabola(double start, Vec2 x, Vec2 v, Vec2 a);
/// Hermite's cubic from (x0, v0) at 0 to (x1, v1) at h: what is known of any integrator's step.
Path hermite(Vec2 x0, Vec2 v0, Vec2 x1, Vec2 v1, double h);

/// A disc that holds the path from its start to `end`.
struct Reach {
    Vec2 centre;
    double radius;
};
Reach reach(const Path& path, double end);

/// First time in [from, end] at which two discs whose radii sum up to `distance` begin to overlap; in a periodic box
/// with any image, for ways of up to ten thousand boxes.
std::optional<double> first_touch(const Path& a, const Path& b, double distance, double from, double end,
                                  const std::optional<Periodic>& box);
/// First time in [from, end] at which a disc begins to overlap a wall.
std::optional<double> first_touch(const Path& a, double radius, const Wall& wall, double from, double end);
/// Whether they surely do not touch before `end`, at a glance: neither goes so far, whichever way.
bool stay_apart(const Path& a, const Path& b, double distance, double from, double end,
                const std::optional<Periodic>& box);
bool stay_apart(const Path& a, double radius, const Wall& wall, double from, double end);

}  // namespace carom
