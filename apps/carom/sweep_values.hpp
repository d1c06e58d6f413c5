#pragma once
// The values that a sweep is over.

#include <optional>

#include "sweep.hpp"

namespace carom::app {

/// A value of each parameter: those of a run.
using Point = std::vector<std::string>;

/// All of them, in the order of their runs: the last parameter's values change first.
std::vector<Point> points_of(const Sweep& sweep);
/// Which of them are likely to show a wrong value before the first run: each that was written out, and of a range the
/// ends, with the first of the other parameter; and the last of all.
std::vector<std::size_t> telling_points_of(const Sweep& sweep);
/// "g=1 h=2"
std::string in_words(const Sweep& sweep, const Point& point);
/// What the values are in this scene, those that are numbers.
std::vector<std::optional<double>> numbers_of(const Scene& scene, const Sweep& sweep, const Point& point);

}  // namespace carom::app
