#pragma once
#include <vector>

#include "output/layout.hpp"

namespace carom {

constexpr double line_width = 2.2;  ///< of a curve of width 1 [pixels]

/// The pieces of a curve between the gaps where it is not finite (or not positive, on a log axis), in the numbers that
/// the axes are labelled with. A curve is kept to a tenth of a pixel by as few points as do that, and what would be
/// drawn over itself is left out.
std::vector<std::vector<Vec2>> strokes(const Curve& curve, const PanelPlace& place);

}  // namespace carom
