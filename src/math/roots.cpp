#include "math/roots.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "math/bits.hpp"
#include "math/double_double.hpp"

namespace carom {
namespace {

constexpr int highest_degree = 6;
constexpr double unit_roundoff = 0x1p-53;

int sign(double x) { return (x > 0) - (x < 0); }

/// A polynomial whose leading coefficient is not zero, unless it is the constant 0.
struct Polynomial {
    std::array<double, highest_degree + 1> c{};
    int degree = 0;

    Polynomial derivative() const {
        Polynomial d;
        for (int k = 1; k <= degree; ++k) d.c[k - 1] = k * c[k];
        d.degree = degree > 0 ? degree - 1 : 0;
        return d;
    }

    /// The sign just right of t = 0.
    int sign_after_zero() const {
        for (int k = 0; k <= degree; ++k)
            if (c[k] != 0) return sign(c[k]);
        return 0;
    }
};

/// The coefficients times a power of two, which moves no root and keeps their squares in range.
Polynomial scaled(std::span<const double> coefficients) {
    double largest = 0;
    for (double c : coefficients) largest = std::fmax(largest, std::fabs(c));
    const int exponent = exponent_of(largest);
    const double scale = power_of_two(exponent > 1000 ? -1000 : -exponent);
    Polynomial p;
    for (int k = 0; k < static_cast<int>(coefficients.size()); ++k) {
        assert(k <= highest_degree || coefficients[k] == 0);
        const double c = coefficients[k] * scale;
        if (c != 0) p.c[p.degree = k] = c;
    }
    return p;
}

/// Horner's rule in double-double: as if computed with twice the precision; 0 where even that leaves the sign in doubt.
double careful_value(const Polynomial& p, double t, double size) {
    DoubleDouble value{p.c[p.degree], 0};
    for (int k = p.degree - 1; k >= 0; --k) {
        const DoubleDouble product = two_product(value.high, t);
        const DoubleDouble sum = two_sum(product.high, p.c[k]);
        value = fast_two_sum(sum.high, sum.low + (product.low + value.low * t));
    }
    const double bound = 16 * (p.degree + 1) * (unit_roundoff * unit_roundoff) * size;
    return std::fabs(value.high) > bound ? value.high : 0;
}

/// p(t): plain Horner where its error bound leaves no doubt of the sign, careful otherwise.
double value_at(const Polynomial& p, double t) {
    double value = p.c[p.degree], size = std::fabs(value);  // size: the sum of |c[k]| t^k
    for (int k = p.degree - 1; k >= 0; --k) {
        value = value * t + p.c[k];
        size = size * t + std::fabs(p.c[k]);
    }
    const double bound = (2 * p.degree + 1) * unit_roundoff * size;
    return std::fabs(value) > bound ? value : careful_value(p, t, size);
}

double slope_at(const Polynomial& p, double t) {
    double slope = p.degree * p.c[p.degree];
    for (int k = p.degree - 1; k >= 1; --k) slope = slope * t + k * p.c[k];
    return slope;
}

/// The root of p in [low, high], where p is monotone and has the sign `before` (not 0) right of low and the opposite
/// sign at high: Newton's method inside a bracket, halved whenever Newton leaves it or is slow.
double bracketed_root(const Polynomial& p, double low, double high, int before) {
    double t = low + 0.5 * (high - low);
    double last_step = high - low;
    while (t > low && t < high) {
        const double value = value_at(p, t);
        if (value == 0) return t;
        (sign(value) == before ? low : high) = t;
        const double newton = t - value / slope_at(p, t);
        if (newton == t) return t;
        const double step = std::fabs(newton - t);
        const bool good = newton > low && newton < high && step <= 0.5 * last_step;
        last_step = good ? step : 0.5 * (high - low);
        t = good ? newton : low + 0.5 * (high - low);
    }
    return t;
}

/// Ascending times, at most one for each degree.
struct Times {
    std::array<double, highest_degree> at{};
    int count = 0;

    void push(double t) { at[count++] = t; }
};

/// b^2 - 4 a c, its sign right.
double discriminant(double a, double b, double c) { return subtract(two_product(b, b), two_product(4 * a, c)).value(); }

/// Where p, of degree 2 at most, changes sign in (0, end).
Times sign_changes_of_quadratic(const Polynomial& p, double end) {
    const double a = p.c[2], b = p.c[1], c = p.c[0];
    Times changes;
    const auto keep = [&](double t) {
        if (t > 0 && t < end) changes.push(t);
    };
    if (a == 0) {
        if (b != 0) keep(-c / b);
        return changes;
    }
    const double square = discriminant(a, b, c);
    if (!(square > 0)) return changes;
    const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));  // no cancellation
    const double one = q / a, other = c / q;
    keep(one < other ? one : other);
    keep(one < other ? other : one);
    return changes;
}

/// Where p changes sign in (0, end): between two turning points at most once. The turning points are the sign changes
/// of the derivative, so the search climbs from the derivative of degree 2.
Times sign_changes(const Polynomial& p, double end) {
    if (p.degree <= 2) return sign_changes_of_quadratic(p, end);
    const Times turns = sign_changes(p.derivative(), end);
    Times changes;
    int before = p.sign_after_zero();
    double low = 0;
    for (int k = 0; k <= turns.count; ++k) {
        const double high = k < turns.count ? turns.at[k] : end;
        const int after = sign(value_at(p, high));
        if (after == -before) {
            changes.push(bracketed_root(p, low, high, before));
            before = after;
        }
        low = high;
    }
    return changes;
}

/// No root lies beyond (Cauchy).
double root_bound(const Polynomial& p) {
    double largest = 0;
    for (int k = 0; k < p.degree; ++k) largest = std::fmax(largest, std::fabs(p.c[k]));
    return 1 + largest / std::fabs(p.c[p.degree]);
}

/// Where c + b t + a t^2 first falls from zero or below.
std::optional<double> descent_of_quadratic(double c, double b, double a) {
    if (c <= 0 && b < 0) return 0;
    if (a == 0) return c > 0 && b < 0 ? std::optional(-c / b) : std::nullopt;
    const double square = discriminant(a, b, c);
    const double root = std::sqrt(std::fmax(square, 0));
    if (a > 0) {  // falls before it rises, if at all
        if (c <= 0 || b >= 0 || square <= 0) return std::nullopt;
        return 2 * c / (root - b);
    }
    if (b < 0) return 2 * c / (root - b);
    return -0.5 * (b + root) / a;  // with no root, the turn of a gap that stays below zero
}

}  // namespace

std::optional<double> first_descent(std::span<const double> coefficients, double end) {
    const Polynomial p = scaled(coefficients);
    if (p.degree <= 2) {
        const std::optional<double> t = descent_of_quadratic(p.c[0], p.c[1], p.c[2]);
        return t && *t <= end ? t : std::nullopt;
    }
    const Polynomial slope = p.derivative();
    end = std::fmin(end, root_bound(p));
    const Times turns = sign_changes(slope, end);
    bool falls = slope.sign_after_zero() < 0;
    double low = 0;
    for (int k = 0; k <= turns.count; ++k, falls = !falls) {
        const double high = k < turns.count ? turns.at[k] : end;
        if (falls) {
            if (value_at(p, low) <= 0) return low;
            const double last = value_at(p, high);
            if (last < 0) return bracketed_root(p, low, high, 1);
            if (last == 0 && k == turns.count && value_at(slope, end) < 0) return end;
        }
        low = high;
    }
    return std::nullopt;
}

}  // namespace carom
