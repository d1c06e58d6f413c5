// The implicit midpoint rule u = v + h/2 a, x' = x + h u, v' = v + 2 (u − v), with the accelerations a at the middle of
// the step. The exception are springs: with their force at the middle of the straight way a stiff network gains energy
// without bound. They act with the mean force that does exactly the work they lose (LaBudde, Greenspan, Numer. Math.
// 25, 323 (1976); Simo, Tarnow, Wong (1992)): with d₀ and d₁ the vectors between the ends before and after the step
//     F = k ((|d₀| + |d₁|)/2 − L) D,   D = (d₀ + d₁)/(|d₀| + |d₁|).
// It differs from the midpoint's in second order and keeps energy at any stiffness and any step.
//
// Newton's iteration takes the springs' derivatives and no others: other forces converge as a fixed-point iteration
// does, which is fast as long as they change little in half a step. Tensions are unknowns of their own, by the
// equation T/k = (|d₀| + |d₁|)/2 − L, eliminated from the linear system: else the tension of a spring that the last
// iterate stretched, large as k, would spoil the next one.

#define EIGEN_MPL2_ONLY
#define EIGEN_DONT_VECTORIZE  // the same bits whatever instructions the compiler may use
#include <fmt/format.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <carom/error.hpp>
#include <cmath>
#include <limits>

#include "forces/gains.hpp"
#include "integrators/propose.hpp"
#include "math/elementary.hpp"

namespace carom {

namespace {

using Vector = Eigen::VectorXd;

/// A spring over the step, at the present iterate.
struct Mean {
    double length = 0;
    Vec2 direction;         ///< D, shorter than 1 where the spring turns
    Vec2 lever_a, lever_b;  ///< with which its force turns the bodies
    Stretch middle, end;
};

/// The derivatives of the vector between a spring's ends by its bodies' places and angles.
using Derivatives = std::array<Vec2, 6>;
Derivatives derivatives(Vec2 arm_a, Vec2 arm_b) {
    return {Vec2{-1, 0}, Vec2{0, -1}, -perpendicular(arm_a), Vec2{1, 0}, Vec2{0, 1}, perpendicular(arm_b)};
}

/// The equations of one step. Body i has the unknowns 3i, 3i + 1 (its velocity) and 3i + 2 (its angular velocity);
/// those that forces do not move stand in a row of their own, 1 δ = 0.
class Midpoint {
  public:
    Midpoint(const Dynamics& dynamics, const State& start, double h);

    /// Newton's iteration for the velocities at the middle; whether it converged.
    bool solve(double tolerance);
    /// Moves a state from the start to the end of the step.
    void finish(State& state) const;

  private:
    void evaluate();
    Mean mean(std::size_t spring) const;
    void replace_spring_forces();
    Vector residual() const;
    bool factorise();
    void add_entry(std::size_t i, std::size_t j, double value) {
        if (mass_[i] != 0 && mass_[j] != 0) entries_.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
    }
    void add_spring(std::size_t spring);
    void add_torsion(const TorsionRow& spring);
    void update_tensions(const Vector& step);
    /// With which turning counts as moving, the radius of gyration [m].
    double arm(std::size_t body) const;
    double largest(const Motion&) const;

    const Dynamics& dynamics_;
    const Springs springs_;
    const State& start_;
    const double h_;
    std::vector<double> mass_;        ///< or moment of inertia; 0 for what forces do not move
    std::vector<Stretch> stretched_;  ///< at the start
    std::vector<double> tension_;
    State middle_, end_;
    Rates rates_;
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
    bool analysed_ = false;
};

Midpoint::Midpoint(const Dynamics& dynamics, const State& start, double h)
    : dynamics_(dynamics), springs_(dynamics.springs()), start_(start), h_(h), mass_(3 * start.size()) {
    for (std::size_t i = 0; i < start.size(); ++i) {
        const double m = dynamics.inverse_mass()[i], inertia = dynamics.inverse_inertia()[i];
        mass_[3 * i] = mass_[3 * i + 1] = m == 0 ? 0 : 1 / m;
        mass_[3 * i + 2] = inertia == 0 ? 0 : 1 / inertia;
    }
    for (const SpringRow& s : springs_) {
        stretched_.push_back(stretch(s, start));
        tension_.push_back(s.stiffness * (stretched_.back().length - s.rest_length));
    }
}

/// From the velocities at the middle the places there and at the end, and the forces.
void Midpoint::evaluate() {
    each([h = h_](double& x, double from, double u) { x = from + h / 2 * u; }, middle_.x, start_.x, middle_.v);
    dynamics_.add_up(middle_, rates_);
    each([h = h_](double& x, double from, double u) { x = from + h * u; }, end_.x, start_.x, middle_.v);
    dynamics_.place_driven(end_);
    replace_spring_forces();
    dynamics_.accelerate(middle_, rates_);
    dynamics_.add_guidance(middle_, rates_);
}

Mean Midpoint::mean(std::size_t k) const {
    const SpringRow& s = springs_[k];
    Mean now;
    now.middle = stretch(s, middle_);
    now.end = stretch(s, end_);
    const double lengths = stretched_[k].length + now.end.length;
    const Vec2 sum = stretched_[k].length * stretched_[k].direction + now.end.length * now.end.direction;
    now.length = lengths / 2;
    now.direction = lengths > 0 ? sum / lengths : Vec2{1, 0};
    // (R(θ₁) − R(θ₀)) r = 2 sin(Δθ/2) × R((θ₀ + θ₁)/2) r: with this lever the torque does the force's work.
    const auto lever = [&](std::size_t body, Vec2 arm) {
        const double half = h_ / 2 * middle_.v.angular[body];
        return half == 0 ? arm : portable::sin(half) / half * arm;
    };
    now.lever_a = lever(s.a, now.middle.arm_a);
    now.lever_b = lever(s.b, now.middle.arm_b);
    return now;
}

/// Puts the mean forces of the springs in the place of those at the middle.
void Midpoint::replace_spring_forces() {
    const auto change = [&](std::size_t i, Vec2 force, double torque) {
        rates_.acceleration.linear[i] += force;  // accelerate() will make accelerations of them
        rates_.acceleration.angular[i] += torque;
        // The levers, which make the work exact, turn a pair a little.
        rates_.flow[Giver::method].add(force, cross(middle_.x.linear[i], force) + torque);
        rates_.flow[Account::spring] += dot(force, middle_.v.linear[i]) + torque * middle_.v.angular[i];
    };
    for (std::size_t k = 0; k < springs_.size(); ++k) {
        const SpringRow& s = springs_[k];
        const Mean now = mean(k);
        const Vec2 force = s.stiffness * (now.length - s.rest_length) * now.direction;
        const Vec2 old = s.stiffness * (now.middle.length - s.rest_length) * now.middle.direction;
        change(s.a, force - old, cross(now.lever_a, force) - cross(now.middle.arm_a, old));
        change(s.b, old - force, cross(now.middle.arm_b, old) - cross(now.lever_b, force));
    }
}

/// M (v + h/2 a − u), which Newton's iteration brings to zero.
Vector Midpoint::residual() const {
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

/// The force on unknown i is −gᵢ·T D with gᵢ by the levers. With eⱼ the derivatives at the end of the step and n the
/// direction there, T changes by k/2 n·eⱼ and D by (eⱼ − (n·eⱼ) D)/(|d₀| + |d₁|), both times h. Damping's derivative by
/// the velocities is added; how it turns with the spring is left to the iteration.
void Midpoint::add_spring(std::size_t k) {
    const SpringRow& s = springs_[k];
    const Mean now = mean(k);
    const Derivatives g = derivatives(now.lever_a, now.lever_b), e = derivatives(now.end.arm_a, now.end.arm_b),
                      m = derivatives(now.middle.arm_a, now.middle.arm_b);
    const auto unknown = [&s](std::size_t q) {
        return q < 3 ? 3 * std::size_t{s.a} + q : 3 * std::size_t{s.b} + q - 3;
    };
    const Vec2 n = now.end.direction, middle = now.middle.direction;
    const double turning = now.length > 0 ? tension_[k] / (2 * now.length) : 0;
    const double damping = h_ / 2 * s.damping, hh = h_ * h_ / 2;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
            const double stiff =
                (s.stiffness / 2 - turning) * dot(g[i], now.direction) * dot(n, e[j]) + turning * dot(g[i], e[j]);
            const double damped =
                s.damping_law == DampingLaw::along ? dot(middle, m[i]) * dot(middle, m[j]) : dot(m[i], m[j]);
            add_entry(unknown(i), unknown(j), hh * stiff + damping * damped);
        }
    // The levers turn with the bodies.
    add_entry(unknown(2), unknown(2), hh / 2 * tension_[k] * dot(now.direction, now.lever_a));
    add_entry(unknown(5), unknown(5), -hh / 2 * tension_[k] * dot(now.direction, now.lever_b));
}

void Midpoint::add_torsion(const TorsionRow& s) {
    const double value = h_ * h_ / 4 * s.stiffness + h_ / 2 * s.damping;
    const std::size_t a = 3 * std::size_t{s.a} + 2, b = 3 * std::size_t{s.b} + 2;
    add_entry(a, a, value);
    add_entry(b, b, value);
    add_entry(a, b, -value);
    add_entry(b, a, -value);
}

bool Midpoint::factorise() {
    entries_.clear();
    for (std::size_t k = 0; k < mass_.size(); ++k) {
        const int row = static_cast<int>(k);
        entries_.emplace_back(row, row, mass_[k] != 0 ? mass_[k] : 1);
    }
    for (std::size_t k = 0; k < springs_.size(); ++k) add_spring(k);
    for (const TorsionRow& s : dynamics_.torsion_springs()) add_torsion(s);
    const auto size = static_cast<Eigen::Index>(mass_.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    if (!analysed_) factors_.analyzePattern(matrix);
    analysed_ = true;
    factors_.factorize(matrix);
    return factors_.info() == Eigen::Success;
}

void Midpoint::update_tensions(const Vector& step) {
    const auto change = [&](std::size_t body, Vec2 arm) {
        const auto k = static_cast<Eigen::Index>(3 * body);
        return Vec2{step[k], step[k + 1]} + cross(step[k + 2], arm);
    };
    for (std::size_t k = 0; k < tension_.size(); ++k) {
        const SpringRow& s = springs_[k];
        const Mean now = mean(k);
        const Vec2 d = h_ * (change(s.b, now.end.arm_b) - change(s.a, now.end.arm_a));
        tension_[k] = s.stiffness * ((now.length - s.rest_length) + dot(now.end.direction, d) / 2);
    }
}

double Midpoint::arm(std::size_t i) const {
    const double mass = mass_[3 * i], inertia = mass_[3 * i + 2];
    return mass == 0 ? 0 : std::sqrt(inertia / mass);
}
double Midpoint::largest(const Motion& m) const {
    double most = 0;
    for (std::size_t i = 0; i < m.size(); ++i)
        most = std::max({most, std::abs(m.linear[i].x), std::abs(m.linear[i].y), arm(i) * std::abs(m.angular[i])});
    return most;
}

bool Midpoint::solve(double tolerance) {
    middle_ = end_ = start_;
    middle_.time = start_.time + h_ / 2;
    end_.time = start_.time + h_;
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 25; ++round) {
        evaluate();
        if (!factorise()) return false;
        const Vector step = factors_.solve(residual());
        update_tensions(step);
        double change = 0, sum = 0;
        for (std::size_t i = 0; i < start_.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(3 * i);
            middle_.v.linear[i] += Vec2{step[k], step[k + 1]};
            middle_.v.angular[i] += step[k + 2];
            change = std::max({change, std::abs(step[k]), std::abs(step[k + 1]), arm(i) * std::abs(step[k + 2])});
            sum += step[k] + step[k + 1] + step[k + 2];
        }
        if (sum != sum || (round >= 6 && change > 0.5 * before)) return false;
        // Places are known to their last bit only, and velocities to that over half a step. A small change after a
        // large one may come from the wrong tensions that the large one left.
        const double fastest = largest(middle_.v), rounding = 1e-15 * largest(start_.x) / h_;
        if (before <= 1e-4 * fastest + rounding && change <= tolerance * fastest + rounding) return true;
        before = change;
    }
    return false;
}

// Not v + h a: at high stiffness the last bit of a place is a large acceleration.
void Midpoint::finish(State& state) const {
    Gains gains(dynamics_);
    for (std::size_t i = 0; i < state.size(); ++i) {
        const Vec2 v = state.v.linear[i], u = middle_.v.linear[i];
        const double w = state.v.angular[i];
        gains.add(i, state.x.linear[i], v, w, h_ * u, 2 * (u - v), 2 * (middle_.v.angular[i] - w));
    }
    gains.book(state.account);
    each([h = h_](double& x, double u) { x += h * u; }, state.x, middle_.v);
    each([](double& v, double u) { v += 2 * (u - v); }, state.v, middle_.v);
    state.account.add(h_, rates_.flow);
    state.time += h_;
    dynamics_.place_driven(state);
}

// Where Newton's iteration does not converge, because forces change too much in a step, two halves may.
void step(double tolerance, const Dynamics& dynamics, State& state, double h, int halvings) {
    {
        Midpoint midpoint(dynamics, state, h);
        if (midpoint.solve(tolerance)) return midpoint.finish(state);
    }
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
    constexpr int most_halvings = 12;
    step(options.tolerance, dynamics, state, h, most_halvings);
    state.time = end;
}

}  // namespace carom
