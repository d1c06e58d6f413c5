#pragma once
// What joints pass on of an impact: rigid rows all of it, at its instant, and limits that are reached and pressed,
// while springs and motors give way.

#include <functional>

#include "solvers/blow.hpp"
#include "solvers/mechanism.hpp"

namespace carom {

/// Of all rows the rigid ones alone will be kept.
void keep_rigid_rows(Mechanism&);
/// What momentum `given` to parts of a mechanism gives all of them, in their velocities `v`; it starts from 0. The
/// rows' impulses are left in `after`. Rows are looked up and factored anew where parts are elsewhere than they were.
void pass_on(Mechanism&, const std::vector<Joint>&, bool elsewhere);
/// How a part of a mechanism moves before a blow.
using Before = std::function<Twist(std::uint32_t part)>;
/// Holds the limits that are reached, and against which `push` times what has been passed on drives a mechanism.
/// Returns whether there are any: rows are to be factored anew.
bool hold_stops(Mechanism&, double push, const Before&);

/// The mechanisms that are struck in a substep.
class Links {
  public:
    /// Finds the body in a row as it is at the instant.
    using Look = std::function<Partner(std::uint32_t row)>;

    Links(Mechanisms& mechanisms, std::size_t bodies) : all_(mechanisms), bodies_(bodies) {}
    bool hold(const SoftContact& c) { return hold(c.a) || hold(c.b); }
    /// A blow begins.
    void begin();
    /// A body with the velocity that its joints allow, if this blow is of these.
    Partner held(std::uint32_t row, const Look&);
    /// Gives all that hangs on the two of a contact in a blow the velocities that joints allow, where that counts. In
    /// the midst of a substep those of the flight miss them by what the bodies turned since it began: what can hardly
    /// give way along the normal would take an impulse without end to correct that.
    void turn(Blow&, Struck&, const Look&);
    /// A contact has joined a blow, of which a body hangs on joints: finds how these yield to impulses at its points.
    void tie(Blow&, Struck&, const Look&);
    /// Keeps what rows bore in the blow. Returns their work on the spins of bodies that have nothing that could be
    /// turned, which whoever keeps these takes back.
    double settle(const Blow&);

  private:
    struct Linked {
        std::uint32_t index;  ///< of all mechanisms
        bool is_placed;       ///< where the bodies are at the first blow: the factor serves the others as well
        Mechanism mechanism;
        std::vector<Twist> held{};  ///< how its parts move as joints allow, in this blow; none if nobody asked yet
        bool holds_stops = false;   ///< in this blow
    };
    struct Given {
        std::uint32_t row;
        double momentum[3];
    };
    struct Gain {
        std::uint32_t row;
        Vec2 v;
        double w;
    };

    bool hold(std::uint32_t row);
    void index_rows();
    Linked& linked(std::uint32_t row);
    void place_parts(Linked&, const Look&) const;
    void keep_on_rows(Linked&, const Look&);
    /// Whether what the velocities of the flight miss may count in a contact. Of a body that hangs alone, and gives way
    /// by half of what it would if it were free or more, that is no more than a part of its turn in a substep. It is
    /// left as it is, for then elastic ones trade velocities to rounding.
    static bool are_of_account(const Linked&, const Struck&);
    void give(const Given&, const Look&);
    /// What an impulse of 1 N s at a point of a contact gives all whom it gives anything.
    void find_gains(const Blow&, const Struck&, int point, int way, const Look&);
    void take_gains(Linked&);
    void find_yields(Blow&, Struck&, const Look&);
    /// Holds the limits that are reached, and against which what ends the contact's approach drives a mechanism, for
    /// this blow. Returns whether there are any.
    bool hold_stops(const Blow&, const Struck&, const Look&);

    Mechanisms& all_;
    std::size_t bodies_;
    Scratch<std::uint32_t> of_row_;  ///< the mechanism of each body
    std::vector<Linked> linked_;
    Scratch<Gain> gains_;
    Scratch<std::uint32_t> stirred_;  ///< of those linked
};

}  // namespace carom
