#pragma once
// What the search for candidates knows of bodies and pairs, for the files that look for them.

#include "math/made.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

/// The box of a piece where it is.
void bound_piece(const SoftScene& scene, std::uint32_t i, SoftContacts& contacts);
/// A piece's box with the room in which it may get, and so much more [m].
Aabb with_room(const SoftContacts& contacts, std::size_t piece, double more = 0);
/// Makes two pieces whose rooms overlap a candidate, unless they cannot meet.
void add_pair(const SoftScene& scene, BoxPair pair, SoftContacts& contacts);
void add_wall(std::uint32_t wall, std::uint32_t piece, SoftContacts& contacts);
/// How far a box is from a wall; less than 0 if it reaches into it.
double apart(const Wall& wall, const Aabb& box);
/// How far [m] bodies may get in so much time [s]: with what speed they have and gravity gives them, and by turning.
class Reach {
  public:
    Reach(const SoftScene& scene, const State& state, double time)
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
/// How far [m] a body may get in the time to look ahead: those left out fall, if they wake.
double reach_ahead(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row);

/// Two bodies, and how the one that stretches less far moves as the other one's material sees it where it is.
class Passing {
  public:
    Passing(const SoftContacts& contacts, std::uint32_t a, std::uint32_t b) {
        const bool a_is_small = contacts.extent[a] < contacts.extent[b];
        small = a_is_small ? a : b, large = a_is_small ? b : a;
        extent_ = contacts.extent[small];
        lever_ = contacts.frames[small].position - contacts.frames[large].position;
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

Twist twist_of(const State& state, std::uint32_t row);
bool falls(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row);
/// How a body moves in t [s] after contacts were looked for, if it goes on as it did.
Twist foreseen(const SoftScene& scene, const SoftContacts& contacts, std::uint32_t row, double t);
/// How far a body is off the way that was foreseen, t [s] after contacts were looked for, or in h [s] from then on.
Twist off_way(const SoftScene& scene, const State& state, const SoftContacts& contacts, std::uint32_t row, double t,
              double h);
/// How much nearer [m] two bodies may come in so much time, if they go on as they do.
double foreseen_approach(const SoftScene& scene, const SoftContacts& contacts, const Passing& pair, const Twist& s,
                         const Twist& l, double t);
/// How far apart [m] the two of a candidate are looked at in any case.
double spare_of(const Candidate& c, const SoftContacts& contacts);
/// How near the pieces of a candidate have to be to be a contact, in substeps of h [s]. What bounces much, or is one of
/// few, may be struck by whoever is in reach. The others are taken to go on as they do; who does not is looked at a
/// substep later, and is not to be through the other one by then.
Near nearness(const SoftScene& scene, const State& state, std::uint32_t index, double h, const SoftContacts& contacts);

}  // namespace carom
