#pragma once
// How long the parts of a step take, for whoever asks.

#include <array>
#include <chrono>
#include <cstddef>

namespace carom {

/// What a step is made of.
enum class Work { pairs, narrow, order, motion, impacts, joints, contacts, precise, parting, books, sleep, all, count };
inline constexpr std::array<const char*, static_cast<std::size_t>(Work::count)> names_of_work{
    "pairs",         // broad phase
    "narrow phase",  // manifolds of the pairs
    "order",         // islands and colours, rows of the contacts
    "motion",        // the integrator under the forces, and what moves bodies by their velocities
    "impacts",       // bounces at their times: continuous collision
    "joints",        // the direct solve
    "contacts",      // sweeps
    "precise",       // islands solved by Newton's method
    "parting",       // what is deep in one another
    "books",         // accounts of energy and momentum
    "sleep",         // who rests and who wakes
    "everything else"};

struct Profile {
    bool on = false;
    std::array<double, static_cast<std::size_t>(Work::count)> seconds{};
};

/// Adds the time from its making to its end to a part of a step.
class Timed {
  public:
    Timed(Profile& profile, Work work)
        : profile_(profile.on ? &profile : nullptr),
          work_(work),
          start_(profile_ ? Clock::now() : Clock::time_point{}) {}
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;
    ~Timed() {
        if (!profile_) return;
        profile_->seconds[static_cast<std::size_t>(work_)] +=
            std::chrono::duration<double>(Clock::now() - start_).count();
    }

  private:
    using Clock = std::chrono::steady_clock;
    Profile* profile_;
    Work work_;
    Clock::time_point start_;
};

}  // namespace carom
