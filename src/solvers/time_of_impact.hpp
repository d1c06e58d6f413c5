#pragma once
// Bounces at the instant of impact.
//
// Under gravity alone every body flies on a parabola, which is known in advance: each one is moved from impact to
// impact on its own (free flight). With any other force the whole world is brought to the instant of the first impact
// by its integrator, bounces, and goes on from there (any flight): the rest of the step is spent, not dropped, and no
// force is frozen.
//
// A bounce with e < 1 whose flight would last less than 1/256 of the step comes to rest; the energy it still had (½ m
// v² with v < |a| h / 512) is booked as heat of impact. Inelastic discs rest on one another at that speed in any case,
// for in a pile they fall together and nothing presses them. An elastic bounce rests only where its flight is lost in
// rounding, 1e-9 of the step or a hair high, or in who is `Squeezed`. There is no other threshold.
//
// Bodies at rest on walls are carried by them. Discs at rest on one another fly on as if alone, until something strikes
// them or the step ends, and are then put apart: right for a few of them, slow and soft for piles.

#include <algorithm>
#include <cmath>

#include "math/scratch.hpp"
#include "solvers/impulse.hpp"

namespace carom {

/// How two strike one another.
struct Bounce {
    static constexpr double hair = 1e-10;  ///< of the size: a way that is none

    double restitution, approach;  ///< [m/s]
    double pull;                   ///< of what presses them together [m/s²]
    double size;                   ///< of the smaller one [m]
};
/// Whether an impact ends a body's bouncing: if the next flight is too short, or too many bounces came before in this
/// step. That limit is needed because inelastic discs can collide infinitely often in a finite time (truth.json
/// ed.collapse3). Elastic ones cannot unless they are `Squeezed`, but it may take them a while: so does who lies on a
/// floor but for a rounding, and bounces no higher than a hair.
inline constexpr double shortest_flight = 1.0 / 256;  ///< of h
inline constexpr std::size_t most_inelastic = 512;    ///< impacts of a body in a step
inline bool comes_to_rest(const Bounce& b, double h, std::size_t impacts, double shortest_inelastic = shortest_flight) {
    const bool is_elastic = b.restitution >= 1;
    const double shortest_bounce = is_elastic ? 1e-9 : shortest_inelastic;  // of h
    constexpr std::size_t most_elastic = 1 << 22;
    if (!(b.approach > 0) || impacts > (is_elastic ? most_elastic : most_inelastic)) return true;
    if (!(b.pull > 0)) return false;
    const double size = b.size > 0 ? b.size : h * h * b.pull;  // a point has none but its way in the step
    return 2 * b.restitution * b.approach <= shortest_bounce * h * b.pull ||
           (is_elastic && b.approach * b.approach <= 2 * Bounce::hair * size * b.pull);
}
inline constexpr double hardly_moved = 1e-9;  ///< of the size: who is moved by that in a step is not moved
/// The pull [m/s²] between two discs, for comes_to_rest: `press` is what each feels of its own. Without any, inelastic
/// ones rest when a step would move them by a rounding.
inline double pull_of(double relative, double restitution, double press, double distance, double h) {
    return restitution < 1 ? std::max({relative, press, hardly_moved * distance / (h * h)}) : relative;
}

/// Whether a blow ends the rest of others on those who are struck: if it drives these, in a step, farther into them
/// than what presses the two does, or a rounding. A pile that settles would else wake itself for ever.
inline bool ends_rest(double approach, double press, double distance, double h) {
    return approach > std::max(h * press, hardly_moved * distance / h);
}

void advance_to_impacts(const Impulse&, const Flight&, const Walls&, const Bodies&, State&, double h, Contacts&);
void fly_freely(const Impulse&, const Flight&, const Walls&, const Bodies&, State&, double h, Contacts&);
void fly_under_forces(const Impulse&, const Flight&, const Walls&, const Bodies&, State&, double h, Contacts&);

/// Two bodies, or a body and a wall, that touch.
struct Contact {
    static constexpr std::uint32_t no_wall = 0xffffffff;
    std::uint32_t i, j;
    std::uint32_t wall = no_wall;
    bool operator==(const Contact&) const = default;
};
/// How a pair touches when its bodies are where the state says.
Touch touch_of(const Contact&, const Walls&, const Bodies&, const State&);
/// Impacts in a row between which those who strike come no farther than a hair, as an elastic ball does in a shaft as
/// wide as it is: they have no room. The more impacts there were, the more is a hair. What would end is no such row: a
/// light disc that touches a wall and a heavy one strikes them π √(ratio of the masses) times at one instant, until
/// that turns back (G. Galperin, Regul. Chaotic Dyn. 8, 375, 2003).
class Chatter {
  public:
    /// Of so many bodies, or pairs of these.
    Chatter(std::size_t count, const Bodies& bodies) : rows_(count) {
        for (std::size_t i = 0; i < bodies.size(); ++i)
            if (bodies.inverse_mass[i] != 0) heaviest_ = std::max(heaviest_, bodies.mass[i]);
    }
    /// Counts an impact of the k-th, at a time [s] of the step; returns whether its row is endless. Of the two that
    /// strike the lighter one has that inverse mass [1/kg], the smaller one that size [m].
    bool goes_on(std::size_t k, double approach, double time, double inverse_mass, double size) {
        Row& row = rows_[k];
        const double hair = Bounce::hair * static_cast<double>(1 + ++row.all / most_inelastic);
        row.without_room = approach * (time - row.last) > hair * size ? 0 : row.without_room + 1;
        row.last = time;
        const double most = most_inelastic + 4 * std::sqrt(heaviest_ * inverse_mass);
        return row.is_endless = static_cast<double>(row.without_room) > most;
    }
    bool is_endless(std::size_t k) const { return rows_[k].is_endless; }

  private:
    struct Row {
        std::size_t all = 0, without_room = 0;
        double last = 0;  ///< when [s]
        bool is_endless = false;
    };
    Scratch<Row> rows_;
    double heaviest_ = 0;  ///< of all who move [kg]
};
/// Bodies that are squeezed, in a step. Some have no room: their `Chatter` is endless. Others had many impacts, and
/// strike a driven body that comes on, or another one of them: between it and what does not yield elastic ones would be
/// struck infinitely often, and ever harder.
class Squeezed {
  public:
    explicit Squeezed(const Bodies& bodies) : is_(bodies.size()), chatter_(bodies.size(), bodies) {}
    /// Whether a pair that touches at a time [s] of the step is to rest for that; the normal is from i to j. Between a
    /// driven body and another both are squeezed from then on.
    bool hold(const Contact& pair, Vec2 normal, const Bounce& bounce, double time, const Bodies& bodies,
              const State& state, std::size_t impacts) {
        const auto [i, j, wall] = pair;
        const bool at_wall = wall != Contact::no_wall;
        const double lightest = std::max(bodies.inverse_mass[i], bodies.inverse_mass[j]);
        bool has_no_room = chatter_.goes_on(i, bounce.approach, time, lightest, bounce.size);
        if (!at_wall) has_no_room |= chatter_.goes_on(j, bounce.approach, time, lightest, bounce.size);
        if (at_wall || has_no_room) return has_no_room || is_[i];
        const bool comes_on = (bodies.inverse_mass[i] == 0 && dot(state.v.linear[i], normal) > 0) ||
                              (bodies.inverse_mass[j] == 0 && dot(state.v.linear[j], normal) < 0);
        if (impacts <= most_inelastic || !(comes_on || is_[i] || is_[j])) return false;
        for (const std::uint32_t k : {i, j}) is_[k] = bodies.inverse_mass[k] != 0;
        return true;
    }

  private:
    std::vector<bool> is_;
    Chatter chatter_;
};
/// Lets the pair bounce.
void collide(const Contact&, const Touch&, const Bodies&, State&);
/// Ends the approach of a pair, as an impact with e = 0 does. Where one of two discs would be pushed into a wall that
/// it touches, the three come to rest on one another at once: blow by blow a light one would pass on that of a heavy
/// one in as many as this outweighs it.
void bring_to_rest(const Contact&, const Touch&, const Walls&, const Bodies&, State&);
/// Puts bodies at rest that sank into one another, or into walls, apart and stops their approach, and that of all whom
/// they touch. The grid must hold the flights of this step.
void settle_resting(const std::vector<Contact>&, const Impulse&, const Walls&, const Bodies&, Vec2 gravity, State&,
                    Contacts&);

}  // namespace carom
