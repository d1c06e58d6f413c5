#pragma once
// The step of methods that estimate their own error: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I
// (1993), II.4.

#include "forces/dynamics.hpp"
#include "integrators/combination.hpp"
#include "state/memory.hpp"

namespace carom {

/// The accounts whose errors count.
constexpr Account controlled[] = {Account::damping, Account::drag, Account::wind, Account::user, Account::driven};

/// The largest |x| / (tolerance max(1, |a|, |b|)) over places and velocities of the rows from first to last - 1;
/// infinity if any is not a number.
double largest_motion(const State& x, const State& a, const State& b, double tolerance, Angles angles,
                      std::size_t first, std::size_t last);
/// The same over all rows, with angles and the accounts.
double largest(const State& x, const State& a, const State& b, double tolerance);

/// A first step for a method of this order, from the sizes of the state, of its rates and of their change. memory.end,
/// and the rates and velocities of stage 0, which is there, must be known; stage 1 is overwritten.
double first_step(int order, double tolerance, const Dynamics& dynamics, Memory& memory);

/// The next step by the error of this one and of the one before, in tolerances (PI control): so the steps do not
/// flutter.
double next_step(int order, double h, double error, double before);

/// An Error if a step is none, or if one that was rejected is too short to be tried again.
void require_step(const char* method, double h, bool rejected, double time, double wanted, double tolerance);

/// What a good step of length h tells of the next: one that was shortened says little; after a rejection the step does
/// not grow at once.
void remember_step(double h, double proposed, double error, bool rejected, bool shortened, Memory& memory);

}  // namespace carom
