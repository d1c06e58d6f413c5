#pragma once
// How bodies pass through a substep, and whether and when two of them meet in it.

#include <algorithm>
#include <optional>

#include "math/scratch.hpp"
#include "solvers/blow.hpp"

namespace carom {

/// A point of a contact at some time, and how its gap changes.
struct Gap {
    double width, rate, acceleration;

    /// When it closes from now on, if it does.
    std::optional<double> closes() const;
};

/// The bodies between the start of a substep of h [s] and its end, both of which blows change on the way.
class Passage {
  public:
    Passage(const SoftScene&, const State& start, const State& end, double h, const SoftContacts&);

    /// A body at a time of the substep.
    Partner at(std::uint32_t row, double t) const;
    /// Whether one of the two leans on something since before this step.
    bool leans(const SoftContact& c) const { return leans_[c.a] || leans_[c.b]; }

    static Manifold look_at(const SoftScene&, const SoftContact&, const Partner& a, const Partner& b);
    static Gap gap(const SoftContact&, const Manifold&, int point, const Partner& a, const Partner& b);

    /// Whether two are too far apart to touch from a time to the end of the substep, by how far they were apart when
    /// they were looked at: the one that stretches less far goes no farther than that, as the other's material sees it.
    bool are_apart(const SoftContact&, double from, const Partner& a, const Partner& b) const;

    /// The larger of what something is for the two of a contact; nothing for a disc, who looks the same however he
    /// turns.
    template <class Of>
    double of_turning(const SoftContact& c, const Partner& a, const Partner& b, Of of) const {
        const double its = is_disc(c, false) ? 0 : of(b);
        return c.at_wall || is_disc(c, true) ? its : std::max(its, of(a));
    }

  private:
    bool is_disc(const SoftContact& c, bool of_a) const;
    void support();

    const SoftScene& scene_;
    const State &start_, &end_;
    double h_;
    const SoftContacts& contacts_;
    Scratch<Vec2> acceleration_, support_;
    Scratch<double> press_;
    Scratch<double> angular_acceleration_;
    Scratch<bool> leans_;
};

}  // namespace carom
