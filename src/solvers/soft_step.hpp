#pragma once
// SoftStep: contacts of bodies of any shape in substeps. docs/theory/softstep.md has the equations.

#include <array>
#include <carom/event.hpp>
#include <carom/solver.hpp>
#include <cmath>
#include <span>
#include <vector>

#include "forces/flight.hpp"
#include "math/pages.hpp"
#include "math/scratch.hpp"
#include "solvers/body_motion.hpp"
#include "solvers/contact_layout.hpp"
#include "solvers/contact_rows.hpp"
#include "solvers/pair_search.hpp"
#include "solvers/rest.hpp"
#include "state/places_by_body.hpp"
#include "state/profile.hpp"
#include "state/row_ranges.hpp"

namespace carom {

/// How long substeps are and were.
struct Pace {
    double lasted = 0;  ///< the substep that the forces are of [s]; 0: there was none
    double slow = 0;    ///< substeps as long as this came before, and are forgotten in time [s]
    double softer = 1;  ///< so many times as long as one now: contacts give way as in that
};

/// What a blow gains a body at an instant: its way has a kink there.
struct Kink {
    std::uint32_t row;
    double time;  ///< on the world's clock [s]
    Vec2 v;
    double w;
};

/// What happened in a step, for those who listen to events.
struct SoftEvents {
    std::vector<Impact> bounces;   ///< in the order of time
    std::vector<Impact> landings;  ///< of contacts that did not touch before
    std::vector<BodyId> sleeps, wakes;
    std::vector<Kink> kinks;

    void clear() { bounces.clear(), landings.clear(), sleeps.clear(), wakes.clear(), kinks.clear(); }
};

/// What the solver keeps from step to step, and storage that it reuses.
struct SoftContacts {
    std::vector<WarmContact> warm;       ///< in the order of the keys
    std::vector<ContactKey> passing;     ///< who passes a chain from behind until he is out, in that order too
    LargeArray<SoftContact> all;         ///< of the step and solved in it, in that order too but for latecomers
    LargeArray<ContactEnds> ends;        ///< of all but latecomers
    std::vector<std::uint8_t> in_crowd;  ///< by row: its island has many contacts
    PieceTable pieces;
    Outlook outlook;
    PairSearch search;
    Rest rest;
    ContactLayout layout;
    StageLists lists;
    ContactsOfBodies by_body;
    PlacesByBody places;  ///< of all and then of those that rest, for who asks between steps
    BodyMotion motion;
    Pace pace;
    SoftEvents events;
    std::uint64_t strikes = 0;  ///< bounces so far

    /// A step of the world begins, of one advance or more: what is told of it is told anew.
    void begin_step() { events.clear(), rest.is_new = false, places.forget(); }
    /// To be called when anything is changed from outside but velocities.
    void forget_search() { rest.is_known = search.knows_pairs = false; }
    /// To be called when a body moves otherwise or is to be awake: who was left out is looked at again.
    void stir(std::size_t row);
    /// To be called when what others lean on is changed: they are stirred.
    void stir_around(BodyId body, const Bodies&);
    /// To be called when walls are put before others, or taken out: those from this one on have other numbers.
    void renumber_walls(std::uint32_t first, std::uint32_t removed, std::uint32_t added);
};

struct Mechanisms;      // solvers/mechanism.hpp
struct PreciseIslands;  // solvers/islands.hpp

/// All that a substep needs to know.
struct SoftScene {
    const Flight& flight;
    const Walls& walls;
    const Bodies& bodies;
    const std::vector<Piece>& pieces;
    int substeps;
    int cuts;            ///< so many of these are one that was asked for, where forces are stiff
    double drift_share;  ///< part of a substep's kick that the integrator's displacement has in it: Verlet's is ½
    double ramp_share;   ///< the same of what the acceleration grows by in a substep: Verlet's is 0
    Precise precise;     ///< which islands are solved as a whole
    bool keep_energy;    ///< of mechanisms that touch nothing
    bool sleeps;         ///< who is slow for a while falls asleep
    std::optional<double> sleep_speed;  ///< how slow [m/s], if that was said
    bool statics;                       ///< forces are looked for that hold what does not move
    int threads;
    const std::vector<bool>& may_rest;  ///< by row: nothing but a uniform and constant force acts on it
    Mechanisms& mechanisms;             ///< the joints
    StageProfile& profile;
    bool may_leave_out;  ///< the integrator can move some rows alone
};

/// Moves the state by dt [s], in equal substeps, two or four times as many where loads would press bodies deep.
void advance(const SoftScene&, State&, double dt, SoftContacts&);

// The stages of it.

/// The pairs of pieces that are near enough to be looked at; valid until the next call.
std::span<const Near> find_candidates(const SoftScene&, const State&, double dt, double h, SoftContacts&);
/// With what speed [m/s] points of two bodies may come together, as they move now.
double closing_speed(const State&, std::uint32_t a, std::uint32_t b, const SoftContacts&);
/// The pairs that may touch in what is left of a step, dt [s], or in a substep of h where all move fast, with the
/// forces of those that touched before. Who loses one that bore a force is stirred. Nothing is looked for among those
/// that are not awake, if that is known.
void find_contacts(const SoftScene&, const State&, double dt, double h, SoftContacts&);
/// Takes the forces of a contact as it was before, for the features that still meet.
void remember(SoftContact&, const WarmContact&);
/// Takes a contact's forces from where it was solved.
void take_forces(const ContactLayout&, SoftContact&);
/// What a contact leaves to the next step.
WarmContact warm_of(const SoftContact&);
/// Keeps that of all contacts that are solved, so much later [s] than before, or of those at rest.
void keep_warm(const SoftScene&, const State&, double time, SoftContacts&);
void keep_resting_warm(SoftContacts&);
/// Puts that of those roused among the others.
void recall_roused(const SoftScene&, SoftContacts&);
/// Puts that of those at rest among the others, to look for all contacts anew.
void recall_resting(SoftContacts&);
/// Rows of the bodies that may get further in a substep of h [s] than was thought when contacts were looked for: they
/// were struck, or a force is strong.
Scratch<std::uint32_t> find_outrunners(const SoftScene&, const State&, double h, const SoftContacts&);
/// Has them go on as they do now, and returns who is near to them and no contact yet.
Scratch<Near> look_around(const SoftScene&, const State&, double h, const Scratch<std::uint32_t>& outrunners,
                          SoftContacts&);
/// Takes those away from the ones passed over who may meet in a substep of h [s] all the same, with their margins anew,
/// and puts them behind the others.
void take_astray(const SoftScene&, const State&, double h, SoftContacts&, Scratch<Near>& astray);
/// For each body that is looked at the first one of its island: of those that touch one another or are joined.
Scratch<std::uint32_t> firsts_of_islands(const SoftScene&, const SoftContacts&);
/// The same of those that sleep, as they were set aside.
Scratch<std::uint32_t> firsts_of_resting(const SoftScene&, const SoftContacts&);
/// Whether somebody who is awake may touch one who sleeps and was left out of the search.
bool reach_sleepers(const SoftContacts&);
/// Has those looked at who are reached so, and whoever lies with them: their contacts are to be found anew.
void rouse(const SoftScene&, const State&, SoftContacts&);
/// Puts bodies to sleep where all of an island have been at rest for a while, wakes the others, and sets the contacts
/// of those that sleep aside.
void let_sleep(const SoftScene&, const Scratch<std::uint32_t>& first, State&, SoftContacts&);
/// Whether one of a contact's two is in a crowd: an island of many contacts.
bool is_in_crowd(const SoftContact&, const SoftContacts&);
/// Whether one of them is faster than after a fall by a 200th of their size: loads come and go in such a crowd.
bool is_stirred(const SoftScene&, const State&, const SoftContact&, const SoftContacts&);
/// Notes which contacts need no blow, in substeps of h [s].
void note_gentle(const SoftScene&, const State&, double h, const Scratch<std::uint32_t>& first, SoftContacts&);
/// Notes that those are not at rest who are parted, in substeps of h [s]: what undoes an overlap that no load explains
/// moves them and leaves no velocity.
void stir_parted(const SoftScene&, double h, SoftContacts&);
/// Notes who is at rest at the end of a step of dt [s].
void note_rest(const SoftScene&, const State&, double dt, Rest&);
/// The manifold of one that moves far in a substep of h [s], for the movers as they are, and for a pivot as they will
/// be in its middle. What it gives (take_out, put_in), and that it rounds a corner, is for others to note: threads
/// look.
void look_again(const SoftScene&, const State&, double h, SoftContact&, SoftContacts&);
/// Notes that it rounds a corner, if it does.
void note_corner(const SoftContact&, SoftContacts&);
/// Takes in those who went astray or further than was thought, and may meet somebody. False if too many of them are in
/// no crowd, or some need more than that: then all is to be looked for again.
bool take_in(const SoftScene&, const State&, double h, PreciseIslands&, SoftContacts&);
/// Puts the contacts from this one on into blocks, colour by colour, and lists those that have a part in some stages,
/// for substeps of h [s].
void arrange(const SoftScene&, double h, std::size_t first, SoftContacts&);
/// Notes which contacts are pressed in this substep.
void note_pressed(const SoftScene&, SoftContacts&);
/// Notes with what those come together that were not pressed before and did not strike; `proposed` is the substep
/// without contacts.
void note_landings(const SoftScene&, const State& proposed, SoftContacts&);

/// The impact phase: all strikes within a substep in the order of time. `start` is its beginning, whose velocities are
/// changed too, as if the bodies had had them before; `state` is its end.
void strike(const SoftScene&, State& start, State& state, double h, SoftContacts&);
/// By what the number of substeps is multiplied. Twice as many make contacts four times as stiff, and are for whoever
/// asks; but for crowds that fall and are stirred, most of them, for loads come and go there, and overlaps with them;
/// and for what joints hold in crowds, or elsewhere where they are many and most do not ask. Four times as many are for
/// a crowd of which so many are crushed by their like that all may pay for it: stiffer contacts carry a load less far
/// in a sweep, and one that is much heavier than what bears it throws that about.
int more_substeps(const SoftScene&, const State&, double h, const PreciseIslands&, const SoftContacts&);
/// When something that hangs on joints strikes, of the next h [s]; h if nothing does, or as good as at once. Joints
/// bend its way and hold while it strikes: a substep ends there.
double until_strike(const SoftScene&, State&, SoftContacts&, double h);

// What stages ask of a body or a contact.

/// Whether contacts can change the velocity of the body in a row of the movers.
inline bool moves(const SoftScene& scene, std::uint32_t row) {
    return row < scene.bodies.size() && scene.bodies.inverse_mass[row] != 0;
}
inline bool is_driven(const SoftScene& scene, std::uint32_t row) {
    return row < scene.bodies.size() && scene.bodies.kind[row] == Kind::driven;
}
/// The velocity of a point of the body in a row, by its lever; the ground's is 0.
Vec2 velocity_at(const State&, std::uint32_t row, Vec2 lever);
/// Where a contact's point is on the outline of b, whose body is there.
Vec2 point_of(const SoftContact&, int point, Vec2 b);
/// Core a of a point relative to body a; the ground is at the origin.
inline Vec2 core_a_of(bool at_wall, const Manifold& m, int point, Vec2 between) {
    // A wall's point is where its contact is, as seen from the body.
    return at_wall ? between + m.point[point].core_a : m.point[point].core_a;
}
/// Levers of a contact's point: from each body to the middle between the surfaces, where b is so far from a.
inline std::array<Vec2, 2> levers(const SoftContact& c, const Manifold& m, int point, Vec2 between) {
    const Vec2 core_a = core_a_of(c.at_wall, m, point, between);
    const Vec2 middle =
        0.5 * (core_a + c.radius_a * m.normal + between + m.point[point].core_b - c.radius_b * m.normal);
    return {middle, middle - between};
}
/// How two pieces touch when their bodies are there.
Manifold look(const SoftScene&, const Candidate&, const Frame& a, const Frame& b, double margin);
/// The same for a piece of a chain that ended where it does, so that it has a contact with who is beside it, too.
Manifold look_beside(const SoftScene&, const Candidate&, const Frame& a, const Frame& b, double margin);
/// Work that a driven body does at a point of a contact where b gets this impulse and angular impulse.
inline double work_of_driven(const SoftScene& scene, const SoftContact& c, Vec2 impulse, double angular_impulse,
                             const Twist& a, const Twist& b) {
    const auto work = [&](const Twist& of) {
        return dot(impulse, of.velocity) + angular_impulse * of.angular_velocity;
    };
    return (is_driven(scene, c.a) ? work(a) : 0) - (is_driven(scene, c.b) ? work(b) : 0);
}
/// Books what those who hold bodies gave: impulses, and what they were from walls.
void book_held(const Wrench& from_walls, const Wrench& from_bodies, Flows&);
/// The same of an impulse and an angular impulse that b gets from a at a point, where one of the two is held, with the
/// work. Their points move like this.
void book_held(const SoftScene&, const SoftContact&, Vec2 point, Vec2 impulse, double angular_impulse, const Twist& a,
               const Twist& b, Flows&);
/// Whether a body moves, but has nothing that could be turned: a point, or a chain.
inline bool only_shifts(const SoftScene& scene, std::uint32_t row) {
    return moves(scene, row) && scene.bodies.inverse_inertia[row] == 0;
}
/// Books who keeps the spin of such bodies, against what a contact does to it.
void book_driven_spin(const SoftScene&, const State&, const SoftContact&, const std::array<Vec2, 2>& lever,
                      Vec2 impulse, double angular_impulse, Flows&);
/// By how much a contact gives way under the weight of the lighter body, in substeps of h [s] [m].
double overlap_under_weight(const SoftScene&, double h);
/// What a contact that is in its row bears in substeps of h [s].
Load load_of(const SoftScene&, const SoftContact&, const SoftContacts&, double h);
/// Levers of a row's point.
inline Vec2 in_the_world(const ContactBlock& block, std::uint32_t k, double along, double across) {
    const Vec2 n{block.normal_x[k], block.normal_y[k]};
    return along * n + across * perpendicular(n);
}
inline Vec2 lever_a_of(const ContactBlock& block, int point, std::uint32_t k) {
    const auto& p = block.point[point];
    return in_the_world(block, k, p.lever_a_along[k], p.lever_a_across[k]);
}
inline Vec2 lever_b_of(const ContactBlock& block, int point, std::uint32_t k) {
    const auto& p = block.point[point];
    return in_the_world(block, k, p.lever_a_along[k] - block.between_along[k],
                        p.lever_a_across[k] - block.between_across[k]);
}
/// By how much the bodies of a contact may overlap for it to be a spring, without a load [m].
double spring_depth(const SoftContact&);
/// Whether those of any contact from this one on overlapped by more than that when it was found.
bool any_deep(const SoftContacts&, std::size_t first = 0);
/// The parameters of contacts in substeps of h [s] that give way as in those of another length.
Softness softness(double h, double as_in);
/// How stiff a contact of a unit of effective mass is then [1/s²].
double stiffness(double h);
/// What rows of contacts are made of.
RowSource row_source(const Bodies&, const SoftContacts&);
/// Notes what one is like, for its row.
void note_row(const SoftContact&, RowKinds&);
/// Writes a contact's manifold into its row, for bodies in these frames.
void fill_row(const Bodies&, const SoftContact&, const Frame& a, const Frame& b, SoftContacts&);
/// Of what contacts gave all bodies in the substep before, of h [s], the part of one: out before its row is written
/// anew, and in again as it is now. The others' goes on to serve.
void take_out(const SoftContact&, double h, SoftContacts&);
void put_in(const SoftContact&, double h, SoftContacts&);

}  // namespace carom
