#include "math/elliptic.hpp"

#include <algorithm>
#include <cmath>

#include "math/elementary.hpp"

namespace carom {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int most_means = 16;  // the mean converges quadratically: 8 steps do for every k that is a double

}  // namespace

double elliptic_k(double k) {
    double a = 1, b = std::sqrt((1 - k) * (1 + k));
    for (int n = 0; n < most_means && std::abs(a - b) > 1e-16 * a; ++n) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return pi / (a + b);
}

Jacobi jacobi(double u, double k) {
    double a[most_means + 1]{1}, c[most_means + 1]{k};
    double b = std::sqrt((1 - k) * (1 + k));
    int n = 0;
    while (n < most_means && std::abs(c[n]) > 1e-17 * a[n]) {
        a[n + 1] = 0.5 * (a[n] + b);
        c[n + 1] = 0.5 * (a[n] - b);
        b = std::sqrt(a[n] * b);
        ++n;
    }
    double angle = u * a[n] * static_cast<double>(1 << n);
    for (; n > 0; --n)
        angle = 0.5 * (angle + portable::asin(std::clamp(c[n] / a[n] * portable::sin(angle), -1.0, 1.0)));
    const auto [sn, cn] = portable::sincos(angle);
    // dn = cos φ₀/cos(φ₁ − φ₀) is 0/0 at the quarter periods; this is not.
    return {sn, cn, std::sqrt((1 - k) * (1 + k) + k * k * cn * cn)};
}

double eccentric_anomaly(double mean_anomaly, double e) {
    const double turns = std::round(mean_anomaly / (2 * pi)), m = mean_anomaly - 2 * pi * turns;
    // E lies between M and M + e sin of something, so within e of M.
    double low = m - e, high = m + e, guess = m + e * portable::sin(m);
    for (int n = 0; n < 100; ++n) {
        const auto [sine, cosine] = portable::sincos(guess);
        const double excess = guess - e * sine - m;
        (excess > 0 ? high : low) = guess;
        double next = guess - excess / (1 - e * cosine);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - guess) <= 1e-16 * std::max(1.0, std::abs(guess))) break;
        guess = next;
    }
    return guess + 2 * pi * turns;
}

}  // namespace carom
