#pragma once
#include <optional>
#include <span>

namespace carom {

/// The time of impact of a gap p(t) = sum of coefficients[k] t^k, of degree 6 at most: the smallest t in [0, end] with
/// p(t) <= 0 from where p falls.
///
/// Hence a touch that never opens into overlap is no impact; a start at or below zero is one at t = 0 if p falls there,
/// and a departure if p rises (the first derivative that is not zero decides); after a departure the next fall through
/// zero counts, or, should the gap turn before it has opened, the turn. Leading coefficients may be zero.
///
/// Signs are decided for the polynomial as given, with twice the working precision, so that a touch is told from a
/// crossing wherever the coefficients tell it. Coefficients must be finite and end >= 0; end may be infinite.
std::optional<double> first_descent(std::span<const double> coefficients, double end);

}  // namespace carom
