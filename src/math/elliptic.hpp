#pragma once
// Elliptic integrals and functions, and Kepler's equation, from portable arithmetic alone.

namespace carom {

/// The complete elliptic integral K of the first kind by its modulus, 0 <= k < 1: by the arithmetic-geometric mean.
double elliptic_k(double k);

struct Jacobi {
    double sn, cn, dn;
};
/// Jacobi's elliptic functions of argument u and modulus k, 0 <= k < 1: by descending Landen transformations
/// (Abramowitz, Stegun, 16.4).
Jacobi jacobi(double u, double k);

/// The eccentric anomaly E of Kepler's equation M = E − e sin E, for 0 <= e < 1: by Newton's method, kept in brackets.
double eccentric_anomaly(double mean_anomaly, double eccentricity);

}  // namespace carom
