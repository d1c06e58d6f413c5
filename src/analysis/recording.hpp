#pragma once
// Runs of one world under several methods, sampled at the same times.

#include <carom/convergence.hpp>

namespace carom {

/// Vectors of a fixed length, one a sample. What a run did not reach is infinite, what is not
/// defined is NaN.
using Track = std::vector<std::vector<double>>;

/// The samples of a run: the state, 6 numbers a dynamic body (x, y, k θ, vx, vy, k ω with the radius of gyration k),
/// and each probe.
struct Recording {
    Track state;
    std::vector<Track> probes;
    std::vector<std::uint64_t> collisions;
    std::vector<double> made_or_lost;  ///< by the method since the start: the residual of the ledger [J]
    bool touched = false;              ///< at a sample, or before it
    double energies = 0;               ///< at play: the largest kinetic energy, or change of a potential one [J]
    StudyRun run;
};

/// The steps of the run that is checked, and where it is sampled.
class Schedule {
  public:
    Schedule(const World& start, const StudyPlan& plan);

    const std::vector<double>& time() const { return time_; }
    /// Steps of a run that divides every step by so many.
    double work(double division) const { return steps_ * division; }
    /// Into how many parts the world itself cuts the longest step, for its springs' sake.
    double cut() const { return cut_; }

    /// The world as it is at every sample. With a division of 0 there is one step from sample to sample; of 1, the
    /// steps are those of the run that is checked; else each of those, and each part into which the world would cut it,
    /// is divided. What it throws, but for a run that goes wrong, is passed on.
    Recording record(World world, double division, const std::vector<Probe>& probes,
                     const std::function<void(double steps)>& progress) const;

  private:
    struct Leg {
        std::uint64_t steps;
        double step;
    };
    void advance(World& world, const std::vector<Leg>& legs, double division) const;
    std::vector<std::vector<Leg>> legs_;  ///< from sample to sample
    std::vector<double> time_;
    double steps_ = 0, cut_ = 1;
};

}  // namespace carom
