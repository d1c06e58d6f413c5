#pragma once
// Contacts as the wide kernels solve them: eight at a time, whatever the number of lanes.

#include <stddef.h>
#include <stdint.h>

namespace carom {

/// A body as the solver sees it: its velocities, which are what is solved for.
struct alignas(32) Mover {
    double vx, vy, w;
    double inverse_mass;  ///< 0 where nothing moves it
};

constexpr size_t block_rows = 8;

/// Eight contacts that share no moving body. A row without a contact is one of the ground and the ground. Levers and
/// the way between the bodies are given along the normal and across, along the normal turned by +90°: what they are in
/// the Jacobian. What every sweep reads comes first.
struct alignas(64) ContactBlock {
    using Numbers = double[block_rows];

    uint32_t a[block_rows], b[block_rows];  ///< rows of the movers
    uint32_t points;                        ///< 1 if none of these can have two: one of the two is a disc
    bool any_rolling, any_bounce, any_belt;
    bool any_held;                 ///< of some contacts nothing moves one of the two
    bool any_deep;                 ///< some overlap by more than needs no load
    bool any_corners;              ///< of some it is two rounded corners that may touch
    bool is_precise;               ///< all are solved with their islands: sweeps leave them alone
    bool any_precise;              ///< some are
    bool any_pivots;               ///< on some of them bodies turn: levers are those of the middle of the substep
    bool any_preload;              ///< springs of some bear something without an overlap
    bool is_idle;                  ///< none has had an impulse in this substep, or a force in the one before
    bool is_measured;              ///< the gaps are those of its rows, as the last half of a substep found them
    alignas(64) Numbers normal_x;  ///< from a to b; what lies across two lines of the cache takes twice as long
    Numbers normal_y;
    Numbers between_along, between_across;  ///< from a to b as they were looked at
    Numbers inverse_inertia_a, inverse_inertia_b;
    Numbers friction;
    Numbers recovery;  ///< largest speed [m/s] at which overlap is undone
    struct Point {
        Numbers gap;                            ///< in this half of a substep; far where nothing can touch
        Numbers lever_a_along, lever_a_across;  ///< that of b is the one that ends where it does
        Numbers normal_mass, tangent_mass;
        Numbers normal_impulse, tangent_impulse;  ///< so far in this substep
    } point[2];

    Numbers surface_speed;
    Numbers rolling;       ///< largest moment against rolling, of a normal force of 1 [m]
    Numbers rolling_mass;  ///< the two moments of inertia as one
    Numbers restitution;   ///< of those that sweeps let bounce, else 0
    Numbers shallow;       ///< overlap [m] that needs no load to be there
    Numbers radii;         ///< of the rounded rims together [m]
    Numbers uneven;        ///< radius a less radius b [m]
    Numbers corners;       ///< 1 where two rounded corners may touch: they pass one another on a circle
    Numbers follows;       ///< 1 where the normal turns as they do so, in the midst of each substep
    /// Of the impulses so far what they and their moments on a and b are more with the normal of now than as given.
    Numbers lag_along, lag_across, lag_turn_a, lag_turn_b;
    struct More {
        Numbers open;    ///< 1 where nothing can touch in this substep
        Numbers bounce;  ///< speed [m/s] at which the two are to part, if they press on one another
        Numbers core_a_x, core_a_y, core_b_x, core_b_y;       ///< in the bodies' own frames
        Numbers rolling_impulse;                              ///< so far in this substep
        Numbers normal_force, tangent_force, rolling_moment;  ///< mean ones of the last substep [N], [N m]
        Numbers turned_normal, turned_tangent;  ///< faster [m/s] with the levers of now than with those of the block
        Numbers preload;                        ///< what its spring bears without an overlap [N]
    } more[2];                                  ///< of the points
};

/// Where in a contact that lies which rows are made of, counted in numbers. Lanes read four at a time.
struct ContactFields {
    size_t length;                                                ///< of a contact
    size_t size;                                                  ///< then thickness, restitution and another
    size_t friction;                                              ///< then surface speed, rolling and radius a
    size_t radius_b;                                              ///< then the normal and another
    size_t point, point_length;                                   ///< core a and core b
    size_t normal_force, tangent_force, rolling_moment, preload;  ///< of the first point, then of the second
};
/// What rows are made of: contacts, and their bodies by their rows.
struct RowSource {
    const double* contacts;  ///< the first number of the first one
    ContactFields at;
    const double* frames;  ///< x, y, cosine, sine of each mover
    const Mover* movers;
    const double* inverse_inertia;
    size_t bodies;  ///< from this row on nothing turns
};
/// What contacts are like, a bit for each of the rows of a block.
struct RowKinds {
    uint8_t has_point[2]{}, is_at_wall = 0, is_let_bounce = 0, rounds_a_corner = 0, follows_corner = 0;
};

/// The parameters of soft constraints (Catto, "Soft constraints", GDC 2011) for a substep.
struct Softness {
    double inverse_h;  ///< [1/s]
    double bias_rate;  ///< [1/s] of overlap to be undone
    double mass_scale, impulse_scale;
    double give;       ///< overlap that a force may explain: of a unit of force and of inverse mass [s²]
    double part_rate;  ///< [1/s] of overlap beyond that to be undone
};

/// Work of the contacts' impulses and the like, summed up.
struct ContactSums {
    double landing_work;  ///< along normals: the heat is as much, and negative
    double parting_work;  ///< where overlap is undone
    double slip_work;     ///< on what slips: the heat is as much, and negative
    double belt_work;     ///< of the surfaces that move by themselves

    void operator+=(const ContactSums& more) {
        landing_work += more.landing_work, parting_work += more.parting_work;
        slip_work += more.slip_work, belt_work += more.belt_work;
    }
};

/// What those who hold bodies gave by contacts: impulses and their moments about the origin, summed up.
struct HeldSums {
    struct Given {
        double x, y, moment;
    } walls, all;  ///< of the walls, and of walls and bodies together
};

/// How the first sweep of a half of a substep begins.
struct HalfBegin {
    double warm;  ///< with the impulses of the forces before in so much time [s], which the movers have already
    const double* frames;  ///< x, y, cosine, sine of each mover, for which gaps are measured
    double h;              ///< length of the substep [s]
    double preload_way;    ///< of gaps, for a preload of 1 N on an effective mass of 1 kg [s²]
    Mover* leads;          ///< of the bodies, as normals turn to these frames; null where none is to turn
    bool keeps_gaps;       ///< but for those of blocks that are measured: nobody has moved since
};

/// The blocks of a call share no moving body either: some are solved at once.
struct ContactKernel {
    /// Writes all rows of a block in which the numbers of the bodies stand already and else nothing but 0, for the
    /// contacts of these numbers.
    void (*write_block)(const RowSource&, const uint32_t* contacts, const RowKinds&, ContactBlock&);
    /// Gives the velocities that the forces before give in so much time [s].
    void (*warm_start)(const ContactBlock*, size_t blocks, Mover*, double time);
    /// Notes how fast those that sweeps let bounce are to part: by these velocities without any contact, where that is
    /// more than so much [m/s].
    void (*foresee_bounces)(ContactBlock*, size_t blocks, const Mover*, double least);
    /// One sweep: impulses that undo the overlap within the step, softly. For those after the first one no beginning is
    /// given.
    void (*solve)(ContactBlock*, size_t blocks, Mover*, const Softness&, const HalfBegin*);
    /// One sweep: impulses that stop the approach or make it a bounce, and undo nothing. The first one adds to those so
    /// far.
    void (*relax)(ContactBlock*, size_t blocks, Mover*, const Softness&, const HalfBegin*);
    /// One sweep over movers that have no velocities: those that part what is deep.
    void (*part)(const ContactBlock*, size_t blocks, Mover*, const Softness&);
    /// Makes the impulses of a substep of h [s] forces. Returns their work: impulse times these velocities, which are
    /// the means of those before and after.
    ContactSums (*settle)(ContactBlock*, size_t blocks, const Mover* means, double h);
    /// For movers in these frames, of which `ground` is the number of the walls'.
    HeldSums (*sum_held)(const ContactBlock*, size_t blocks, const Mover*, const double* frames, uint32_t ground);
};
extern const ContactKernel baseline_contact_kernel, avx2_contact_kernel, avx512_contact_kernel;
/// The one for this machine.
const ContactKernel& contact_kernel();

}  // namespace carom
