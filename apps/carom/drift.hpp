#pragma once
// How much energy a method makes or loses in a run, beside the energies that move in it.

#include "experiment.hpp"

namespace carom::app {

class Drift {
  public:
    explicit Drift(const Plan& plan) : plan_(plan) {}
    /// Looks at some of the states that it is shown.
    void observe(const World& world);
    /// What a person had better know; the text is empty if the energies are right to some per cent.
    Note doubt(const World& end) const;
    void save(Saver& to) const { to(next_, first_, lost_, at_play_, moved_, held_, extent_); }
    void restore(Loader& from) { from(next_, first_, lost_, at_play_, moved_, held_, extent_); }

  private:
    Plan plan_;
    std::uint64_t next_ = 0;  ///< step at which it looks
    std::optional<Energy> first_{};
    /// The largest seen [J]: what the method made or lost, what moves, and of that all but what pushes apart.
    double lost_ = 0, at_play_ = 0, moved_ = 0;
    bool held_ = false;  ///< something was by joints or contacts
    double extent_ = 0;  ///< how far from the origin anything is [m]

    std::string doubt_residual(const World& end) const;
    std::string doubt_piles(const World& end) const;
};

}  // namespace carom::app
