#pragma once
#include <cmath>

#include "output/layout.hpp"

namespace carom {

/// Leads a curve over the paper. It leaves out points that nobody could tell from the last one, and keeps gnuplot from
/// moving pieces that happen to be level or upright onto whole pixels, which puts a step into a smooth curve.
class Pen {
  public:
    explicit Pen(const Place& place) : place_(place) {}

    /// Goes to a point, given in the axes' own numbers; false if it is where the pen is already.
    bool move(double x, double y) {
        const double px = part(place_.x, x) * place_.width, py = part(place_.y, y) * place_.height;
        if (std::abs(px - x_) < same && std::abs(py - y_) < same) return false;
        x_ = aside(px, x_);
        y_ = aside(py, y_);
        return true;
    }
    void lift() { x_ = y_ = NAN; }
    double x() const { return value(place_.x, x_ / place_.width); }
    double y() const { return value(place_.y, y_ / place_.height); }

  private:
    static constexpr double same = 0.25, level = 0.06, step = 0.12;  // pixels; gnuplot counts in 1/20

    static double part(const Axis& axis, double value) {
        if (axis.log) return std::log10(value / axis.low) / std::log10(axis.high / axis.low);
        return (value - axis.low) / (axis.high - axis.low);
    }
    static double value(const Axis& axis, double part) {
        if (axis.log) return axis.low * std::pow(axis.high / axis.low, part);
        return axis.low + part * (axis.high - axis.low);
    }
    static double aside(double to, double from) {
        if (!(std::abs(to - from) < level)) return to;
        return to < from ? from - step : from + step;
    }
    const Place& place_;
    double x_ = NAN, y_ = NAN;
};

}  // namespace carom
