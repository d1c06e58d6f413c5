#pragma once
// What the discs of the exact gas bounce off: walls, and bodies that no impulse moves, fixed or with a velocity of
// their own.

#include <vector>

#include "collision/convex.hpp"
#include "collision/walls.hpp"
#include "solvers/events/disc.hpp"
#include "state/bodies.hpp"

namespace carom {

/// A half-plane's edge, or all points within a radius of a line from a to b, which may be one point; or all that are
/// not.
struct GasObstacle {
    static constexpr std::uint32_t no_row = 0xffffffff;

    Vec2 a{}, b{};         ///< [m], at its clock
    Vec2 normal{};         ///< of an edge, into the room; of a line, across it
    bool endless = false;  ///< an edge
    bool hollow = false;   ///< the room is inside
    bool moves = false;
    double radius = 0;
    double restitution = 1, friction = 0;
    double temperature = 0;        ///< k T of a thermal wall [J], of others 0
    Vec2 v{};                      ///< [m/s]
    double spin = 0;               ///< [rad/s], of a disc
    double clock = 0;              ///< [s]
    std::uint32_t row = no_row;    ///< of its body, if it is one
    std::uint32_t mover = no_row;  ///< which of the company it is a part of; a and b are in the frame of that then
};
auto members(Maybe_const<GasObstacle> auto& o) {
    auto& [a, b, normal, endless, hollow, moves, radius, restitution, friction, temperature, v, spin, clock, row,
           mover] = o;
    return std::tie(a, b, normal, endless, hollow, moves, radius, restitution, friction, temperature, v, spin, clock,
                    row, mover);
}

/// The first descent through zero of a gap c0 + c1 t + c2 t² from t = 0 on; infinity if there is none.
double descent(double c0, double c1, double c2);

/// All of them. The pieces are those of bodies that no impulse of a disc moves, and of the company.
std::vector<GasObstacle> obstacles_of(const Walls& walls, const Bodies& bodies, const State& state,
                                      const std::vector<Piece>& pieces);

/// What has an inside and stays where it is: a convex piece of it, seen from its first corner.
struct GasSolid {
    const Piece* piece;
    Frame turned;
    Vec2 corner;    ///< where the first one is
    double extent;  ///< no point is farther from there [m]

    /// Where a place is, seen from the first corner.
    Vec2 seen(const std::optional<Periodic>&, Vec2 place) const;
    /// How far such a place is outside of a face, or inside if it is below 0 [m].
    double beyond(int face, Vec2 seen) const;
    /// How deep a disc with its centre there is, whose shortest way out is through a face; 0 if the centre is outside.
    double depth(Vec2 seen, double radius) const;
    /// What of that is rounding.
    double rounding(Vec2 place) const;
};
std::vector<GasSolid> solids_of(const Bodies&, const State&, const std::vector<Piece>&);

/// A disc in flight: where it is at a time, as it is seen from an obstacle's point a.
struct GasFlight {
    Vec2 x{}, v{}, g{};
    double radius = 0;
};

/// How long it takes until the disc strikes; infinity if it never does. Zero if it touches already and comes nearer.
double time_to(const GasObstacle& obstacle, const GasFlight& flight);

/// From the obstacle's nearest point to the centre of the disc, of length 1; where there is no such direction, against
/// the relative velocity.
Vec2 normal_at(const GasObstacle& obstacle, const GasFlight& flight);

/// How far the disc is from touching; negative if they overlap.
double gap_to(const GasObstacle& obstacle, const GasFlight& flight);

}  // namespace carom
