#pragma once
// How long the parts of a step take, for whoever asks.

#include <array>
#include <chrono>
#include <cstddef>
#include <utility>

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

class StageProfile {
  public:
    bool on = false;
    std::array<double, static_cast<std::size_t>(Work::count)> seconds{};

    /// Returns what was done until now.
    Work turn_to(Work next) {
        const auto time = Clock::now();
        if (now_ != Work::count)
            seconds[static_cast<std::size_t>(now_)] += std::chrono::duration<double>(time - since_).count();
        since_ = time;
        return std::exchange(now_, next);
    }

  private:
    using Clock = std::chrono::steady_clock;
    Work now_ = Work::count;
    Clock::time_point since_{};
};

/// Adds the time from its making to its end to a part of a step, but for that of other parts within it.
class Timed {
  public:
    Timed(StageProfile& profile, Work work)
        : profile_(profile.on ? &profile : nullptr), before_(profile_ ? profile_->turn_to(work) : Work::count) {}
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;
    ~Timed() {
        if (profile_) profile_->turn_to(before_);
    }

  private:
    StageProfile* profile_;
    Work before_;
};

}  // namespace carom
