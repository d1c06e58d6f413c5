#pragma once
#include <array>
#include <span>
#include <vector>

#include "forces/loads.hpp"
#include "forces/network_layout.hpp"
#include "math/scratch.hpp"

namespace carom {

/// Springs between centres of bodies, laid out for the machine: some 50 times as fast as spring by spring.
///
/// The bodies' rows are cut into chunks of eight. Every body lists its springs, and a chunk's lists side by side are
/// its columns (sliced ELLPACK: Kreutzer et al., SIAM J. Sci. Comput. 36, C401, 2014). A column says what is simple
/// about it: partners that are neighbours as the bodies are, so that no index is stored, and parameters that are all
/// the same. The order of columns is the order in which a body's forces are summed, on every machine.
///
/// A spring's parameters lie there once, with its lower row, if both its ends are in columns of neighbours: the higher
/// row reads them there.
class SpringNetwork {
  public:
    SpringNetwork() = default;
    SpringNetwork(std::span<const Link> links, std::size_t rows);

    bool empty() const { return columns_.empty(); }
    bool damped() const { return damped_; }
    /// All springs, from the lower row to the higher and in the order of both, if the rows are few; else none.
    FewLinks few() const { return {few_.data(), few_.size(), rows_, damped_}; }

    /// Room for what write_forces() can keep, in a pass over consecutive rows from this one on at one state.
    class Pass {
      public:
        Pass(const SpringNetwork& network, std::size_t first) : room_(network.kept_), first_(first) {}
        KeptPulls kept() { return {room_.data(), room_.empty() ? ~std::size_t{0} : first_}; }

      private:
        Scratch<double> room_;
        std::size_t first_;
    };

    // For the rows from first, a multiple of chunk_rows, to last − 1.

    /// Writes the force on every body to force[0] … force[last − first − 1]: 0 where there is no spring.
    /// With a pass, the rows before these have been gone through in it.
    NetworkPowers write_forces(const State& state, std::size_t first, std::size_t last, std::span<Vec2> force,
                               Pass* pass = nullptr) const;
    /// Half of the energy of each spring at either end.
    double potential(const State& state, std::size_t first, std::size_t last) const;
    /// Writes what Dynamics::stiffness wants to node[0] … node[last − first − 1].
    void write_stiffness(const State& state, std::size_t first, std::size_t last,
                         const std::vector<double>& inverse_mass, std::span<NodeStiffness> node) const;

    /// The springs one by one, from the lower row to the higher.
    std::vector<Link> links() const;
    /// Bytes held.
    std::size_t bytes() const;

  private:
    friend class NetworkBuilder;
    NetworkLayout layout() const;
    std::size_t chunks() const { return (rows_ + chunk_rows - 1) / chunk_rows; }

    std::size_t rows_ = 0;
    bool damped_ = false;
    std::vector<std::uint32_t> first_column_, partners_;
    std::vector<NetworkColumn> columns_;
    std::vector<double> parameters_;
    std::size_t next_chunk_ = 0;
    std::vector<Band> bands_;
    std::vector<Link> few_;
    std::size_t kept_ = 0;  ///< numbers that a pass keeps
};

}  // namespace carom
