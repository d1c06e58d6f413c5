#pragma once
#include <carom/carom.hpp>

namespace carom::test {

/// [m], 0 if nothing overlaps.
inline double deepest_overlap(const World& world) {
    const auto overlaps = world.overlaps();
    return overlaps.empty() ? 0 : overlaps.front().depth;
}

}  // namespace carom::test
