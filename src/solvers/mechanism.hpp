#pragma once
// Joints of SoftStep: all that hang together are solved at once, by one direct solve (docs/theory/joints.md).

#include <algorithm>
#include <functional>
#include <memory>
#include <variant>

#include "joints/joints.hpp"
#include "math/block_matrix.hpp"
#include "solvers/desk_rows.hpp"
#include "solvers/soft_step.hpp"
#include "state/places_by_body.hpp"

namespace carom {

/// What a joint carries from step to step, and reports.
struct JointMemory {
    JointId id;
    Step step[most_rows]{};
    std::uint32_t projections = 0;  ///< of its mechanism's drift, in so many substeps one after the other
    bool was_slow = false;          ///< parts of that were slowed down
    double force[most_rows]{};      ///< along its rows, in the last substep
    double pull[most_rows]{};       ///< the same without what it bore in impacts
    double mean[most_rows]{};       ///< of that in the last two substeps: what rings changes from one to the next
    double half[most_rows]{};       ///< the part of it in one half of that, free of what closed gaps
    Reaction reaction{};            ///< force and torque alone
    double most_force = 0, most_torque = 0;  ///< that one which breaks bore in a substep of this step
};
auto members(Maybe_const<JointMemory> auto& m) {
    auto& [id, step, projections, was_slow, force, pull, mean, half, reaction, most_force, most_torque] = m;
    return std::tie(id, step, projections, was_slow, force, pull, mean, half, reaction, most_force, most_torque);
}

/// A row of a joint in a substep. What a solve needs follows its row, in the order of DeskLine.
struct JointLine {
    JointRow first{};          ///< where the substep began
    double aim = 0;            ///< where a rigid row is to be at the end [m or rad]
    double before = 0;         ///< impulse that the bodies feel before they are moved
    double half = 0;           ///< its force in one half of the substep before
    JointRow last{};           ///< where the substep ends
    double blow = 0;           ///< what it bore in impacts before both halves
    double after = 0;          ///< impulse that the bodies feel after they were moved
    const Law* law = nullptr;  ///< of its mechanism's laws
    Step step = Step::held;
};

/// A joint of a mechanism.
struct Member : JointShape {
    std::uint32_t joint;  ///< of all
    bool outside;         ///< the ground, or a body that is held, takes a part of its reaction
    bool breaks;          ///< if it bears too much
    // In the order of DeskAnchors.
    double size;      ///< what its gaps are compared with [m]
    double per_size;  ///< 1 / size
    Vec2 anchor_a, anchor_b;
    double rest;        ///< angle of a hinge [rad]
    double longer = 0;  ///< than it says a rod is, of a chain that was given slack [m]

    /// Whether it is one of the two rows in which a hinge's points are one: rigid, and no angle. Their laws need not be
    /// looked up, which of a sheet are as much memory as its rows.
    bool joins_points(std::uint32_t row) const { return is_hinge && row < 2; }
    /// Whether it has none but these.
    bool is_plain() const { return is_hinge && lines == 2; }
};

/// Bodies that hang together by joints.
struct Mechanism {
    struct Part {
        std::uint32_t row;  ///< of the movers
        double inverse_mass, inverse_inertia;
        double slow[2]{1, 1};   ///< part of its velocity, and angular velocity, with which it drifts
        double stiffness[2]{};  ///< of the joints' forces against moving [N/m] and turning [N m]
        // In the order of DeskPart.
        double ease[3]{};   ///< what momentum is multiplied with in this solve
        double v[3]{};      ///< velocity and angular velocity, in the drift slowed down
        double given[3]{};  ///< momentum that the joints gave it in the substep
        double known[3]{};  ///< that part of it which is in v
        End start{}, now{};
    };
    std::vector<Part> parts;
    std::vector<Member> members;
    std::vector<JointLine> lines;
    /// Rows as a solve sees them.
    struct Rows {
        std::vector<JointShape> joints;
        std::vector<BoundShape> bounds;
        std::vector<std::uint32_t> bound_of;  ///< of each of them; `no_bound` of one that is rigid
        std::vector<std::uint32_t> line_of;   ///< of each of them, in the mechanism
        std::uint32_t widest = 1;             ///< so many has a joint at most
        bool operator==(const Rows&) const = default;
    };
    /// Mechanisms that are alike share it.
    struct Shape : Rows {
        Rows after_drift;                      ///< of hinges alone: without those of springs, which are free then
        std::vector<std::uint32_t> spring_of;  ///< the lines that are not there, of each joint; or `no_bound`
        std::vector<Coupling> couplings;       ///< in the order of the matrix's blocks, if it is ordered
        bool has_pairs = false;                ///< some bounds are paired
        struct Holder {
            std::uint32_t joint;
            bool is_b;  ///< by its side b
            bool operator==(const Holder&) const = default;
        };
        std::vector<Holder> holders;              ///< of each part, one after the other, in the order of joints
        std::vector<std::uint32_t> first_holder;  ///< of each part; and the end
        bool operator==(const Shape&) const = default;
    };
    std::shared_ptr<const Shape> shape;
    std::shared_ptr<const std::vector<Law>> laws;  ///< of its lines; shared by those for which they are equal
    std::uint32_t kind = 0;                        ///< those of the same kind are alike
    using Matrix = std::variant<BlockMatrix<1>, BlockMatrix<2>, BlockMatrix<3>, BlockMatrix<4>>;
    Matrix matrix;
    Matrix spare_matrix;  ///< of the rows where a drift ends, if it is redundant; or to see whether it is
    std::vector<double> unknowns;
    /// For what the matrix is factored.
    struct Factored {
        double h = 0;             ///< of the substep; 0 if it is not
        bool is_rounded = false;  ///< the rows are
        std::vector<Step> steps;
        std::vector<JointRow> rows;  ///< if they are rounded
        std::vector<double> ease;    ///< of each part, then
    } factored;
    /// A chain of hinges, rods and ropes that was as long as its way, and has a hair of slack.
    struct Taut {
        struct Place {
            std::uint32_t part;
            Vec2 middle;  ///< of the two points by which the chain holds it, in its frame
            bool turns;   ///< these are not one
        };
        Place from, to;  ///< on what is held
        std::vector<Place> places;
    };
    std::vector<Taut> taut;
    double size = 0;             ///< of its largest joint [m]
    double prepared = 0;         ///< the substep for which it is ready [s]; 0 if it is not
    bool may_have_moved = true;  ///< since then
    bool is_simple = true;       ///< none of its rows can be anything but kept
    bool is_hinged = true;       ///< by hinges alone
    bool is_ordered = false;     ///< it is known in what order its joints are solved, and its matrix has room for that
    bool is_dear = false;        ///< a factor costs as much as many rounds
    bool is_redundant = false;   ///< some of its rigid rows say what others say
    bool has_loops = false;      ///< whether they do depends on where its bodies are
    bool is_slow = false;        ///< some parts are slowed down
    bool is_touched = false;     ///< a body of it touches something
    bool is_asleep = false;
    bool is_carried = false;    ///< its bodies go on to the end of a substep as soon as it has their drift
    bool is_projected = false;  ///< no drift was found at which impulses along the rows of its start keep the joints
    bool is_least = false;      ///< what its rows bear before the drift owes nothing to the substep before
    bool is_given_up = false;   ///< nor any other, to rounding

    /// What is dear is not asked.
    bool may_become_redundant() const { return has_loops && !is_dear; }
};

/// Who are joined and do not collide, by their rows. It is asked for each pair there is.
class KeptApart {
  public:
    KeptApart() = default;
    KeptApart(const std::vector<Joint>& joints, const Bodies& bodies);
    bool contains(std::uint32_t a, std::uint32_t b) const {
        if (b < a) std::swap(a, b);
        if (a + std::size_t{1} >= end_.size()) return false;
        return std::binary_search(others_.begin() + end_[a], others_.begin() + end_[a + 1], b);
    }
    bool operator==(const KeptApart&) const = default;

  private:
    std::vector<std::uint32_t> others_;  ///< of each row those with a larger one, ascending
    std::vector<std::uint32_t> end_;     ///< of these, a row later
};

/// Which joints hold which body.
class Holders {
  public:
    void forget() { places_.forget(); }  ///< joints were edited
    /// The places of those that hold a body, ascending.
    Scratch<std::uint32_t> of(BodyId, const std::vector<Joint>& joints);

  private:
    PlacesByBody places_;
};

inline constexpr std::uint32_t no_mechanism = 0xffffffff;

/// All joints of a world, as its solver sees them.
struct Mechanisms {
    std::vector<Joint> joints;
    std::vector<JointId> ids;         ///< of each joint, ascending
    std::vector<JointMemory> memory;  ///< of each joint
    std::vector<std::uint32_t> home;  ///< of each joint, in which of all it is as it is now; `no_mechanism` if in none
    std::vector<std::uint32_t> breakable;  ///< those that break, ascending
    double cuts = 0;                       ///< in how many parts a second was cut of late; see cut_by_turns()
    std::vector<Mechanism> all;            ///< those that an edit concerns are made anew by the next assembly
    std::vector<bool> holds;               ///< by row of the bodies
    std::vector<unsigned char>
        carries;  ///< by row: those of mechanisms that are carried, until contacts are looked for
    KeptApart apart;
    Holders holders;

    bool empty() const { return joints.empty(); }
    bool all_sleep() const {
        return std::all_of(all.begin(), all.end(), [](const Mechanism& m) { return m.is_asleep; });
    }
};

/// Makes the mechanisms of the joints, for the rows of these bodies, which are there.
void assemble(Mechanisms&, const Bodies&, const Motion& places);
/// Makes chains that are just as long as their way a hair longer; what holds them sees nothing of it.
void loosen(const Bodies&, const Motion& places, const std::vector<Joint>&, const Mechanism::Shape&, Mechanism&);
/// Has those of them sag that lie straight.
void bend(Vec2 gravity, Mechanism&);
/// Has those that are awake ordered: for a large sheet that takes as long as many steps, and what stands needs none.
void order_awake(Mechanisms&);
void add(Mechanisms&, JointId, const Joint&);
void erase(Mechanisms&, std::size_t joint);
/// To be called when a joint is changed.
void note_change(Mechanisms&, std::size_t joint);
/// Whether where a body is that nothing moves decided how a mechanism was assembled: it is one of several that hold it.
bool is_among_holders(Mechanisms&, BodyId);
/// Drops the joints of bodies that are gone.
void forget_removed(Mechanisms&, const Bodies&);
using NumberedJoint = std::pair<JointId, Joint>;
/// Drops the joints that a restored memory does not know, for they broke, and has those again that broke since, which
/// the state `brought` along.
void keep_remembered(Mechanisms&, std::vector<NumberedJoint> brought);
/// Whether a mechanism sleeps as the last search left it.
bool is_left_out(const Rest&, const Mechanism&);
/// Notes which mechanisms touch something and which sleep, until contacts are looked for again. Who is awake, touches
/// nothing and hangs on nothing that is driven is carried: no other looks at its bodies before the substep ends.
void note_touched(const SoftScene&, const SoftContacts&);
/// Notes whose bodies sleep.
void note_asleep(const Rest&, Mechanisms&);

/// The first of the equal parts of what is left of a substep of h [s] in which no row of a joint turns far and nothing
/// that whirls zig-zags fast, or of as many as make about an eighth of it. Rigid rows are let turn until impulses along
/// those of the start keep no joint any more: a substep whose length changes costs energy, too. So in worlds of few
/// joints what once was cut is cut alike for a while.
double cut_by_turns(const SoftScene&, const State&, double left, double h);

// The stages of a substep of h [s].

/// The solves of one half: contacts act between them, and what touches nothing has the last alone.
enum class Round : std::uint8_t { first, next, last };

struct Asked;
/// Mechanisms that touch something, laid out for the solves of a half: of each few of all, how these go on.
struct Desks {
    struct Solve {
        void (*run)(void* of, const Asked&, BodyMotion&);
        std::shared_ptr<void> of;
    };
    Scratch<Scratch<Solve>> of_few{};
};

/// Puts the bodies where their joints hold, at no change of velocity, and notes the joints' rows there. Who was where
/// they hold when the last substep ended is ready.
void put_right(const SoftScene&, Mechanisms&, double h, State&, BodyMotion&);
/// Moves the state as the integrator does on its own; but forces see bodies where joints will have them, and as fast:
/// in the flight they are accelerated as joints will do it in the mean of the substep, which is taken back. `rates` is
/// storage; who is not in the rows that move is left out.
void propose_held(const SoftScene&, Mechanisms&, double h, State&, const RowRanges& moving, Rates& rates);
/// The velocities, by row, that joints will give to those who drift with what `kick` adds to theirs, for their joints
/// to hold where that ends. Only mechanisms that are wanted are looked at, and all stay as they are.
void foresee_drifts(const SoftScene&, Mechanisms&, double h, const State&, const Motion& kick,
                    const std::function<bool(const Mechanism&)>& is_wanted, Scratch<Twist>& gains);
/// Velocities with which the joints are kept at the end of the drift; the last round looks there, and has those that
/// are carried go through the rest of the substep at once, while they are at hand.
void hold_drift(const SoftScene&, Mechanisms&, double h, Round, State&, SoftContacts&, Desks&);
/// Drifts those that were slowed down and are not carried. To be called after all have drifted.
void drift_slowly(Mechanisms&, const State& start, double h, State&, BodyMotion&);
/// What springs still give, and velocities with which the joints stay kept. To be begun with after the drift; what
/// touches nothing is held by the last one alone, which books what the joints did in the substep, too.
void begin_relax(const SoftScene&, Mechanisms&, double h, const State&, BodyMotion&, Desks&);
void hold_relax(const SoftScene&, Mechanisms&, double h, Round, State&, BodyMotion&, Desks&);
/// What joints report of the last substep.
void note_reactions(const SoftScene&, Mechanisms&);
/// Sees those that sleep where they are, and books what their joints give them in dt [s].
void book_resting(const SoftScene&, Mechanisms&, const State&, double dt, const SoftContacts&, Flows&);

}  // namespace carom
