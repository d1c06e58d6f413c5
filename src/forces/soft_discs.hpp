#pragma once
#include <carom/force.hpp>
#include <carom/wall.hpp>
#include <optional>
#include <span>
#include <vector>

#include "forces/loads.hpp"
#include "forces/soft_discs_layout.hpp"

namespace carom {

/// Which discs are near which, good until one of them has moved by half the skin.
struct Neighbours {
    double skin = 0;        ///< 0: not looked for yet
    std::vector<Vec2> was;  ///< places when they were looked for
    std::vector<std::uint32_t> first_column, rows;
};

/// A SoftDiscs force with rows in place of ids. Neighbours are what it remembers: a matter of time, not of bits.
class SoftDiscRows {
  public:
    /// A radius of 0: feels nothing. Pairs of which neither moves are left out. An Error for a box so narrow that two
    /// discs could meet on both sides.
    SoftDiscRows(const SoftDiscs& force, std::span<const double> radius, std::span<const double> inverse_mass,
                 std::vector<bool> moves, const std::optional<Periodic>& box);

    bool damped() const { return damping_ != 0; }
    /// Makes the neighbours good for a state. To be called before add_forces, which may run on several threads.
    void look_around(const State& state, int threads);
    SoftPowers add_forces(const State& state, std::size_t first, std::size_t last, std::span<Vec2> force) const;
    double potential(const State& state) const;
    /// Bounds on the largest squared frequency [rad²/s²] and the largest damping rate [1/s], wherever the discs are, if
    /// they do not crowd into one another (docs/theory/stability.md).
    double squared_frequency() const { return squared_frequency_; }
    double damping_rate() const { return damping_rate_; }

  private:
    void check_box() const;
    Neighbours find(const State& state, int threads) const;
    bool are_good(const Neighbours& neighbours, const State& state, int threads) const;
    SoftLayout layout(const Neighbours& neighbours) const;

    double stiffness_, damping_, squared_frequency_ = 0, damping_rate_ = 0;
    std::vector<double> radius_, inverse_mass_;
    std::vector<bool> moves_;
    std::optional<Periodic> box_;
    double largest_radius_ = 0;
    Neighbours neighbours_;
};

}  // namespace carom
