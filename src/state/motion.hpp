#pragma once
// What an integrator moves: a vector and an angle a body, and their rates. Dense arrays, one row a body.

#include <array>
#include <carom/archive.hpp>
#include <carom/vec2.hpp>
#include <cstddef>
#include <span>
#include <vector>

namespace carom {

/// One vector and one scalar a body: positions and angles, velocities and angular velocities, or accelerations.
struct Motion {
    std::vector<Vec2> linear;
    std::vector<double> angular;

    std::size_t size() const { return linear.size(); }
    void resize(std::size_t n) { linear.resize(n), angular.resize(n); }
    void fill_zero() {
        linear.assign(linear.size(), Vec2{});
        angular.assign(angular.size(), 0.0);
    }
};
/// std::swap would move both three times.
inline void swap(Motion& a, Motion& b) {
    a.linear.swap(b.linear);
    a.angular.swap(b.angular);
}
auto members(Maybe_const<Motion> auto& m) {
    auto& [linear, angular] = m;
    return std::tie(linear, angular);
}

/// Applies f(double&, double...) to every number of `out` and the numbers at the same places of `in`.
template <class F, class... In>
void each(F f, Motion& out, const In&... in) {
    if (out.size() == 0) return;  // there is no first number then to point at
    const auto flat = [](auto& motion) { return &motion.linear.data()->x; };
    const auto flat_loop = [&f, n = 2 * out.size()](double* o, const auto*... i) {
        for (std::size_t k = 0; k < n; ++k) f(o[k], i[k]...);
    };
    flat_loop(flat(out), flat(in)...);
    for (std::size_t k = 0; k < out.size(); ++k) f(out.angular[k], in.angular[k]...);
}

// The ledger. Every account is a flow at each moment, from force and velocity, and the integrator sums flows over time
// as it sums accelerations; impulses add to it at once, by their algebra. The totals of all forces are taken off an
// account of their own, `method`, and what the integrator really changes is added to it, by algebra: what stays there
// is its own error, known without a difference of energies, and if any flow were missing the sum of all accounts would
// not be the change of kinetic energy.

/// Where kinetic energy comes from [W], integrated [J].
enum class Account {
    gravity,  ///< work of the forces with a potential, on all bodies
    spring,
    field,
    damping,         ///< heat in springs
    drag,            ///< heat in the medium
    impact,          ///< heat of inelastic impacts
    friction,        ///< heat of sliding
    bath,            ///< heat given to thermal walls
    wind,            ///< work of a medium that moves
    joint_damping,   ///< heat in the springs of joints
    joint_friction,  ///< heat of brakes and dry friction in joints
    limit,           ///< heat where joints run against their limits
    motor,           ///< work of the joints' motors
    user,            ///< work of forces without a potential, and of whoever changes a potential in time
    driven,          ///< work of whoever drives bodies
    parting,         ///< work of contacts that push apart what overlaps: it gives kinetic energy
    overlap,         ///< work against gravity where overlapping bodies are put apart: it changes no kinetic energy
    correction,      ///< the same where joints that gape are closed
    method,          ///< kinetic energy changed less the work of all forces on the dynamic bodies
    count
};
/// Who gives momentum: force [N] and torque [N m] about the origin, integrated [N s] and [N m s].
enum class Giver { gravity, walls, held, medium, field, user, method, count };  ///< held: fixed and driven bodies

struct Wrench {
    Vec2 force{};
    double torque = 0;

    void add(Vec2 f, double t) { force += f, torque += t; }
    /// A force that acts at a point.
    void add_at(Vec2 x, Vec2 f) { add(f, cross(x, f)); }
};

struct Flows {
    std::array<double, static_cast<std::size_t>(Account::count)> power{};
    std::array<Wrench, static_cast<std::size_t>(Giver::count)> wrench{};

    double& operator[](Account a) { return power[static_cast<std::size_t>(a)]; }
    double operator[](Account a) const { return power[static_cast<std::size_t>(a)]; }
    Wrench& operator[](Giver g) { return wrench[static_cast<std::size_t>(g)]; }
    const Wrench& operator[](Giver g) const { return wrench[static_cast<std::size_t>(g)]; }
    void add(double s, const Flows& other) {
        for (std::size_t k = 0; k < power.size(); ++k) power[k] += s * other.power[k];
        for (std::size_t k = 0; k < wrench.size(); ++k)
            wrench[k].add(s * other.wrench[k].force, s * other.wrench[k].torque);
    }
    void operator+=(const Flows& other) { add(1, other); }
    /// The wrenches, number by number.
    auto wrench_numbers() {
        constexpr std::size_t numbers = 3 * std::tuple_size_v<decltype(wrench)>;
        return std::span<double, numbers>{&wrench.front().force.x, numbers};
    }
};
static_assert(sizeof(Wrench) == 3 * sizeof(double));

/// The point in phase space, with what flowed on the way to it.
struct State {
    double time = 0;
    Motion x, v;
    Flows account;

    std::size_t size() const { return x.size(); }
    void resize(std::size_t n) { x.resize(n), v.resize(n); }
};
auto members(Maybe_const<State> auto& s) {
    auto& [time, x, v, account] = s;
    return std::tie(time, x, v, account);
}

/// dv/dt and the flows, at a State.
struct Rates {
    Motion acceleration;
    Flows flow;
};
auto members(Maybe_const<Rates> auto& r) {
    auto& [acceleration, power] = r;
    return std::tie(acceleration, power);
}

}  // namespace carom
