#pragma once
// How much energy a method makes or loses in a run, beside the energies that move in it.

#include "experiment.hpp"

namespace carom::app {

class Drift {
  public:
    explicit Drift(const Plan& plan) : plan_(plan) {}
    /// Looks at some of the states that it is shown.
    void observe(const World& world);
    /// What a person had better know; empty if the energies are right to some per cent.
    std::string doubt(const World& end) const;

  private:
    Plan plan_;
    std::uint64_t next_ = 0;  ///< step at which it looks
    std::optional<Energy> first_{};
    double lost_ = 0, at_play_ = 0;  ///< the largest seen [J]
    double extent_ = 0;              ///< how far from the origin anything is [m]
};

}  // namespace carom::app
