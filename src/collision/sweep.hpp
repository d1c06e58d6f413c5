#pragma once
// Broad phase: which boxes overlap.

#include <cstdint>
#include <span>
#include <vector>

#include "collision/convex.hpp"

namespace carom {

struct BoxPair {
    std::uint32_t a, b;  ///< a < b
    auto operator<=>(const BoxPair&) const = default;
};

/// Sort and sweep, rebuilt in every step, with storage that it reuses. Boxes that do not move are swept against those
/// that do, and never against one another.
class Sweep {
  public:
    /// All pairs of overlapping boxes of which at least one moves, in ascending order; valid until the next call.
    std::span<const BoxPair> pairs(std::span<const Aabb> boxes, const std::vector<bool>& moves);

  private:
    std::vector<BoxPair> found_;
};

}  // namespace carom
