#include <cmath>

#include "math/elementary.hpp"
#include "math/roots.hpp"
namespace carom {
namespace portable {
SinCos sincos(double x) { return {std::sin(x), std::cos(x)}; }
double log(double x) { return std::log(x); }
}  // namespace portable
std::optional<double> first_descent(std::span<const double> c, double end) {
    auto p = [&](double t) {
        double s = 0;
        for (int k = int(c.size()) - 1; k >= 0; --k) s = s * t + c[k];
        return s;
    };
    auto d = [&](double t) {
        double s = 0;
        for (int k = int(c.size()) - 1; k >= 1; --k) s = s * t + k * c[k];
        return s;
    };
    if (p(0) <= 0) {
        if (d(0) < 0) return 0;
        if (d(0) == 0 && c.size() > 2 && c[2] < 0) return 0;
    }
    double a = 0;
    int N = 200;
    bool out = p(0) >= 0;
    for (int i = 1; i <= N; ++i) {
        double b = end * i / N;
        if (p(b) < 0 && out) {
            double lo = a, hi = b;
            for (int k = 0; k < 80; ++k) {
                double m = (lo + hi) / 2;
                (p(m) < 0 ? hi : lo) = m;
            }
            return lo;
        }
        if (p(b) >= 0) out = true;
        a = b;
    }
    return {};
}
}  // namespace carom
