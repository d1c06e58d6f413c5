#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

/// df/dt at t [s] by a five-point difference over 1/1024 s: error ~1e-12 of f's scale for functions that are smooth
/// over milliseconds, and exactly 0 for constant ones. Of faster ones over less, so that it is good to 1e-8 of how fast
/// f is about t. What no difference is good for, as a jump, has that over 1/1024 s.
template <class F>
double slope(F f, double t) {
    constexpr double infinity = std::numeric_limits<double>::infinity(), rounding = 16 * 0x1p-52;
    constexpr double good = 3e-9;  // the error is 1.2 times what the cubic is off, and f changes by up to 4 h f'
    // No node at a closer look is one of the looks before, nor a multiple of such by small numbers: what swings so fast
    // that it is the same at all of one look is not at those of the next.
    constexpr double closer = 0.381966;
    constexpr int looks = 24;  // down to 1e-13 s

    double low = infinity, high = -infinity;
    const auto across = [&](double s) {
        const double after = f(t + s), before = f(t - s);
        low = std::min({low, before, after}), high = std::max({high, before, after});
        return after - before;
    };
    double h = 1.0 / 1024, near = across(h), far = across(2 * h);
    const auto difference = [&] { return (8 * near - far) / (12 * h); };
    const double first = difference();
    for (int look = 0; look < looks; ++look) {
        const double cubic = closer * ((8 * near - far) + closer * closer * (far - 2 * near)) / 6;
        const double nearer = across(closer * h), size = std::max(std::abs(low), std::abs(high));
        if (std::abs(nearer - cubic) <= good * closer * (high - low) + rounding * size) return difference();
        h *= closer, near = nearer;
        low = infinity, high = -infinity;
        far = across(2 * h);
    }
    return first;
}

}  // namespace carom
