#pragma once
// What an integrator moves: a vector and an angle a body, and their rates. Dense arrays, one row a body.

#include <array>
#include <carom/archive.hpp>
#include <carom/vec2.hpp>
#include <cstddef>
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
auto members(Maybe_const<Motion> auto& m) {
    auto& [linear, angular] = m;
    return std::tie(linear, angular);
}

/// Applies f(double&, double...) to every number of `out` and the numbers at the same places of `in`.
template <class F, class... In>
void each(F f, Motion& out, const In&... in) {
    const auto flat = [](auto& motion) { return &motion.linear.data()->x; };
    const auto flat_loop = [&f, n = 2 * out.size()](double* o, const auto*... i) {
        for (std::size_t k = 0; k < n; ++k) f(o[k], i[k]...);
    };
    flat_loop(flat(out), flat(in)...);
    for (std::size_t k = 0; k < out.size(); ++k) f(out.angular[k], in.angular[k]...);
}

/// The accounts that fill during flight: each has a power [W] at every moment.
enum class Account { damping, drag, driven, wind, user, count };
struct Powers {
    std::array<double, static_cast<std::size_t>(Account::count)> of{};
    double& operator[](Account a) { return of[static_cast<std::size_t>(a)]; }
    double operator[](Account a) const { return of[static_cast<std::size_t>(a)]; }
    void add(double s, const Powers& other) {
        for (std::size_t k = 0; k < of.size(); ++k) of[k] += s * other.of[k];
    }
};

/// The point in phase space, with the heat and work that flowed on the way to it [J].
struct State {
    double time = 0;
    Motion x, v;
    Powers account;

    std::size_t size() const { return x.size(); }
    void resize(std::size_t n) { x.resize(n), v.resize(n); }
};
auto members(Maybe_const<State> auto& s) {
    auto& [time, x, v, account] = s;
    return std::tie(time, x, v, account);
}

/// dv/dt and the powers, at a State.
struct Rates {
    Motion acceleration;
    Powers power;
};
auto members(Maybe_const<Rates> auto& r) {
    auto& [acceleration, power] = r;
    return std::tie(acceleration, power);
}

}  // namespace carom
