#pragma once

namespace carom {

/// df/dt at t [s] by a five-point difference: error ~1e-12 of f's scale for functions that are smooth over
/// milliseconds, and exactly 0 for constant ones.
template <class F>
double slope(F f, double t) {
    constexpr double h = 1.0 / 1024;
    return (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h);
}

}  // namespace carom
