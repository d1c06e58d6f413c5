#pragma once
// Pairs of outlines of several corners, for the machine: see simd/lanes.hpp.

#include <stddef.h>
#include <stdint.h>

namespace carom {

/// What is added to the features of two points, as in ManifoldPoint: which is on the left of the normal.
constexpr uint32_t left_of_two = 0x10000, right_of_two = 0x20000;

/// Neither of a pair has a side alone, and they are no two lines. Outlines are seen from their own bodies.
struct OutlinePairs {
    static constexpr size_t most = 32;
    size_t count = 0;
    const double *a[most], *b[most];          ///< `Placed::numbers`
    double corners_a[most], corners_b[most];  ///< how many there are
    double radius_a[most], radius_b[most], width_a[most], width_b[most];
    double between_x[most], between_y[most];  ///< from a's body to b's
    double margin[most];
    double* found[most];  ///< where the manifold is to be

    /// The last one in another place as well.
    void repeat(size_t k) {
        const size_t last = count - 1;
        a[k] = a[last], b[k] = b[last], corners_a[k] = corners_a[last], corners_b[k] = corners_b[last];
        radius_a[k] = radius_a[last], radius_b[k] = radius_b[last];
        width_a[k] = width_a[last], width_b[k] = width_b[last];
        between_x[k] = between_x[last], between_y[k] = between_y[last], margin[k] = margin[last];
    }
};

/// A bit for each pair.
struct OutlinesFound {
    uint32_t touch;
    uint32_t alone;  ///< it takes the nearest of their points to say
};
struct OutlinesKernel {
    /// Writes the manifolds, but for those of pairs that are to be looked at alone. `most` is the most corners of any;
    /// pairs are repeated behind the last one. Null where there are two lanes, which are no faster than one pair after
    /// the other: that leaves out what it does not need.
    OutlinesFound (*cut)(OutlinePairs& pairs, int most);
};
extern const OutlinesKernel baseline_outlines_kernel, avx2_outlines_kernel, avx512_outlines_kernel;
/// The one for this machine.
const OutlinesKernel& outlines_kernel();

}  // namespace carom
