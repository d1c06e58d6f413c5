// The implicit midpoint rule: u = v + h/2 a(x + h/2 u, u), x' = x + h u, v' = v + 2 (u − v). Hairer, Lubich, Wanner,
// Geometric Numerical Integration (2006), II.1.
//
// Newton's iteration takes the springs' derivatives and no others: with the masses M, the springs' stiffness K = −∂f/∂x
// and damping C = −∂f/∂v at the midpoint it solves (M + h²/4 K + h/2 C) δ = M (v + h/2 a − u). All other forces
// converge as a fixed-point iteration does, which is fast as long as they change little in half a step. Left out of K:
// how the damping turns with the spring, which would make the matrix unsymmetric.

#define EIGEN_MPL2_ONLY
#define EIGEN_DONT_VECTORIZE  // the same bits whatever instructions the compiler may use
#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <carom/error.hpp>
#include <cmath>

#include "integrators/propose.hpp"

namespace carom {

namespace {

/// The equations of one step. Body i has the unknowns 3i, 3i + 1 (its velocity) and 3i + 2 (its angular velocity);
/// those of bodies that forces do not move stand in a row of their own, 1 δ = 0.
class Midpoint {
  public:
    Midpoint(const Dynamics& dynamics, const State& start, double h)
        : dynamics_(dynamics), start_(start), h_(h), mass_(3 * start.size()) {
        for (std::size_t i = 0; i < start.size(); ++i) {
            const double m = dynamics.inverse_mass()[i], inertia = dynamics.inverse_inertia()[i];
            mass_[3 * i] = mass_[3 * i + 1] = m == 0 ? 0 : 1 / m;
            mass_[3 * i + 2] = inertia == 0 ? 0 : 1 / inertia;
        }
    }

    /// Newton's iteration for the velocities at the midpoint; whether it converged.
    bool solve(double tolerance);
    /// Moves a state from the start to the end of the step.
    void finish(State& state) const;

  private:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::SparseMatrix<double>;

    void evaluate();
    Vector residual() const;
    bool factorise();
    void add_entry(std::size_t i, std::size_t j, double value) {
        if (mass_[i] != 0 && mass_[j] != 0)
            entries_.emplace_back(static_cast<int>(std::max(i, j)), static_cast<int>(std::min(i, j)), value);
    }
    void add(const SpringRow& spring);
    void add(const TorsionRow& spring);

    const Dynamics& dynamics_;
    const State& start_;
    const double h_;
    std::vector<double> mass_;
    State middle_;
    Rates rates_;
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::SimplicialLDLT<Matrix> factors_;
    bool analysed_ = false;
};

/// With d the vector between the spring's ends, n its direction and q the six numbers of its bodies, the force along n
/// gives K = (k − F/|d|) (n·∂ᵢd)(n·∂ⱼd) + F/|d| ∂ᵢd·∂ⱼd + F n·∂ᵢ∂ⱼd.
void Midpoint::add(const SpringRow& s) {
    const Stretch now = stretch(s, middle_);
    const Vec2 n = now.direction;
    const std::array<Vec2, 6> d = {Vec2{-1, 0}, Vec2{0, -1}, -perpendicular(now.arm_a),
                                   Vec2{1, 0},  Vec2{0, 1},  perpendicular(now.arm_b)};
    const auto unknown = [&s](std::size_t k) {
        return k < 3 ? 3 * std::size_t{s.a} + k : 3 * std::size_t{s.b} + k - 3;
    };

    const double kk = h_ * h_ / 4, cc = h_ / 2 * s.damping, force = s.stiffness * (now.length - s.rest_length);
    const double across = now.length > 0 ? force / now.length : 0;
    const bool along = s.damping_law == DampingLaw::along;
    const double in_line = kk * (s.stiffness - across) + (along ? cc : 0), anyhow = kk * across + (along ? 0 : cc);
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            add_entry(unknown(i), unknown(j), in_line * dot(n, d[i]) * dot(n, d[j]) + anyhow * dot(d[i], d[j]));
    add_entry(unknown(2), unknown(2), kk * force * dot(n, now.arm_a));
    add_entry(unknown(5), unknown(5), -kk * force * dot(n, now.arm_b));
}

void Midpoint::add(const TorsionRow& s) {
    const double value = h_ * h_ / 4 * s.stiffness + h_ / 2 * s.damping;
    const std::size_t a = 3 * std::size_t{s.a} + 2, b = 3 * std::size_t{s.b} + 2;
    add_entry(a, a, value);
    add_entry(b, b, value);
    add_entry(a, b, -value);
}

bool Midpoint::factorise() {
    entries_.clear();
    for (std::size_t k = 0; k < mass_.size(); ++k) {
        const int row = static_cast<int>(k);
        entries_.emplace_back(row, row, mass_[k] != 0 ? mass_[k] : 1);
    }
    for (const SpringRow& s : dynamics_.springs()) add(s);
    for (const TorsionRow& s : dynamics_.torsion_springs()) add(s);
    const auto size = static_cast<Eigen::Index>(mass_.size());
    Matrix lower(size, size);
    lower.setFromTriplets(entries_.begin(), entries_.end());
    if (!analysed_) factors_.analyzePattern(lower);
    analysed_ = true;
    factors_.factorize(lower);
    return factors_.info() == Eigen::Success;
}

/// From the velocities at the midpoint the places there, and the forces.
void Midpoint::evaluate() {
    each([h = h_](double& x, double from, double u) { x = from + h / 2 * u; }, middle_.x, start_.x, middle_.v);
    dynamics_.evaluate(middle_, rates_);
}

Midpoint::Vector Midpoint::residual() const {
    Vector r(static_cast<Eigen::Index>(mass_.size()));
    const auto of = [h = h_](double m, double v, double u, double a) { return m * ((v - u) + h / 2 * a); };
    for (std::size_t i = 0; i < start_.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(3 * i);
        const Vec2 v = start_.v.linear[i], u = middle_.v.linear[i], a = rates_.acceleration.linear[i];
        r[k] = of(mass_[3 * i], v.x, u.x, a.x);
        r[k + 1] = of(mass_[3 * i], v.y, u.y, a.y);
        r[k + 2] = of(mass_[3 * i + 2], start_.v.angular[i], middle_.v.angular[i], rates_.acceleration.angular[i]);
    }
    return r;
}

double largest(const Motion& m) {
    double most = 0;
    for (const Vec2 x : m.linear) most = std::max({most, std::abs(x.x), std::abs(x.y)});
    for (const double x : m.angular) most = std::max(most, std::abs(x));
    return most;
}

bool Midpoint::solve(double tolerance) {
    middle_ = start_;
    middle_.time = start_.time + h_ / 2;
    double change = 0, before = 0;
    for (int round = 0; round < 30; ++round) {
        evaluate();
        // One factorisation serves as long as it brings a digit a round.
        if ((round == 0 || change > 0.1 * before) && !factorise()) return false;
        const Vector step = factors_.solve(residual());
        before = change;
        change = 0;
        for (std::size_t i = 0; i < start_.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(3 * i);
            middle_.v.linear[i] += Vec2{step[k], step[k + 1]};
            middle_.v.angular[i] += step[k + 2];
            change = std::max({change, std::abs(step[k]), std::abs(step[k + 1]), std::abs(step[k + 2])});
            if (step[k] + step[k + 1] + step[k + 2] != step[k] + step[k + 1] + step[k + 2]) return false;
        }
        // Places are known to their last bit only, and velocities to that over half a step.
        if (change <= tolerance * largest(middle_.v) + 1e-15 * largest(start_.x) / h_) return true;
    }
    return false;
}

// Not v + h a: at high stiffness the last bit of a place is a large acceleration.
void Midpoint::finish(State& state) const {
    each([h = h_](double& x, double u) { x += h * u; }, state.x, middle_.v);
    each([](double& v, double u) { v += 2 * (u - v); }, state.v, middle_.v);
    state.account.add(h_, rates_.power);
    state.time += h_;
    dynamics_.place_driven(state);
}

// Where Newton's iteration does not converge, because forces change too much in a step, two halves may.
void step(double tolerance, const Dynamics& dynamics, State& state, double h, int halvings) {
    Midpoint midpoint(dynamics, state, h);
    if (midpoint.solve(tolerance)) return midpoint.finish(state);
    if (halvings == 0)
        throw Error(
            fmt::format("the integrator 'implicit' found no solution at t = {:.6g} s, even with a step of {:.3g} "
                        "s; use a shorter one",
                        state.time, h),
            Error::Cause::run);
    step(tolerance, dynamics, state, h / 2, halvings - 1);
    step(tolerance, dynamics, state, h / 2, halvings - 1);
}

}  // namespace

void propose(const Implicit& options, const Dynamics& dynamics, State& state, double h, Memory&) {
    const double end = state.time + h;
    constexpr int most_halvings = 10;
    step(options.tolerance, dynamics, state, h, most_halvings);
    state.time = end;
}

}  // namespace carom
