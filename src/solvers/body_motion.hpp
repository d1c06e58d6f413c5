#pragma once
// How bodies move through a substep.

#include <vector>

#include "collision/convex.hpp"
#include "solvers/contact_rows.hpp"
#include "state/motion.hpp"

namespace carom {

/// How a body moves, or a point of it.
struct Twist {
    Vec2 velocity;
    double angular_velocity;
};

/// Bodies on their way through a substep: by row, and the ground behind them.
struct BodyMotion {
    std::vector<Mover> movers;
    std::vector<Frame> frames;     ///< where they are
    State start;                   ///< before the substep
    State proposed;                ///< where the integrator and the impacts put them
    Rates rates;                   ///< storage
    std::vector<Mover> before;     ///< the movers before the contacts of a half
    std::vector<Mover> means;      ///< of the velocities at the start of the substep and at its end
    std::vector<Mover> shifts;     ///< the movers with the velocities at which what is deep in one another is parted
    std::vector<Twist> by_joints;  ///< what joints gave, where there are any
    std::vector<Mover> given;      ///< what all contacts gave each body in the last substep
    std::vector<Mover> leads;      ///< by what that is more than they were given, for normals have turned since
    bool given_fits = false;       ///< they are the contacts of this one still
    bool gaps_fit = false;         ///< nobody has moved since the gaps in the blocks were measured
};
/// x, y, cosine, sine of each mover.
const double* frames(const BodyMotion&);

}  // namespace carom
