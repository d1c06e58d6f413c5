#pragma once
#include <carom/joint.hpp>
#include <cstdint>
#include <vector>

#include "state/bodies.hpp"

namespace carom {

/// Which joints are in series: of one ring, which two cuts part, as a bridge between two banks is one through the
/// ground; or on one way to the ground that is the only one, as those of a rope. One of them that breaks relieves the
/// others.
class JointsInSeries {
  public:
    JointsInSeries(const std::vector<Joint>& joints, const Bodies& bodies);
    bool holds(std::uint32_t joint, std::uint32_t other) const;

  private:
    struct Edge {
        std::uint32_t joint, to;
    };
    /// Walks through all that hangs together with a vertex, near ones first.
    void walk(std::uint32_t from, const std::vector<std::vector<Edge>>& edges);
    /// Whether the way of the joint to the ground leads through the other one.
    bool hangs_on(std::uint32_t joint, std::uint32_t other) const;

    static constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> order_;        ///< vertices as they are walked through: rows, and the ground
    std::vector<std::uint32_t> before_, by_;  ///< of each vertex that from which it was found, and the joint
    std::vector<std::uint32_t> below_;        ///< of each joint by which one was found that one
    std::vector<std::uint64_t> ring_;         ///< of each joint the number of its ring; 0 is none
    std::vector<bool> grounded_;              ///< of each vertex: it hangs together with the ground
};

}  // namespace carom
