#pragma once
// Where two convex outlines touch, or nearly do.

#include <algorithm>

#include "collision/convex.hpp"
#include "collision/nearest.hpp"
#include "collision/walls.hpp"

namespace carom {

/// Two corners that may touch: one of each, or a corner and its foot on the other one's edge.
struct ManifoldPoint {
    /// The cores' nearest points, relative to the bodies' positions and turned as the bodies are: they move with their
    /// bodies. The gap is (core b − core a)·normal less the radii.
    Vec2 core_a{}, core_b{};
    double gap = 0;  ///< [m]; overlap is negative
    /// The features that meet, the same from step to step as long as they do; and of two points which one is on the
    /// left of the normal.
    std::uint32_t id = 0;

    static constexpr std::uint32_t features = 0xffff, left = 0x10000, right = 0x20000;
    /// Whether it is a corner of b that meets an edge of a, or a wall, and not the other way round; of two corners
    /// neither.
    bool is_on_edge_of_a() const { return (id & 0xff) < edge_feature(0); }
};

struct Manifold {
    Vec2 normal{};  ///< from a to b
    int count = 0;
    bool corners = false;          ///< of both it is a corner that is nearest: the normal turns as they pass
    bool beside = false;           ///< one is over a neighbour of the other, a piece of a chain that bends towards it
    bool past_neighbours = false;  ///< it is of one piece of a chain as if that were alone
    ManifoldPoint point[2];
};
/// The gap of the nearer point [m]; 0 if there is none. Outlines that do not overlap are no nearer than that.
inline double least_gap(const Manifold& m) {
    if (m.count == 0) return 0;
    return std::min(m.point[0].gap, m.point[m.count - 1].gap);
}

/// The contact between two outlines if they are no farther apart than the margin [m], else no points. `between` is the
/// position of b's body less that of a's, so that nothing is lost far from the origin. Points farther apart than the
/// margin are left out.
Manifold manifold(const Convex& a, const Frame& frame_a, const Convex& b, const Frame& frame_b, Vec2 between,
                  double margin);

/// An outline with its frame and where that puts it, which whoever asks for many contacts of it has ready.
struct PlacedConvex {
    const Convex& outline;
    const Frame& frame;
    const Placed& placed;
};
/// The same, with a as seen from its own body and b as seen from that of a.
Manifold manifold(const PlacedConvex& a, const PlacedConvex& b, Vec2 between, double margin);

/// The contact with a straight wall as a and the outline as b. Core a is the foot on the wall relative to b's position.
Manifold manifold(const Wall& wall, const Convex& b, const Frame& frame_b, double margin);

}  // namespace carom
