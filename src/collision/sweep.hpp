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
    /// Boxes by their lower ends along the axis of the sweep.
    struct Line {
        std::vector<double> low, high, across_low, across_high;
        std::vector<std::uint32_t> box;
    };
    struct Key {
        std::uint64_t key;
        std::uint32_t box;
    };

    void sort();
    void line_up(std::span<const Aabb> boxes, bool along_x, Line& line);
    void sweep(const Line& from, std::size_t i, const Line& over, std::size_t start);
    void sort_found(std::size_t boxes);

    Line moving_, still_;
    std::vector<Key> keys_, spare_;
    std::vector<BoxPair> found_, spare_found_;
    std::size_t count_ = 0;
    std::vector<std::uint32_t> place_;
};

}  // namespace carom
