#pragma once
// What the search for candidates knows of bodies and pairs, for the files that look for them.

#include "math/made.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

/// The box of a piece where it is.
void bound_piece(const SoftScene& scene, std::uint32_t i, SoftContacts& contacts);
/// A piece's box with the room in which it may get, and so much more [m].
Aabb with_room(const PieceTable& pieces, const Outlook& outlook, std::size_t piece, double more = 0);
/// Where there are so few pieces to look at all in reach costs little: each blow is at its instant, and who is struck
/// in a substep may in it, by twice the speed of the fastest, strike others out of its own reach.
inline bool are_few(const SoftScene& scene) { return scene.pieces.size() <= 50; }
/// Makes two pieces whose rooms overlap a candidate, unless they cannot meet.
void add_pair(const SoftScene& scene, BoxPair pair, SoftContacts& contacts);
void add_wall(std::uint32_t wall, std::uint32_t piece, SoftContacts& contacts);
/// How far a box is from a wall; less than 0 if it reaches into it.
double apart(const Wall& wall, const Aabb& box);
/// How far [m] bodies may get in so much time [s]: with what speed they have and gravity gives them, and by turning.
class WayAhead {
  public:
    WayAhead(const SoftScene& scene, const State& state, double time)
        : bodies_(scene.bodies), v_(state.v), time_(time), fall_(length(scene.flight.dynamics.gravity()) * time) {}
    double of(std::size_t row, double extent) const {
        const double speed = length(v_.linear[row]) + std::abs(v_.angular[row]) * extent;
        return (speed + (bodies_.inverse_mass[row] == 0 ? 0 : fall_)) * time_;
    }

  private:
    const Bodies& bodies_;
    const decltype(State::v)& v_;
    double time_, fall_;
};
/// Two bodies, and how the one that stretches less far moves as the other one's material sees it where it is.
class Passing {
  public:
    Passing(const SoftContacts& contacts, std::uint32_t a, std::uint32_t b) {
        const bool a_is_small = contacts.pieces.extent[a] < contacts.pieces.extent[b];
        small = a_is_small ? a : b, large = a_is_small ? b : a;
        extent_ = contacts.pieces.extent[small];
        lever_ = contacts.motion.frames[small].position - contacts.motion.frames[large].position;
    }
    std::uint32_t small, large;

    /// No point of it is farther from the other one's position.
    double span() const { return length(lever_) + extent_; }
    /// The most that any point of it does, for the twists of both.
    double most(const Twist& s, const Twist& l) const {
        return length(s.velocity - l.velocity - cross(l.angular_velocity, lever_)) +
               std::abs(s.angular_velocity - l.angular_velocity) * extent_;
    }

  private:
    double extent_;
    Vec2 lever_;
};

inline Twist twist_of(const State& state, std::uint32_t row) {
    return row < state.size() ? Twist{state.v.linear[row], state.v.angular[row]} : Twist{};
}

/// How bodies go on if they go on as they did when contacts were looked for. It is asked for each pair there is, so
/// that what all have in common is looked up once.
class Foresight {
  public:
    Foresight(const SoftScene& scene, const SoftContacts& contacts)
        : bodies_(scene.bodies),
          outlook_(contacts.outlook),
          asleep_(contacts.rest.asleep),
          gravity_(scene.flight.dynamics.gravity()),
          g_(length(gravity_)) {}

    bool falls(std::uint32_t row) const {
        return row < bodies_.size() && bodies_.inverse_mass[row] != 0 && !asleep_[row];
    }
    /// How far [m] a body may get in the time to look ahead, struck or not: those left out fall, if they wake.
    double reach_ahead(std::uint32_t row) const {
        const bool sleeps = row < asleep_.size() && asleep_[row];
        const double own = sleeps ? g_ * outlook_.ahead * outlook_.ahead : outlook_.reach[row];
        return row < bodies_.size() && bodies_.inverse_mass[row] != 0 ? own + outlook_.thrown : own;
    }
    /// How a body moves t [s] after contacts were looked for.
    Twist at(std::uint32_t row, double t) const {
        const Twist then = twist_of(outlook_.from, row);
        if (t == 0 || !falls(row)) return then;
        return {then.velocity + t * gravity_, then.angular_velocity};
    }
    /// How far it is off that way by then, or in h [s] from then on.
    Twist off_way(const State& state, std::uint32_t row, double t, double h) const {
        if (row >= state.size()) return {};
        const auto& [time, x, v, account] = outlook_.from;
        const Vec2 gone = state.x.linear[row] - x.linear[row], dv = state.v.linear[row] - v.linear[row];
        const Vec2 fallen = falls(row) ? (0.5 * t + h) * t * gravity_ : Vec2{};
        return {gone - t * v.linear[row] + h * dv - fallen, state.x.angular[row] - x.angular[row] - t * v.angular[row] +
                                                                h * (state.v.angular[row] - v.angular[row])};
    }
    /// How much nearer [m] two bodies may come in so much time.
    double approach(const Passing& pair, const Twist& s, const Twist& l, double t) const {
        const bool fall_together = falls(pair.small) && falls(pair.large);
        const double falling = fall_together ? 0 : g_ * t;
        // While the one goes straight on the other one turns under it.
        const double bend = 0.5 * t * std::abs(l.angular_velocity) * length(s.velocity - l.velocity);
        return t * (pair.most(s, l) + falling + bend);
    }

  private:
    const Bodies& bodies_;
    const Outlook& outlook_;
    const std::vector<std::uint8_t>& asleep_;
    Vec2 gravity_;
    double g_;
};

/// How far apart [m] the two of a candidate are looked at in any case.
double spare_of(const Candidate& c, const PieceTable& pieces);

/// How near the pieces of candidates have to be to be a contact, in substeps of h [s]. What bounces much, or is one of
/// few, may be struck by whoever is in reach. The others are taken to go on as they do; who does not is looked at a
/// substep later, and is not to be through the other one by then.
class Nearness {
  public:
    Nearness(const SoftScene& scene, const State& state, double h, const SoftContacts& contacts);
    /// Of a candidate.
    Near of(std::uint32_t index) const;

  private:
    /// How far apart the boxes of a candidate are, along an axis; less than 0 if they overlap.
    double boxes_apart(const Candidate& c) const;

    const SoftScene& scene_;
    const State& state_;
    const SoftContacts& contacts_;
    Foresight foresight_;
    double gone_;  ///< [s] since contacts were looked for
    double h_;
    bool are_few_;
};

}  // namespace carom
