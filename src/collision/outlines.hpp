#pragma once
// Pairs of outlines of several corners, for the machine: see simd/lanes.hpp.

#include <stddef.h>
#include <stdint.h>

namespace carom {

/// The numbers of an outline in its place, in the order in which `Placed` has them. Up to the next multiple of four
/// corners and normals the first ones follow once more.
struct OutlineNumbers {
    double radius, width, centre_x, centre_y;
    double corner_x[8], corner_y[8], normal_x[8], normal_y[8];
};

/// Neither of a pair has a side alone, and they are no two lines. Outlines are seen from their own bodies.
struct OutlinePairs {
    static constexpr size_t most = 32;
    size_t count = 0;
    const double *a[most], *b[most];  ///< `OutlineNumbers`
    double corners_a[most], corners_b[most];
    double between_x[most], between_y[most];  ///< from a's body to b's
    double margin[most];
    double* found[most];  ///< where the manifold is to be

    /// The last one in another place as well.
    void repeat(size_t k) {
        const size_t last = count - 1;
        a[k] = a[last], b[k] = b[last], corners_a[k] = corners_a[last], corners_b[k] = corners_b[last];
        between_x[k] = between_x[last], between_y[k] = between_y[last], margin[k] = margin[last];
    }
};

/// A bit for each pair.
struct OutlinesFound {
    uint32_t touch;
    uint32_t alone;  ///< it takes the nearest of their points to say
};
struct OutlinesKernel {
    /// Writes manifolds where an edge of one is cut to the other's, or they are too far apart. `most` is the most
    /// corners of any. Pairs are repeated behind the last one.
    OutlinesFound (*cut)(OutlinePairs& pairs, int most);
};
extern const OutlinesKernel baseline_outlines_kernel, avx2_outlines_kernel, avx512_outlines_kernel;
/// The one for this machine.
const OutlinesKernel& outlines_kernel();

}  // namespace carom
