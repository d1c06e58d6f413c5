#pragma once
// A mechanism laid out for its solve, or several that are alike, one a lane: what the text of the solve
// (solvers/desk.hpp) works on. Without std, for wide kernels include it.

#include <stddef.h>
#include <stdint.h>

#include "math/block_factor.hpp"

namespace carom {

/// Added to the diagonal of S, as a part of it: rows that say what others say too have a solution then.
constexpr double slack = 1e-13;
/// The same where some do: what rounding leaves of their difference is to be no force.
constexpr double slack_of_redundant = 1e-12;
/// Gaps below this part of a joint's size are rounding.
constexpr double tiny = 1e-11;
/// Who is made so many times as fast has no digit left of the velocity before.
constexpr double digits_of_speed = 1e12;

/// Where a row is on the staircase of its law.
enum class Step : uint8_t {
    held,     ///< the row is kept: by any force, or a motor holds its speed
    lower,    ///< at its lower limit
    upper,    ///< at its upper limit
    pushing,  ///< by the largest force of its motor or spring
    pulling,  ///< the same the other way
    free      ///< by no force
};

/// Joints k and l pull on the same part: with rows of their sides a (0) or b (1).
struct Coupling {
    uint32_t k, l, part;
    bool k_is_b, l_is_b;
    uint32_t index;  ///< of the matrix's block
    bool operator==(const Coupling&) const = default;
};
/// What a joint of a mechanism holds, and by which rows.
struct JointShape {
    uint32_t a, b;   ///< places of its bodies
    uint32_t line;   ///< its first one
    uint32_t lines;  ///< how many
    uint32_t rigid;  ///< of these, from the first on
    uint32_t place;  ///< in the order of elimination
    bool is_hinge;   ///< two points are one, and rows that follow are of the angle: the most common
    bool operator==(const JointShape&) const = default;
};
constexpr uint32_t no_bound = 0xffffffff;
/// A row that is not rigid.
struct BoundShape {
    uint32_t joint, row, line;
    bool is_spring, is_paired;
    bool operator==(const BoundShape&) const = default;
};
/// What mechanisms that are alike have in common.
struct DeskShape {
    size_t parts, joints, lines, bounds, couplings, blocks;
    const JointShape* joint;
    const BoundShape* bound;
    const uint32_t* bound_of;   ///< of each line; `no_bound` of one that is rigid
    const uint32_t* line_of;    ///< of each line, in the mechanism: after the drift springs have none here
    const uint32_t* spring_of;  ///< such a one, of each joint; or `no_bound`
    const Coupling* coupling;   ///< in the order of blocks
    BlockOrder order;
    bool has_pairs;
    bool is_simple;  ///< all rows are rigid, before the drift too
    bool is_plain;   ///< all joints are hinges without further rows
};

template <class V>
struct DeskPlace {
    V x, y, cosine, sine, angle;
};
/// The first 22 numbers lie as they follow one another in a Mechanism::Part.
template <class V>
struct DeskPart {
    V ease[3], v[3], given[3], known[3];  ///< as those
    DeskPlace<V> start;                   ///< where the substep began
    DeskPlace<V> now;                     ///< where it ends with these velocities
    V first_v[3], first_given[3];         ///< when the solve began
};
/// Of a hinge, as in a Member.
template <class V>
struct DeskAnchors {
    V size, per_size, a[2], b[2], rest;
};
/// The first ten numbers are laid out as they follow one another in a JointLine.
template <class V>
struct DeskLine {
    V a[3], b[3];  ///< the row along which impulses act
    V error;       ///< where that is
    V aim;         ///< before the drift
    V impulse;
    V half;        ///< before the drift
    V last_error;  ///< where it ends
    V per_size;    ///< 1 over what gaps are compared with
    V first_impulse;
    V step, first_step;  ///< a Step as a number
    V factored_step;     ///< that for which the matrix is factored
};
/// What a row that is not rigid is to be at, and within which bounds.
template <class V>
struct DeskBound {
    V speed, softness;  ///< J v + softness · impulse = speed
    V low, high;        ///< speeds at which it meets its limits
    V least, most;      ///< impulses at the largest force of its motor or spring
    V push;             ///< the impulse with which it is pushed: of one that is paired a part of that
    V motor;            ///< that force of its law
    V hair;             ///< a speed that is rounding
};
/// The same of all lanes.
struct DeskTask {
    double h;           ///< of the substep [s]
    double share;       ///< of it before the drift
    bool is_projected;  ///< springs give all before the drift
    bool drifts;        ///< velocities are those of the drift
    bool is_last;       ///< no contacts act after it
    bool foresees;      ///< rows begin with what is expected
    bool is_warm;       ///< all rows have begun so, stops too: what is kept is as it will be
    bool begins;        ///< nothing of this layout has been solved yet
    void (*turn)(double angle, double* cosine, double* sine);
    bool is_exact() const { return drifts && is_last; }  ///< rows are kept where the drift ends
};
/// The numbers of mechanisms where they lie in memory, of each lane; and how many lie between those of two.
struct DeskSource {
    static constexpr int most_lanes = 8;
    const double *parts[most_lanes], *joints[most_lanes], *laws[most_lanes];
    const double* lines[most_lanes];   ///< from the row along which impulses act
    const double* starts[most_lanes];  ///< from the gap of the row where the substep began
    size_t part, joint, law, line;
    /// After the drift: times the force of the substep before for rigid rows, and the impulse before it for springs.
    double expected[most_lanes], of_springs[most_lanes];
};
/// So many numbers of a part, of a row and of anchors lie there as on the desk. After the drift nobody asks where it
/// began, nor what is expected; before it they do.
constexpr size_t laid_of_part[] = {12, 17}, laid_of_row[] = {9, 10}, laid_of_anchors = 7;

struct DeskMemory {
    void *parts, *anchors, *lines, *bounds, *unknowns, *diagonal, *blocks, *scaled;
    bool* is_factored;
};
struct DeskKernel {
    int lanes;
    /// Lays mechanisms of hinges that are alike side by side.
    void (*lay)(const DeskShape&, const DeskTask&, const DeskMemory&, const DeskSource&);
    /// The same of those that have drifted and are still to begin what comes then: with rows where the parts are now,
    /// and what these are expected to give. Returns for whom that is too much, a bit each: they are to begin alone.
    unsigned (*lay_drifted)(const DeskShape&, const DeskTask&, const DeskMemory&, const DeskSource&);
    /// Newton's method for mechanisms of hinges of N = 2, 3 and 4 rows that are alike, in the lanes that are wanted, a
    /// bit each. Returns who found a solution.
    unsigned (*iterate[3])(const DeskShape&, const DeskTask&, const DeskMemory&, unsigned wanted);
    /// Who has no more than so many times the energy with which the solve began, if none is slowed down.
    unsigned (*calm)(const DeskShape&, const DeskMemory&, double most);
    /// Of one mechanism alone that is plain: sends its parts to the end of the drift, and writes what rows miss there.
    /// Returns the most, as a part of their sizes.
    double (*look_ahead)(const DeskShape&, const DeskTask&, const DeskMemory&);
};
extern const DeskKernel baseline_desk_kernel, avx2_desk_kernel, avx512_desk_kernel;

}  // namespace carom
