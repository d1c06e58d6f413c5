#pragma once
// Islands of bodies in contact: the statics of those that stand, and the precise solve of small ones, Newton's method
// on their velocities.

#include "math/block_matrix.hpp"
#include "math/scratch.hpp"
#include "solvers/island_row.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

struct Mechanism;

/// Bodies that touch one another, and all their contacts.
struct Island {
    Scratch<std::uint32_t> bodies, contacts;
    Scratch<std::uint32_t> mechanisms;  ///< that hold some of them
    BlockMatrix<3> matrix;
    double fastest = 0;      ///< speed of its bodies in this step, as what holds them sees it, if contacts did not hold
                             ///< them, along an axis [m/s]
    bool asked = false;      ///< to be solved whatever it costs
    bool uneven = false;     ///< sweeps do not cope with it: bodies of different mass, or thin ones
    bool took_long = false;  ///< an interior point was needed in this step, and for no rest
    bool gave_up = false;    ///< no solution was found in this step: jammed bodies with friction may have none
};

/// The islands that are worth a precise solve: all small ones if the user wants it precise; else those of up to 20
/// bodies with masses that sweeps do not cope with, in a small world those in which a load presses deep, and up to four
/// bodies on their own.
struct PreciseIslands {
    Scratch<Island> all;
    Scratch<std::uint32_t> place;  ///< of each moving body in its island, if it is in one

    std::uint32_t place_of(std::uint32_t row) const { return row < place.size() ? place[row] : no_place; }
    /// Whether a contact is solved here.
    bool hold(const SoftContact& c) const { return place_of(c.a) != no_place || place_of(c.b) != no_place; }
    /// The one whose contacts a new one would be among, or none if it brings together what is not in one.
    Island* one_for(const SoftScene&, const SoftContact&);
};
PreciseIslands find_precise_islands(const SoftScene&, const Scratch<std::uint32_t>& first, const SoftContacts&);

/// The row of the first body of a mechanism that moves, or no_place.
std::uint32_t first_moving(const SoftScene&, const Mechanism&);
/// The first body of the island of a contact, or of its ends.
template <class Contact>
std::uint32_t first_of(const SoftScene& scene, const Scratch<std::uint32_t>& first, const Contact& c) {
    return first[moves(scene, c.a) ? c.a : c.b];
}
/// Lists the bodies among some rows, which `each_row` calls its argument for, and all contacts of those islands that
/// have a number, by the first body of each; and in `place` where in its island a body is.
template <class Islands, class EachRow>
void list_islands(const SoftScene& scene, const Scratch<std::uint32_t>& first, const Scratch<std::uint32_t>& number,
                  const SoftContacts& contacts, const EachRow& each_row, Islands& islands,
                  Scratch<std::uint32_t>& place) {
    for (std::uint32_t i = 0; i < contacts.all.size(); ++i)
        if (const std::uint32_t k = number[first_of(scene, first, contacts.all[i])]; k != no_place)
            islands[k].contacts.push_back(i);
    each_row([&](std::size_t row) {
        const auto i = static_cast<std::uint32_t>(row);
        if (!moves(scene, i) || number[first[i]] == no_place) return;
        auto& bodies = islands[number[first[i]]].bodies;
        place[i] = static_cast<std::uint32_t>(bodies.size());
        bodies.push_back(i);
    });
}

/// By how much two may overlap [m] without being parted: what a load explains, and a hair of the depth of springs.
inline double explained_overlap(double spring_depth, double loaded) { return 0.01 * spring_depth + loaded; }
/// What is no faster is at rest [m/s], in steps of dt [s].
double speed_at_rest(const SoftScene&, double dt);
/// Whether what a contact touches, or a joint hangs on, may move a body at any time.
bool keeps_awake(const SoftScene&, const Motion& velocity, const SoftContact&);
bool keeps_awake(const SoftScene&, const Motion& velocity, const Mechanism&);
/// Where nothing moves and some were put down since the last step, or nearly nothing has for a while: finds forces that
/// hold an island as it is, and notes who stands by these, in a step of dt in substeps of h [s].
void find_standing(const SoftScene&, const Scratch<std::uint32_t>& first, double dt, double h, const State&,
                   SoftContacts&);

/// Pays back in every step what looking for such forces has cost.
void earn(const SoftScene&, SoftContacts&);

/// The velocities that a body of an island would have without its contacts, if joints gave what they have given so far.
/// All that contacts give is sought along the normals of now; what they gave before these turned is none of it.
inline Mover without_contacts(const Island& island, const std::vector<Mover>& free, const SoftContacts& contacts,
                              std::uint32_t row) {
    Mover m = free[row];
    if (contacts.lists.any_corners) {
        const Mover& lead = contacts.motion.leads[row];
        m.vx -= lead.vx, m.vy -= lead.vy, m.w -= lead.w;
    }
    if (island.mechanisms.empty()) return m;
    const auto& [v, w] = contacts.motion.by_joints[row];
    m.vx += v.x, m.vy += v.y, m.w += w;
    return m;
}

/// The velocities of bodies that rest on what holds their island, three numbers each: none, unless that moves as one.
Scratch<double> velocities_at_rest(const Island&, const PreciseIslands&, const SoftContacts&);

/// Notes which blocks sweeps are to leave alone.
void note_precise(const PreciseIslands&, SoftContacts&);
/// Has contacts that were found in the midst of a step, those from one on, solved in the islands of their bodies.
void take_precisely(const SoftScene&, std::size_t from, PreciseIslands&, SoftContacts&);

/// Islands that were not solved, or at length and not to rounding too often, are left to sweeps for a while: to change
/// between the two in every step would shake them.
void rest_jammed(const PreciseIslands&, SoftContacts&);
/// Those of them that were not solved: in the midst of a step, before islands are looked for anew.
void leave_given_up(const PreciseIslands&, SoftContacts&);

/// Whether contacts are few enough for each to be asked when it changes.
inline bool are_foreseen(const SoftContacts& contacts) { return contacts.all.size() <= 50; }
/// When what bears a few bodies that are solved here changes at once, of the next h [s], by the forces of now: friction
/// has stopped a slip or roll, or who leans on something touches something else, or with another corner, where it is to
/// be struck, however gently. h if nothing does, or as good as at once. Where many land the first parts last this long
/// at least [s], and several strike in one.
double await_change(const PreciseIslands&, const SoftScene&, State&, SoftContacts&, double h, double least);

/// What a solve aims at.
struct Aim {
    double h;        ///< length of the substep [s]
    bool recovers;   ///< overlap is undone too
    double share;    ///< of the substep's impulses that this solve stands for
    double lasting;  ///< for how long of it the forces of the substep before are taken to go on [s]
    double undoes;   ///< part of the speed with which sweeps may undo an overlap
};

/// Replaces the velocities of the island's movers, which were `free` of contacts, and the impulses in the blocks by the
/// solution of all its contacts together (docs/theory/softstep.md), or by that of some sweeps if Newton's method does
/// not find it.
void solve_precisely(Island&, const PreciseIslands&, const SoftScene&, const std::vector<Mover>& free, const Aim&,
                     SoftContacts&);
/// Takes the impulses that the forces before give, and the velocities by them, if they are the solution still; else
/// false.
bool take_warm_solution(const Island&, const PreciseIslands&, const std::vector<Mover>& free, const Aim&,
                        SoftContacts&);
/// With what speed a point is to part [m/s], and with what speed the two are to slip.
double speed_apart(const ContactBlock&, int point, std::uint32_t row, const Aim&);
double speed_of_slip(const ContactBlock&, int point, std::uint32_t row);

}  // namespace carom
