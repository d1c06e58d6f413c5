#pragma once
#include <carom/world.hpp>

namespace carom {

/// The ledger of energy.
Energy energy(const World& world);
/// The ledger of momentum.
MomentumBalance momentum_balance(const World& world);
/// Σ m v [kg m/s] over the dynamic bodies.
Vec2 momentum(const World& world);
/// Σ m x × v + I ω [kg m²/s] over the dynamic bodies, about the origin.
double angular_momentum(const World& world);
/// Centre of mass [m] of the dynamic bodies; an Error if there is none.
Vec2 centre_of_mass(const World& world);
/// FNV-1a over the bits of every body's position, angle, velocity and angular velocity, in the order of ids.
std::uint64_t state_hash(const World& world);

}  // namespace carom
