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
    /// Whether it overlaps, and goes on to in the time that is left [s] though the two part.
    bool stays_closed(double left) const;
};

/// The bodies between the start of a substep of h [s] and its end, both of which blows change on the way. Those that
/// nobody asks for cost nothing.
class Passage {
  public:
    Passage(const SoftScene&, const State& start, const State& end, double h, const SoftContacts&);

    /// A body at a time of the substep.
    Partner at(std::uint32_t row, double t);
    /// Whether one of the two leans on something since before this step.
    bool leans(const SoftContact& c) { return way_of(c.a).leans || way_of(c.b).leans; }
    /// To be called before a contact begins to rest: bodies did not lean on it before.
    void close(std::uint32_t contact) { closed_[contact] = true; }

    static Manifold look_at(const SoftScene&, const SoftContact&, const Partner& a, const Partner& b);
    /// How far a piece of a chain is from who is beside it, for a neighbour has him yet, and may come to it; else 0.
    double gap_beside(const SoftContact&, const Partner& a, const Partner& b) const;
    static Gap gap(const SoftContact&, const Manifold&, int point, const Partner& a, const Partner& b);

    /// How long two cannot touch from a time on [s], by how far they were apart when they were looked at: the one that
    /// stretches less far goes no farther than that until then, as the other's material sees it. Longer than is left of
    /// the substep says no more than that they do not in it.
    double stay_apart(const SoftContact&, double from, const Partner& a, const Partner& b) const;

    /// How long the two take for a part of the thinner one's thickness: who comes to a piece of a chain along another
    /// one is not to be through it before he is seen.
    double little_way(const SoftContact&, const Partner& a, const Partner& b) const;

    /// The larger of what something is for the two of a contact; nothing for a disc, who looks the same however he
    /// turns.
    template <class Of>
    double of_turning(const SoftContact& c, const Partner& a, const Partner& b, Of of) const {
        const double its = is_disc(c, false) ? 0 : of(b);
        return c.at_wall || is_disc(c, true) ? its : std::max(its, of(a));
    }

  private:
    /// How a body goes before it is struck.
    struct Way {
        Vec2 acceleration{}, support{};
        double press = 0, angular_acceleration = 0;
        bool leans = false;
    };
    const Way& way_of(std::uint32_t row);
    Way find_way(std::uint32_t row) const;
    bool is_disc(const SoftContact& c, bool of_a) const;
    void support(std::uint32_t row, Way&) const;

    const SoftScene& scene_;
    const State &start_, &end_;
    double h_;
    const SoftContacts& contacts_;
    static constexpr std::uint32_t unknown = 0xffffffff;
    Scratch<std::uint32_t> place_;  ///< by row, of its way
    Scratch<Way> ways_;
    Scratch<bool> closed_;  ///< contacts that began to rest in this substep
};

inline double press_of(const Partner& a, const Partner& b) { return std::max(a.press, b.press); }
/// Whether a gap is more than what blows leave of their own.
inline bool overlaps(const SoftContact& c, double gap) { return gap < -1e-6 * c.size; }
/// Whether what bounces a little overlaps, and goes on to in the time that is left though the two part.
inline bool is_stuck(const SoftContact& c, const Gap& g, double left) {
    return c.restitution < 1 && overlaps(c, g.width) && g.stays_closed(left);
}

}  // namespace carom
