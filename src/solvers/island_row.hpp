#pragma once
// A row of the Jacobian of an island: one direction in which two of its bodies push each other, or one and the ground.

#include <algorithm>
#include <cmath>

#include "math/block_matrix.hpp"
#include "math/scratch.hpp"
#include "solvers/contact_rows.hpp"
#include "state/bodies.hpp"
#include "state/motion.hpp"

namespace carom {

inline constexpr std::uint32_t no_place = 0xffffffff;

/// What (v, ω) of a and of b are multiplied with. They have three numbers each in arrays over the island.
struct IslandRow {
    std::uint32_t a, b;  ///< places in the island, or no_place
    double on_a[3], on_b[3];
    BlockMatrix<3>::Place place{};  ///< of the two in a matrix; see locate()

    static IslandRow push(std::uint32_t a, std::uint32_t b, Vec2 along, Vec2 lever_a, Vec2 lever_b) {
        return {a, b, {-along.x, -along.y, -cross(lever_a, along)}, {along.x, along.y, cross(lever_b, along)}};
    }
    static IslandRow turn(std::uint32_t a, std::uint32_t b) { return {a, b, {0, 0, -1}, {0, 0, 1}}; }

    void add(double part, const IslandRow& other) {
        for (int i = 0; i < 3; ++i) on_a[i] += part * other.on_a[i], on_b[i] += part * other.on_b[i];
    }
    double held_speed(const Mover& m, bool of_b) const {
        const double* on = of_b ? on_b : on_a;
        return on[0] * m.vx + on[1] * m.vy + on[2] * m.w;
    }
    double speed(const Scratch<double>& v) const {
        double s = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (a != no_place) s += on_a[i] * v[3 * a + i];
            if (b != no_place) s += on_b[i] * v[3 * b + i];
        }
        return s;
    }
    void push(double impulse, Scratch<double>& to) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (a != no_place) to[3 * a + i] += on_a[i] * impulse;
            if (b != no_place) to[3 * b + i] += on_b[i] * impulse;
        }
    }
    /// Adds the sizes of what push() adds.
    void add_sizes(double impulse, Scratch<double>& to) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (a != no_place) to[3 * a + i] += std::abs(on_a[i] * impulse);
            if (b != no_place) to[3 * b + i] += std::abs(on_b[i] * impulse);
        }
    }
    /// To be called once before couple(), which is called often.
    void locate(const BlockMatrix<3>& matrix) {
        if (a != no_place && b != no_place) place = matrix.place_of(a, b);
    }
    void couple(double weight, BlockMatrix<3>& matrix) const {
        if (a != no_place) matrix.add(a, weight, on_a, on_a);
        if (b != no_place) matrix.add(b, weight, on_b, on_b);
        if (a != no_place && b != no_place) matrix.add(place, weight, on_a, on_b);
    }
};

/// The moment of inertia of what does not turn.
inline constexpr double unturnable = 1e300;

/// The bodies of an island, three numbers each.
struct IslandBodies {
    /// A rigid row of a joint: who goes along it works against so much mass.
    struct Tie {
        IslandRow row;
        double mass;
    };
    Scratch<double> mass;  ///< twice, and the moment of inertia
    Scratch<double> free;  ///< velocities without contacts
    Scratch<double> slow;  ///< part of a body's velocity that is meant here: with which it drifts
    Scratch<Tie> ties;     ///< of joints, which the free velocities keep

    explicit IslandBodies(std::size_t bodies) : mass(3 * bodies), free(3 * bodies), slow(3 * bodies, 1.0) {}
    /// With the masses of those in these rows.
    IslandBodies(const Bodies& bodies, const Scratch<std::uint32_t>& rows) : IslandBodies(rows.size()) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            mass[3 * i] = mass[3 * i + 1] = bodies.mass[rows[i]];
            mass[3 * i + 2] = bodies.inverse_inertia[rows[i]] > 0 ? bodies.inertia[rows[i]] : unturnable;
        }
    }
    std::size_t size() const { return mass.size(); }

    /// One that drifts with so much of its velocity, and of its spin, moves as if its mass were so much larger.
    void slow_down(std::uint32_t place, const double (&parts)[2]) {
        for (std::size_t k = 3 * place; k < 3 * place + 3; ++k) {
            slow[k] = parts[(k - 3 * place) / 2], free[k] *= slow[k];
            if (mass[k] < unturnable) mass[k] /= slow[k];
        }
    }
    double whole_mass() const {
        double sum = 0;
        for (std::size_t i = 0; i < size(); i += 3) sum += mass[i];
        return sum;
    }
    /// The momentum of each along an axis, the larger one, summed up whatever its direction.
    double momentum(const Scratch<double>& v) const {
        double sum = 0;
        for (std::size_t i = 0; i < size(); i += 3) sum += mass[i] * std::max(std::abs(v[i]), std::abs(v[i + 1]));
        return sum;
    }
    /// The largest of these velocities along an axis, spins apart.
    static double fastest(const Scratch<double>& v) {
        double most = 0;
        for (std::size_t i = 0; i < v.size(); ++i)
            if (i % 3 != 2) most = std::max(most, std::abs(v[i]));
        return most;
    }

    /// The same, with how fast spins move what is a radius of gyration away.
    double fastest_rim(const Scratch<double>& v) const {
        double most = fastest(v);
        for (std::size_t i = 2; i < v.size(); i += 3)
            if (mass[i] < unturnable) most = std::max(most, std::abs(v[i]) * std::sqrt(mass[i] / mass[i - 1]));
        return most;
    }

    /// With how little a row is moved, joints apart.
    double inverse_mass(const IslandRow& row) const {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (row.a != no_place) sum += row.on_a[i] * row.on_a[i] / mass[3 * row.a + i];
            if (row.b != no_place) sum += row.on_b[i] * row.on_b[i] / mass[3 * row.b + i];
        }
        return sum;
    }
    /// Makes the matrix that of the masses and joints alone.
    void weigh(BlockMatrix<3>& matrix) const {
        matrix.clear();
        for (std::uint32_t i = 0; i < size(); ++i) matrix.diagonal(i / 3).at[i % 3][i % 3] = mass[i];
        for (const Tie& tie : ties) tie.row.couple(tie.mass, matrix);
    }
    /// The momentum of these velocities that the free ones are ahead.
    void lack(const Scratch<double>& v, Scratch<double>& momentum) const {
        for (std::size_t i = 0; i < size(); ++i) momentum[i] = mass[i] * (free[i] - v[i]);
        for (const Tie& tie : ties) tie.row.push(tie.mass * (tie.row.speed(free) - tie.row.speed(v)), momentum);
    }
    /// By how much impulses miss what makes these velocities of the free ones, of the greatest of all.
    double imbalance(const Scratch<double>& v, const Scratch<double>& impulses) const {
        double most = 0, worst = 0;
        Scratch<double> missing(size());
        lack(v, missing);
        for (std::size_t i = 0; i < size(); ++i) {
            if (mass[i] == unturnable) continue;  // beside whose spin all would be balanced
            const double arm = i % 3 == 2 ? std::sqrt(mass[i] / mass[i - 1]) : 1;  // radius of gyration
            most = std::max(most, (std::abs(impulses[i]) + std::abs(mass[i] * free[i])) / arm);
            worst = std::max(worst, std::abs(missing[i] + impulses[i]) / arm);
        }
        return most > 0 ? worst / most : 0;
    }
};

}  // namespace carom
