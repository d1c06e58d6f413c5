#pragma once
// What the search for pairs keeps: pieces, how bodies are taken to go on, and who may meet.

#include <cmath>
#include <vector>

#include "collision/sweep.hpp"
#include "math/pages.hpp"
#include "solvers/passed_over.hpp"
#include "solvers/soft_contact.hpp"
#include "state/bodies.hpp"
#include "state/motion.hpp"

namespace carom {

/// What tells whether a piece may meet another one, how near is near, and how they then act: pieces are large.
struct PieceTag {
    std::uint32_t row, number;
    BodyId id;
    Filter filter;
    bool is_sensor, moves;
    bool is_single;  ///< it has one corner
    bool is_of_chain;
    std::uint32_t shape;
    double restitution, thickness;
    double friction, rolling_resistance, surface_speed, radius;

    PieceTag() = default;
    PieceTag(const Piece&, const Bodies&);
};

/// How far a body may go off its way before one of the pairs passed over for it has to be looked at: each of two may
/// use half of what the pair has to spare.
struct Leash {
    double way = HUGE_VAL;  ///< [m]
    double reach = 0;       ///< [m] from its position, for what its turning does
};

/// All pieces as the search sees them, and how far they stretch.
struct PieceTable {
    std::vector<PieceTag> tags;
    std::vector<BoxName> names;  ///< in whose order their pairs are
    LargeArray<Placed> placed;   ///< as they are turned, seen from their bodies
    std::vector<Aabb> boxes;     ///< where they are
    std::vector<double> sizes;   ///< the longer sides of the boxes [m]
    std::vector<double> extent;  ///< how far each body's stretch from its position [m]; by row, the ground's last
};

/// The size [m] of the smaller one of the two pieces of a candidate.
double size_of(const Candidate&, const PieceTable&);
/// The least thickness [m] of the two pieces of a candidate, of those that have one; else without end.
double thickness(const Candidate&, const PieceTable&);

/// How bodies are taken to go on for a while, and who is no contact as long as they do.
struct Outlook {
    State from;                  ///< how all were when contacts were looked for
    bool midway = false;         ///< that was in the middle of a step
    double ahead = 0;            ///< for how long they were looked for [s]
    std::vector<double> reach;   ///< how far each body may get in that time [m]; by row
    double thrown = 0;           ///< how much farther who is struck in a substep, where that is asked [m]
    PassedOver passed_over;      ///< no contacts as long as they go on so; see pass_over()
    std::vector<Leash> leashes;  ///< by row; of no meaning where nothing moves
};

/// Passes over a pair, if it has to be watched at all: when all are looked for, or later.
void pass_over(const Near&, Outlook&);
void pass_over_later(const Near&, Outlook&);
/// Whether the time for which contacts were looked for is over in a substep of h [s].
bool is_time_over(const State&, double h, const Outlook&);

/// The pairs of pieces that may meet, and what saves the next search from looking for them anew.
struct PairSearch {
    LargeArray<Candidate> candidates;  ///< in the order of their keys, but for those that came late
    std::size_t in_order = 0;          ///< so many did not
    LargeArray<Near> near;             ///< first those of them that are looked at, and storage
    LargeArray<Manifold> manifolds;    ///< of these, and storage
    Sweep sweep;
    std::vector<Aabb> rooms;   ///< of all pieces, within which all candidates are known
    bool knows_pairs = false;  ///< the candidates are those of the bodies, shapes and joints there are
    bool left_out = false;     ///< without those among sleepers
    double rest_ahead = 0;     ///< for how long [s] the rooms of those left out are wide enough
    double rest_thrown = 0;    ///< and how far [m] anybody may be thrown meanwhile
    bool lasts = true;         ///< the candidates have served more than once, or none were yet sought in vain
    int vain = 0;              ///< searches of late that served but once
};

}  // namespace carom
