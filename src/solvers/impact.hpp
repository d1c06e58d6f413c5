#pragma once
// One impact between two bodies, or a body and a wall, as algebra of impulses.

#include <limits>

#include "collision/walls.hpp"
#include "state/bodies.hpp"

namespace carom {

/// Where two discs touch, or a disc and a wall.
struct Touch {
    Vec2 normal;  ///< from the first to the second; into the wall
    double restitution, friction;
    double least = -std::numeric_limits<double>::infinity();  ///< how fast they part at least [m/s]
};

/// One side of an impact: a body, how readily its velocities change, and who takes what it is given if it does not
/// move.
struct Party {
    Vec2 x{};
    Vec2* v = nullptr;
    double* w = nullptr;
    double inverse_mass = 0, inverse_inertia = 0, radius = 0;
    Giver holder = Giver::walls;

    Vec2 velocity() const { return v ? *v : Vec2{}; }
    double spin() const { return w ? *w : 0; }
};
/// Changes the velocities of both, and books it.
bool collide(Party a, Party b, const Touch& touch, Flows& account);

/// Changes the velocities of bodies i and j: normal impulse (1 + e) μ Δv_n, tangential impulse within Coulomb's cone.
/// Heat, work and momentum go into the state's account. False if neither can be moved.
bool collide(std::size_t i, std::size_t j, const Touch& touch, const Bodies& bodies, State& state);
/// Friction alone between bodies i and j, of an impulse of `most` at most [N s].
void rub(std::size_t i, std::size_t j, Vec2 normal, double most, const Bodies& bodies, State& state);
/// An impact against a wall that does not move.
bool collide(std::size_t i, const Touch& touch, const Bodies& bodies, State& state);

/// Two that are put apart along the normal had this part of their distance before: what their momentum turns them about
/// one another stays, and the velocity across is that part of what it was. Work of putting them apart, and no heat.
void keep_turning(std::size_t i, std::size_t j, Vec2 normal, double part, const Bodies& bodies, State& state);

/// Moves a body without any time passing, as overlaps are mended: work against gravity, and no momentum.
void shift(std::size_t i, Vec2 by, const Bodies& bodies, Vec2 gravity, State& state);

/// The coefficient of a contact, from those of the two.
inline double mixed(Mixing rule, double a, double b) {
    switch (rule) {
        case Mixing::minimum:
            return a < b ? a : b;
        case Mixing::maximum:
            return a < b ? b : a;
        case Mixing::mean:
            return 0.5 * (a + b);
        case Mixing::product:
            return a * b;
        case Mixing::geometric_mean:
            return std::sqrt(a * b);
    }
    return 0;
}
inline double mixed_restitution(const Bodies& bodies, double a, double b) {
    return mixed(bodies.mixing.restitution, a, b);
}
inline double mixed_friction(const Bodies& bodies, double a, double b) { return mixed(bodies.mixing.friction, a, b); }

}  // namespace carom
