#pragma once
// The impulses of an impact: at one instant, between bodies that touch.

#include <span>

#include "math/scratch.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

/// A body of a blow at that instant.
struct Partner {
    std::uint32_t row;
    double inverse_mass = 0, inverse_inertia = 0;
    Vec2 x{}, v{}, a{};
    double angle = 0, w = 0, alpha = 0;
    double press = 0;  ///< acceleration that it would have without those on whom it leans [m/s²]

    Vec2 velocity_at(Vec2 lever) const { return v + cross(w, lever); }
    void push(Vec2 lever, Vec2 impulse) {
        v += inverse_mass * impulse;
        w += inverse_inertia * cross(lever, impulse);
    }
};

/// What an impulse of 1 N s gives a body, through joints as well.
struct Yield {
    std::uint32_t side;  ///< of the blow's
    Vec2 v;
    double w;
};

/// A contact of a blow, and the impulses that are found for its points.
struct Struck {
    std::uint32_t index;  ///< of all contacts
    Manifold manifold;
    std::uint32_t a, b;  ///< of the blow's sides
    std::array<Vec2, 2> lever[2]{};
    bool active[2]{};
    /// How fast an impulse of 1 N s makes the points part or slip [1/kg], by which way and by where it is given: along
    /// the normal at the first point, across it there, along it at the second point, across it there (the Delassus
    /// operator).
    double coupling[4][4]{};
    double normal[2]{}, tangent[2]{};  ///< impulses [kg m/s]
    double approach = 0;               ///< speed before the blow [m/s]
    double freedom = 1;                ///< how much it yields to a push, as a part of what it would without joints
    bool is_followed = false;          ///< as its impulse grew, from the first of it on
    double rubbed = 0;                 ///< work of friction, then [J]
    struct Range {
        std::uint32_t first = 0, last = 0;
    } yields[2][2]{};    ///< of a point along and across the normal, where a body hangs on joints
    bool waits = false;  ///< to be pushed
    /// Of the one that is pressed, if only one is.
    int lone() const { return active[0] ? 0 : 1; }
    bool pushes() const { return normal[0] > 0 || normal[1] > 0; }

    enum Way { pressing, rubbing };  ///< along the normal and across it
    Vec2 direction(int way) const { return way == pressing ? manifold.normal : perpendicular(manifold.normal); }
    static constexpr int number(int point, int way) { return 2 * point + way; }
};

/// Bodies and contacts at an instant. Contacts are pushed one by one; each push takes into account what went before.
struct Blow {
    Scratch<Partner> before, now;
    Scratch<Struck> struck;
    Scratch<Yield> yields;

    /// For so many bodies and the ground.
    explicit Blow(std::size_t bodies) : place_(bodies + 1, nowhere) {}
    void clear();
    /// A contact joins, whose points touch if they are no wider apart than `close` [m].
    void add(std::uint32_t index, const SoftContact&, const Manifold&, const Partner& a, const Partner& b,
             double close);

    /// The place of a body, which joins if it is new.
    std::uint32_t side(const Partner& body);
    Vec2 velocity(const Struck&, int point) const;
    double approach(const Struck&) const;
    /// By how much the speed of any point of a body changed so far that stretches so far [m/s].
    double most_change(std::uint32_t side, double extent) const;
    /// The impulses that end the approach of all points of a contact together, with Coulomb's friction: found by sweeps
    /// over its points alone, or of one that is alone followed as they grow (Routh). Returns by how much they changed
    /// the speeds at its points at most [m/s].
    double compress(const SoftContact&, Struck&, int sweeps);
    /// Poisson's impact: the impulses that ended the approach are given e times once more. It never makes energy, which
    /// Newton's rule does with friction.
    void expand(const SoftContact&, Struck&);

    /// All of its contacts bounce at once, each by its own restitution, whose approach is ended by all of them
    /// together.
    void bounce(std::span<const SoftContact> all);

    /// Finds a contact's coupling, as its bodies yield.
    void couple(Struck&) const;

  private:
    class Points;
    void apply(const Struck&, int point, int way, double impulse);

    static constexpr std::uint32_t nowhere = 0xffffffff;
    Scratch<std::uint32_t> place_;  ///< of each body
};

/// One that is foreseen, of the contact that begins it.
struct NextBlow {
    double time, approach;
    std::uint32_t contact, version;

    /// std::priority_queue has the largest on top.
    bool operator<(const NextBlow& other) const {
        if (time != other.time) return time > other.time;
        if (approach != other.approach) return approach < other.approach;
        return contact > other.contact;
    }
};

}  // namespace carom
