#pragma once
// A contact, what it leaves to the next step, and what is few, slow or little about one.

#include <array>
#include <carom/event.hpp>
#include <type_traits>

#include "collision/manifold.hpp"

namespace carom {

/// Names a contact for as long as it lasts. A wall is a body of generation 0, and goes before all others.
struct ContactKey {
    BodyId a, b;
    std::uint32_t piece_a = 0, piece_b = 0;
    bool operator==(const ContactKey&) const = default;
};
inline bool operator<(const ContactKey& k, const ContactKey& l) {
    const auto both = [](std::uint64_t first, std::uint32_t second) { return first << 32 | second; };
    const auto place = [both](BodyId id) { return both(id.index, id.generation); };
    if (const bool wall = k.a.generation == 0; wall != (l.a.generation == 0)) return wall;
    if (k.a != l.a) return place(k.a) < place(l.a);
    if (k.b != l.b) return place(k.b) < place(l.b);
    return both(k.piece_a, k.piece_b) < both(l.piece_a, l.piece_b);
}

/// What a contact leaves to the next step: the forces [N] at its points.
struct WarmContact {
    ContactKey key;
    std::uint8_t count = 0, precise = 0, touched = 0, touched_before = 0;
    std::uint16_t jammed[2]{};
    std::uint32_t id[2]{};
    double normal_force[2]{}, tangent_force[2]{}, rolling_moment[2]{}, preload[2]{};
};
static_assert(std::has_unique_object_representations_v<ContactKey> &&
              sizeof(WarmContact) == 104);  // no padding is saved

/// A pair of pieces whose boxes may touch in a step; a wall's number as the first.
struct Candidate {
    ContactKey key;
    std::uint32_t piece_a, piece_b;

    bool is_at_wall() const { return key.a.generation == 0; }
};

/// By how much a contact gives way in substeps of some length under the force that it has borne; or if it begins to
/// press, under the weight that it will bear at least, if it is so near.
struct Load {
    double overlap, gap;  ///< [m]

    /// Whether it is pressed deeper than this [m], with so many times the substeps: each gives way by the square less.
    bool presses_deep(double way, int times = 1) const { return gap <= way && overlap > way * times * times; }
};

/// A pair of pieces that may touch in this step. What most passes over all of them ask for comes first, in a line of
/// the cache.
struct alignas(64) SoftContact {
    std::uint32_t a = 0, b = 0;              ///< rows of the movers
    std::uint32_t piece_a = 0, piece_b = 0;  ///< of all pieces; a wall's number as a
    std::uint32_t block = 0, row = 0;        ///< where it is solved
    bool at_wall = false;
    bool is_single = false;       ///< one of the two is round: there is one point at most
    bool rests = false;           ///< pressed together since before this step
    bool fast = false;            ///< may pass far into the thinner one in a substep
    bool turns = false;           ///< one goes round the other's corner in this step
    bool pivots = false;          ///< bodies that turn lean on one another with their corners
    bool gentle = false;          ///< sweeps end the approach as well as a blow does: it needs no instant
    bool lands = false;           ///< a part of a substep began for it to touch: that needs a blow
    bool crowded = false;         ///< it is gentle whatever strikes it from behind: sweeps share that out
    bool touched_before = false;  ///< in the step before
    bool touched = false;         ///< struck in this step or, since what is warm was kept, pressed together
    bool is_deep = false;         ///< as it was found: they overlap by more than a spring takes on without a load
    bool is_hard = false;         ///< one of the two is so much heavier than the other that sweeps are not enough
    bool was_precise = false, precise = false;  ///< its island was solved precisely in the step before, and is now
    bool is_solved[2]{};                        ///< the points that the precise solve under way asks for
    std::uint16_t jammed[2]{};  ///< what precise solves of its island cost of late, while all were even, and while not
    double size = 0;            ///< of the smaller one [m]
    double thickness = 0;       ///< of the thinner one [m], no more than that
    double restitution = 0;
    Load load{};  ///< as it was found
    double friction = 0, surface_speed = 0;
    double rolling = 0;                 ///< largest moment against rolling, of a normal force of 1 [m]
    double radius_a = 0, radius_b = 0;  ///< of the rounding of their outlines [m]
    Manifold manifold{};
    double normal_force[2]{}, tangent_force[2]{}, rolling_moment[2]{};  ///< of the substep before [N], [N m]
    ContactKey key{};
    double preload[2]{};  ///< what the springs at its points bear without an overlap [N]
    static constexpr std::uint32_t no_shape = 0xffffffff;  ///< of a wall that is gone
    std::uint32_t shape_a = 0, shape_b = 0;  ///< numbers of the bodies' shapes; at a wall the first is the wall's
    double least_thickness = 0;              ///< of the two, whatever their size; see thickness()
    struct Seen {
        double gap;  ///< [m], 0 if they touched nowhere near
        Vec2 between;
        double angle_a, angle_b;
    } seen{};  ///< where the two bodies were when they were looked at last

    bool pressed() const { return touched_before || touched; }  ///< most of those that did not never will
    Candidate candidate() const { return {key, piece_a, piece_b}; }
    ShapePair shapes() const { return {{at_wall ? BodyId{} : key.a, shape_a}, {key.b, shape_b}}; }
};

/// What does not bounce and comes together slower than gravity makes it in so many substeps needs no blow at its
/// instant: sweeps end the approach, and the error of that is of the order of the substep's square.
inline constexpr double gentle = 8;
/// What bounces for less than this part of a substep is one of the contacts that press.
inline constexpr double least_bounce = 0.25;
/// No blow is needed by what bounces little or not in an island of more contacts than so many: a blow there is the
/// crowd's, and sweeps share it out.
inline constexpr std::uint32_t crowd = 50;

/// Contacts closer than this part of a piece's size are solved, and not left for the steps to come.
inline constexpr double speculation = 0.05;
/// What is thinner than this part of its size tilts by what others hardly feel.
inline constexpr double thin = 0.1;
/// A coefficient of restitution that leaves a quarter of the energy.
inline constexpr double bounces_little = 0.5;

/// Whether two corners may touch of which one is round.
inline bool rounds_a_corner(const Manifold& m, double radius_a, double radius_b) {
    return m.corners && m.count == 1 && radius_a + radius_b > 0;
}
inline bool rounds_a_corner(const SoftContact& c) { return rounds_a_corner(c.manifold, c.radius_a, c.radius_b); }
/// Whether the normal of such a one turns with them in the midst of each substep: a pivot has that of its middle.
inline bool follows_corner(const SoftContact& c) { return rounds_a_corner(c) && !c.pivots; }
/// Whether a contact is looked at in every substep, and whether it may strike in one.
inline bool is_looked_at_anew(const SoftContact& c) { return c.fast || c.turns || c.pivots; }
inline bool may_strike(const SoftContact& c) { return !c.rests && (!c.gentle || c.lands); }
/// Whether sweeps let one bounce.
inline bool is_let_bounce(const SoftContact& c) { return c.crowded && !c.rests && c.restitution > 0; }

}  // namespace carom
