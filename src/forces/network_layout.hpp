#pragma once
// How a network of springs lies in memory: plain data, for kernels that may see no more than that (simd/lanes.hpp).

#include <stddef.h>
#include <stdint.h>

#include "simd/chunks.hpp"

namespace carom {

/// A spring between the centres of two bodies, damped along its direction.
struct Link {
    uint32_t a, b;  ///< rows
    double stiffness, rest_length, damping;
};

/// One spring of each body of a chunk. A body with fewer springs than its fellows holds on to itself here: no force.
struct NetworkColumn {
    uint32_t partners : 29;    ///< the first body's partner if consecutive, else the number of a group of partners
    uint32_t consecutive : 1;  ///< partners are consecutive rows, as in a lattice
    uint32_t uniform : 1;      ///< one stiffness, rest length and damping for all
    uint32_t damped : 1;
    uint32_t parameters : 28;    ///< the number of a group of parameters
    uint32_t with_partners : 1;  ///< they lie with the partners, in their chunk and in the next
    uint32_t band : 3;           ///< where its pulls are kept, or where they were: see KeptPulls; 0: nowhere
};
constexpr uint32_t most_bands = 7;

/// Where a band's pulls lie: of a row in row & mask, x from `begin` on and y behind them. The first chunk of either
/// lies at their end once more, so that what goes on from the last place to the first can be read in one.
struct Band {
    size_t begin, mask;

    constexpr size_t y() const { return mask + 1 + chunk_rows; }  ///< from x on
    constexpr size_t end() const { return begin + 2 * y(); }
};

/// The arrays of a network. A group is chunk_rows numbers.
struct NetworkLayout {
    size_t rows;
    const uint32_t* first_column;  ///< of each chunk, and the end
    const NetworkColumn* columns;
    const uint32_t* partners;
    /// Uniform: a group that begins with stiffness, rest length, damping. Else a group of each; the last only if
    /// damped.
    const double* parameters;
    size_t next_chunk;  ///< numbers from the parameters that lie with partners to those with the next chunk's
    const Band* bands;  ///< that with number 1 is the first
};

/// What springs pull at their lower rows, kept for their higher ones, which feel the opposite: a root and a division
/// less, and parameters that need not be read again.
struct KeptPulls {
    double* pulls;  ///< null: nothing is kept
    size_t first;   ///< the rows from here on have been computed, one after the other, at this state
};

/// All springs of a network of few rows.
struct FewLinks {
    const Link* links;
    size_t count, rows;
    bool damped;
};

struct NetworkPowers {
    double elastic = 0;  ///< Σ F·v of the elastic forces [W]
    double damping = 0;  ///< heat that flows [W]
};

/// A body's share of the springs' Hessian.
struct NodeStiffness {
    double xx = 0, xy = 0, yy = 0, angle = 0, damping = 0, angular_damping = 0;

    void operator+=(const NodeStiffness& other) {
        xx += other.xx, xy += other.xy, yy += other.yy, angle += other.angle;
        damping += other.damping, angular_damping += other.angular_damping;
    }
};

/// The functions of a kernel, for the rows from first, a multiple of chunk_rows, to last − 1.
struct NetworkKernel {
    /// Writes the forces on these bodies to force[0], force[1] … x and v, places and velocities of all, and force are
    /// arrays of x, y.
    NetworkPowers (*forces)(const NetworkLayout&, const KeptPulls&, const double* x, const double* v, double* force,
                            size_t first, size_t last);
    /// Potential energy, half of each spring's at either end.
    double (*energy)(const NetworkLayout&, const double* x, size_t first, size_t last);
    /// Writes xx, xy, yy and damping from node[0] on. A spring counts once at a body whose partner is held (its inverse
    /// mass is 0), else twice.
    void (*stiffness)(const NetworkLayout&, const double* x, const double* inverse_mass, NodeStiffness* node,
                      size_t first, size_t last);
};
extern const NetworkKernel baseline_network_kernel, avx2_network_kernel, avx512_network_kernel;

}  // namespace carom
