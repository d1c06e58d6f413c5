#pragma once
// What flowed through a world's ledger, which its rounding is relative to.

#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <cmath>

namespace carom::test {

class Throughput {
  public:
    explicit Throughput(const World& world)
        : start(carom::energy(world)), before_(start), was_(momentum_balance(world)) {
        energy = largest(before_);
        add_momenta(world, 1);
    }

    /// To be called after every step.
    void add(const World& world) {
        const Energy e = carom::energy(world);
        for (const auto account : {&Energy::kinetic, &Energy::rotational, &Energy::gravity, &Energy::spring,
                                   &Energy::field, &Energy::residual})
            energy += std::abs(e.*account - before_.*account);
        energy += std::abs(e.heat.total() - before_.heat.total()) + std::abs(e.work.total() - before_.work.total());
        energy = std::max(energy, largest(e));

        const MomentumBalance m = momentum_balance(world);
        for (const auto giver :
             {&MomentumBalance::total, &MomentumBalance::gravity, &MomentumBalance::walls, &MomentumBalance::held,
              &MomentumBalance::medium, &MomentumBalance::field, &MomentumBalance::user, &MomentumBalance::residual}) {
            momentum += length((m.*giver).linear - (was_.*giver).linear);
            angular += std::abs((m.*giver).angular - (was_.*giver).angular);
        }
        // What rests is given speed by gravity all the time, and its floor takes it back.
        const double dt = world.time() - time_, gained = dt * length(world.settings().gravity);
        for (const double mass : world.masses()) energy += 0.5 * mass * gained * gained;
        // Every kick rounds every velocity, by 1.1e-16 of it; a step may be cut into parts of up to four kicks. Joints
        // turn spin into momentum, and in a balance back.
        const double least = std::visit(
            [](const auto& solver) {
                if constexpr (requires { solver.substeps; })
                    return solver.substeps;
                else
                    return 1;
            },
            world.settings().solver);
        const double kicks = 4 * std::max(1.0, std::ceil(least * dt / world.stable_step()));
        add_momenta(world, 1.1e-4 * kicks, gained);
        before_ = e, was_ = m, time_ = world.time();
    }

    double energy = 0, momentum = 0, angular = 0;
    Energy start;

  private:
    static double largest(const Energy& e) {
        return std::max({e.kinetic, e.rotational, std::abs(e.gravity), std::abs(e.spring), std::abs(e.field)});
    }
    void add_momenta(const World& world, double weight, double gained = 0) {
        for (std::size_t i = 0; i < world.size(); ++i) {
            const double gyration = std::sqrt(world.moments_of_inertia()[i] / world.masses()[i]);
            const double spin = weight < 1 ? gyration * std::abs(world.angular_velocities()[i]) : 0;
            const double p = weight * world.masses()[i] * (length(world.velocities()[i]) + spin + gained);
            momentum += p;
            angular += p * length(world.positions()[i]);
        }
    }
    double time_ = 0;
    Energy before_;
    MomentumBalance was_;
};

inline void expect_closed(const World& world, const Throughput& through) {
    const Momentum left = momentum_balance(world).unaccounted();
    EXPECT_LE(std::abs(carom::energy(world).unaccounted()), 1e-12 * through.energy) << "t = " << world.time();
    EXPECT_LE(length(left.linear), 1e-12 * through.momentum) << "t = " << world.time();
    EXPECT_LE(std::abs(left.angular), 1e-12 * through.angular) << "t = " << world.time();
}

}  // namespace carom::test
