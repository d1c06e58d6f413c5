#pragma once
// What an integrator really changed, for the ledger (Account::method in state/motion.hpp).

#include "forces/dynamics.hpp"

namespace carom {

/// Sums what bodies gain in energy, momentum and angular momentum about the origin where their places and velocities
/// change by dx and dv: ½ m (v + dv)² − ½ m v² = m dv·(v + dv/2), and alike for x × v.
class Gains {
  public:
    explicit Gains(const Dynamics& dynamics) : dynamics_(dynamics) {}

    /// Body i at x with velocity v and angular velocity w.
    void add(std::size_t i, Vec2 x, Vec2 v, double w, Vec2 dx, Vec2 dv, double dw) {
        const double m = dynamics_.mass()[i], inertia = dynamics_.inertia()[i];
        const Vec2 mean = v + 0.5 * dv;
        energy_ += m * dot(dv, mean) + inertia * dw * (w + 0.5 * dw);
        momentum_ += m * dv;
        angular_ += m * (cross(x + 0.5 * dx, dv) + cross(dx, mean)) + inertia * dw;
    }
    Wrench momentum() const { return {momentum_, angular_}; }
    void book(Flows& account) const {
        account[Account::method] += energy_;
        account[Giver::method].add(momentum_, angular_);
    }

  private:
    const Dynamics& dynamics_;
    double energy_ = 0, angular_ = 0;
    Vec2 momentum_{};
};

/// Books the gains of all bodies that start from a state.
inline void book_gains(const Dynamics& dynamics, const State& start, const Motion& dx, const Motion& dv,
                       Flows& account) {
    Gains gains(dynamics);
    for (std::size_t i = 0; i < start.size(); ++i)
        gains.add(i, start.x.linear[i], start.v.linear[i], start.v.angular[i], dx.linear[i], dv.linear[i],
                  dv.angular[i]);
    gains.book(account);
}

}  // namespace carom
