#pragma once
// One impact between two bodies, or a body and a wall, as algebra of impulses.

#include "collision/walls.hpp"
#include "state/bodies.hpp"

namespace carom {

/// What impacts did: counts and accounts [J].
struct Impacts {
    std::uint64_t collisions = 0;
    double heat_impact = 0, heat_friction = 0;
    double work_driven = 0, work_overlap = 0;
};

/// Where two discs touch, or a disc and a wall.
struct Touch {
    Vec2 normal;  ///< from the first to the second; into the wall
    double restitution, friction;
};

/// Changes the velocities of bodies i and j: normal impulse (1 + e) μ Δv_n, tangential impulse within Coulomb's cone.
/// Returns whether they approached.
bool collide(std::size_t i, std::size_t j, const Touch& touch, const Bodies& bodies, Motion& v, Impacts& impacts);
/// The same against a wall that does not move.
bool collide(std::size_t i, const Touch& touch, const Bodies& bodies, Motion& v, Impacts& impacts);

inline double mixed_restitution(double a, double b) { return a < b ? a : b; }
inline double mixed_friction(double a, double b) { return std::sqrt(a * b); }

}  // namespace carom
