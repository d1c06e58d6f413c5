#pragma once
// The plain passes over all bodies, for the machine: see simd/lanes.hpp. Arrays of vectors are arrays of x, y.

#include <stddef.h>

namespace carom {

struct RowArrays {
    const double *x, *v, *mass, *inverse_mass;
    size_t rows;
};

/// Sums over the dynamic bodies, with a the acceleration, and over the others, with f the force on them.
struct AccelerationSums {
    double mass = 0, moment_x = 0, moment_y = 0, momentum_x = 0, momentum_y = 0;  ///< Σ m, m x, m v; 0 without gravity
    double force_x = 0, force_y = 0, torque = 0, power = 0;                       ///< Σ m a, m x × a, m a·v
    double held_force_x = 0, held_force_y = 0, held_torque = 0, held_power = 0;   ///< Σ f, x × f, f·v
};
/// What a kick gives: Σ m dv, m x × dv, and kinetic energy ½ m (v + dv)² − ½ m v²; and whether all v are finite after
/// it.
struct KickSums {
    double momentum_x = 0, momentum_y = 0, angular = 0, energy = 0;
    bool finite = true;

    void operator+=(const KickSums& other) {
        momentum_x += other.momentum_x, momentum_y += other.momentum_y;
        angular += other.angular, energy += other.energy, finite &= other.finite;
    }
};

/// A summand of combine().
struct Term {
    double weight;
    const double* in;
};

/// For the rows from first, a multiple of chunk_rows, to last − 1.
struct RowsKernel {
    /// From force to acceleration: gravity + force / mass, and 0 where the inverse mass is 0. force[0] is the first's.
    AccelerationSums (*accelerate)(const RowArrays&, double gravity_x, double gravity_y, double* force, size_t first,
                                   size_t last);
    /// The same without the sums: they are 0.
    AccelerationSums (*accelerate_alone)(const RowArrays&, double gravity_x, double gravity_y, double* force,
                                         size_t first, size_t last);
    /// v += h a; a[0] is the first's.
    KickSums (*kick)(const RowArrays&, double h, const double* a, double* v, size_t first, size_t last);
    /// x += h v for so many numbers. Whether all x are finite after it, and so all v too.
    bool (*drift)(double h, const double* v, double* x, size_t numbers);
    /// out = start + Σ weight in, or without a start the sum alone, of so many numbers: the terms are added up in order
    /// before they meet the start.
    void (*combine)(const Term* terms, size_t count, const double* start, double* out, size_t numbers);
    /// The largest |e| / (tolerance max(1, |a|, |b|)) of so many numbers; infinity if any is not a number.
    double (*largest)(const double* e, const double* a, const double* b, double tolerance, size_t numbers);
    /// Whether none of so many numbers is infinite or nan.
    bool (*finite)(const double* number, size_t numbers);
    /// Whether all of so many numbers are 0. It asks for as many more before they are wanted.
    bool (*zero)(const double* number, size_t numbers);
};
extern const RowsKernel baseline_rows_kernel, avx2_rows_kernel, avx512_rows_kernel;
/// The one for this machine.
const RowsKernel& rows_kernel();

}  // namespace carom
