#pragma once
// Manifolds of several pairs of outlines at once.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "collision/manifold.hpp"
#include "collision/outlines.hpp"

namespace carom {

/// Pairs that are looked at in lanes. Each gets the bits that it would get alone.
class SideBySide {
  public:
    static constexpr std::uint32_t most = OutlinePairs::most;

    /// Whether two outlines may be one of the pairs: on this machine, both with edges, and not two lines.
    bool takes(const Placed& a, const Placed& b) const {
        return kernel_.cut && a.count > 1 && b.count > 1 && a.count + b.count > 4 && !a.one_sided && !b.one_sided;
    }
    /// Outlines as their own bodies see them; what is called `number` has its manifold when all are looked at.
    void add(const Placed& a, const Placed& b, Vec2 between, double margin, std::uint32_t number, Manifold& manifold);
    /// Bits for the numbers of the pairs that touch; calls look(number) for the few that have to be looked at alone.
    template <class Look>
    std::uint32_t look_at_all(const Look& look) {
        if (pairs_.count == 0) return 0;
        const auto [touch, alone] = kernel_.cut(pairs_, most_corners_);
        std::uint32_t found = 0;
        for (std::size_t k = 0; k < pairs_.count; ++k) found |= (touch >> k & 1U) << number_[k];
        for (std::size_t k = 0; k < pairs_.count; ++k)
            if (alone >> k & 1U) look(number_[k]);
        return found;
    }

  private:
    const OutlinesKernel& kernel_ = outlines_kernel();
    OutlinePairs pairs_;
    std::uint32_t number_[most];
    int most_corners_ = 0;
};

inline void SideBySide::add(const Placed& a, const Placed& b, Vec2 between, double margin, std::uint32_t number,
                            Manifold& manifold) {
    // The kernel writes a manifold as fifteen numbers.
    static_assert(sizeof(Manifold) == 15 * sizeof(double) && sizeof(ManifoldPoint) == 6 * sizeof(double));
    static_assert(offsetof(Manifold, count) == 16 && offsetof(Manifold, corners) == 20 &&
                  offsetof(Manifold, point) == 24);
    static_assert(ManifoldPoint::left == left_of_two && ManifoldPoint::right == right_of_two);
    static_assert(offsetof(ManifoldPoint, gap) == 32 && offsetof(ManifoldPoint, id) == 40);
    const std::size_t k = pairs_.count++;
    pairs_.a[k] = a.numbers, pairs_.b[k] = b.numbers;
    pairs_.corners_a[k] = a.count, pairs_.corners_b[k] = b.count;
    pairs_.radius_a[k] = a.radius, pairs_.radius_b[k] = b.radius;
    pairs_.width_a[k] = a.width, pairs_.width_b[k] = b.width;
    pairs_.between_x[k] = between.x, pairs_.between_y[k] = between.y;
    pairs_.margin[k] = margin;
    pairs_.found[k] = &manifold.normal.x;
    number_[k] = number;
    most_corners_ = std::max({most_corners_, a.count, b.count});
}

}  // namespace carom
