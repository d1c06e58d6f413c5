#pragma once
// What an integrator moves: a vector and an angle a body, and their rates. Dense arrays, one row a body.

#include <array>
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

/// Applies f(double&, double...) to every number of `out` in the rows from first to last − 1 and the numbers at the
/// same places of `in`.
template <class F, class... In>
void each_row(std::size_t first, std::size_t last, F f, Motion& out, const In&... in) {
    const auto loop = [&f](std::size_t begin, std::size_t end, double* o, const auto*... i) {
        for (std::size_t k = begin; k < end; ++k) f(o[k], i[k]...);
    };
    const auto flat = [](auto& motion) { return &motion.linear.data()->x; };
    loop(2 * first, 2 * last, flat(out), flat(in)...);
    loop(first, last, out.angular.data(), in.angular.data()...);
}
template <class F, class... In>
void each(F f, Motion& out, const In&... in) {
    each_row(0, out.size(), f, out, in...);
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
    void operator+=(const Powers& other) { add(1, other); }
};

/// The point in phase space, with the heat and work that flowed on the way to it [J].
struct State {
    double time = 0;
    Motion x, v;
    Powers account;

    std::size_t size() const { return x.size(); }
    void resize(std::size_t n) { x.resize(n), v.resize(n); }
};

/// dv/dt and the powers, at a State.
struct Rates {
    Motion acceleration;
    Powers power;
};

}  // namespace carom
