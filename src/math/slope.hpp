#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

/// Differences of f about t [s] over h, 2 h and a part of h, and whether the cubic through the first two is good for
/// the third.
template <class F>
class Differences {
  public:
    Differences(F& f, double t, double h) : Differences(f, t, h, f(t + h) - f(t - h)) {}

    double slope() const { return (8 * near_ - far_) / (12 * h_); }
    bool is_good() const {
        const double part = closer_h_ / h_, cubic = part * ((8 * near_ - far_) + part * part * (far_ - 2 * near_)) / 6;
        return std::abs(nearer_ - cubic) <= good * part * (high_ - low_) + rounding();
    }
    /// Whether f hardly changes beside its rounding.
    bool are_rounded() const { return high_ > low_ && rounding() > good * (high_ - low_); }

    bool can_be_closer() const { return closer_h_ > 0; }
    Differences closer(F& f, double t) const { return {f, t, closer_h_, nearer_}; }
    Differences wider(F& f, double t) const { return {f, t, 32 * h_}; }

  private:
    static constexpr double good = 3e-9;  // the error is 1.2 times what the cubic is off, and f changes by up to 4 h f'
    // No node at a closer look is one of the looks before, nor a multiple of such by small numbers: what swings so fast
    // that it is the same at all of one look is not at those of the next.
    static constexpr double part_of_h = 0.381966;

    Differences(F& f, double t, double h, double near) : t_(t), h_(h), near_(near), closer_h_((t + part_of_h * h) - t) {
        const auto across = [&](double s) {
            const double after = f(t + s), before = f(t - s);
            low_ = std::min({low_, before, after}), high_ = std::max({high_, before, after});
            return after - before;
        };
        far_ = across(2 * h_), nearer_ = across(closer_h_);
    }
    /// Of f, and of the time that it is asked for: what swings has that of its phase where it goes through 0, too.
    double rounding() const {
        const double size = std::max(std::abs(low_), std::abs(high_)), speed = (high_ - low_) / (4 * h_);
        return 0x1p-52 * (16 * size + 4 * std::abs(t_) * speed);
    }

    double t_, h_, near_;
    double closer_h_;  ///< as the digits of t have it: far from 0 s what these lack would be taken for what f does
    double far_, nearer_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;  ///< of f
};

/// df/dt at t [s] by a five-point difference over 1/1024 s, exactly 0 for what is constant. Of what is faster over
/// less, and of what hardly changes in that time over more, so that it is good to 1e-8 of how fast f is about t. What
/// no difference is good for, as a jump, has that over 1/1024 s.
template <class F>
double slope(F f, double t) {
    constexpr int closer_looks = 24, wider_looks = 8;  // down to 1e-13 s, up to 1e9 s
    Differences<F> now(f, t, 1.0 / 1024);
    if (now.is_good()) {
        for (int look = 0; look < wider_looks && now.are_rounded(); ++look) {
            const Differences<F> next = now.wider(f, t);
            if (!next.is_good()) break;
            now = next;
        }
        return now.slope();
    }
    const double first = now.slope();
    for (int look = 0; look < closer_looks && now.can_be_closer(); ++look) {
        now = now.closer(f, t);
        if (now.is_good()) return now.slope();
    }
    return first;
}

}  // namespace carom
