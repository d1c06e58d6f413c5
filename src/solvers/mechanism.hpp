#pragma once
// Joints of SoftStep: all that hang together are solved at once, by one direct solve (docs/theory/joints.md).

#include <variant>

#include "joints/joints.hpp"
#include "math/block_matrix.hpp"
#include "solvers/soft_step.hpp"

namespace carom {

/// Where a row is on the staircase of its law.
enum class Step : std::uint8_t {
    held,     ///< the row is kept: by any force, or a motor holds its speed
    lower,    ///< at its lower limit
    upper,    ///< at its upper limit
    pushing,  ///< by the largest force of its motor or spring
    pulling,  ///< the same the other way
    free      ///< by no force
};

/// What a joint carries from step to step, and reports.
struct JointMemory {
    JointId id;
    Step step[most_rows]{};
    double force[most_rows]{};  ///< along its rows, in the last substep
    double mean[most_rows]{};   ///< of the last two substeps, for what rings changes from one to the next
    double half[most_rows]{};   ///< the part of it in one half of that, free of what closed gaps
    Reaction reaction{};
};

/// A row of a joint in a substep.
struct Line {
    JointRow first{}, last{};  ///< where the substep began and where it ends
    double aim = 0;            ///< where a rigid row is to be at the end [m or rad]
    double before = 0;         ///< impulse that the bodies feel before they are moved
    double after = 0;          ///< and after it
    double blow = 0;           ///< and what it bore in impacts before both
    Step step = Step::held;
    Law law{};
};

/// A joint of a mechanism.
struct Member {
    std::uint32_t joint;  ///< of all
    std::uint32_t a, b;   ///< places of its bodies
    std::uint32_t line;   ///< its first one
    std::uint32_t lines;  ///< how many
    bool outside;         ///< the ground, or a body that is held, takes a part of its reaction
    bool is_hinge;        ///< two points are one, and rows that follow are of the angle: the most common
    double size;          ///< what its gaps are compared with [m]
    double per_size;      ///< 1 / size
    Vec2 anchor_a, anchor_b;
    double rest;  ///< angle of a hinge [rad]
};

/// Bodies that hang together by joints.
struct Mechanism {
    struct Part {
        std::uint32_t row;  ///< of the movers
        double inverse_mass, inverse_inertia;
        double ease[3]{};       ///< what momentum is multiplied with in this solve
        double slow[2]{1, 1};   ///< part of its velocity, and angular velocity, with which it drifts
        double stiffness[2]{};  ///< of the joints' forces against moving [N/m] and turning [N m]
        End start{}, now{};
        double v[3]{};      ///< velocity and angular velocity, in the drift slowed down
        double given[3]{};  ///< momentum that the joints gave it in the substep
        double known[3]{};  ///< that part of it which is in v
    };
    std::vector<Part> parts;
    std::vector<Member> members;
    std::vector<Line> lines;
    /// Joints k and l pull on the same part: with rows of their sides a (0) or b (1).
    struct Coupling {
        std::uint32_t k, l, part;
        bool k_is_b, l_is_b;
        std::uint32_t index;  ///< of the matrix's block
    };
    std::vector<Coupling> couplings;
    std::variant<BlockMatrix<1>, BlockMatrix<2>, BlockMatrix<3>, BlockMatrix<4>> matrix;
    std::vector<double> unknowns;
    std::vector<double> kept;      ///< storage
    std::vector<Step> kept_steps;  ///< storage
    std::vector<Step> factored;    ///< the steps of the lines for which the matrix is factored
    bool is_factored = false;
    bool is_simple = true;      ///< none of its rows can be anything but kept
    bool is_dear = false;       ///< a factor costs as much as many rounds
    bool is_touched = false;    ///< a body of it touches something
    bool is_projected = false;  ///< no drift was found at which impulses along the rows of its start keep the joints
};

/// All joints of a world, as its solver sees them.
struct Mechanisms {
    std::vector<Joint> joints;
    std::vector<JointId> ids;         ///< of each joint, ascending
    std::vector<JointMemory> memory;  ///< of each joint
    std::vector<Mechanism> all;       ///< made anew when anything is edited
    std::vector<bool> holds;          ///< by row of the bodies
    /// Rows of bodies that are joined and do not collide, in order.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> apart;

    bool empty() const { return joints.empty(); }
};

/// Makes the mechanisms of the joints, for the rows of these bodies.
void assemble(Mechanisms&, const Bodies&);
void erase(Mechanisms&, std::size_t joint);
/// Drops the joints of bodies that are gone.
void forget_removed(Mechanisms&, const Bodies&);
/// Drops the joints that a restored memory does not know, for they broke.
void keep_remembered(Mechanisms&);
/// Notes which mechanisms touch something.
void note_touched(const SoftContacts&, Mechanisms&);
bool sleeps(const SoftScene&, const Mechanism&, const SoftContacts&);

// The stages of a substep of h [s].

/// Puts the bodies where their joints hold, at no change of velocity, and notes the joints' rows there.
void put_right(const SoftScene&, Mechanisms&, double h, State&, SoftContacts&);
/// Moves the state as the integrator does on its own; but forces that look at velocities see what the joints leave of
/// these: bodies fly as much faster as the joints will make them in the mean of the substep, which is taken back.
void propose_held(const SoftScene&, const Mechanisms&, double h, const SoftContacts&, State&);
/// Velocities with which the joints are kept at the end of the drift; `exact` for the last solve, which looks there.
void hold_drift(const SoftScene&, Mechanisms&, double h, bool exact, SoftContacts&);
/// Drifts those that were slowed down. To be called after all have drifted.
void drift_slowly(const SoftScene&, Mechanisms&, const State& start, double h, State&, SoftContacts&);
/// What springs still give, and velocities with which the joints stay kept. To be begun with after the drift; what
/// touches nothing is held by the last one alone.
void begin_relax(const SoftScene&, Mechanisms&, double h, const State&, SoftContacts&);
void hold_relax(const SoftScene&, Mechanisms&, double h, bool last, const State&, SoftContacts&);
/// A substep as it began, as forces alone propose it, and with its bodies where they are at its end.
struct Course {
    const State &start, &proposed, &end;
};
/// Takes from mechanisms with springs what energy the method made in a substep in which they whirl or ring too fast;
/// and from all that touch nothing whatever it made, if energy is to be kept, or gives them what it lost.
void curb(const SoftScene&, Mechanisms&, double h, const Course&, SoftContacts&);
/// Books what the joints did between two sets of velocities, and keeps their forces.
void book_joints(const SoftScene&, Mechanisms&, double h, const std::vector<Mover>& before, const State&, Flows&,
                 const SoftContacts&);
/// What joints report of the last substep.
void note_reactions(const SoftScene&, Mechanisms&, const SoftContacts&);
/// Books what the joints give those that sleep in a step of dt [s].
void book_resting(const SoftScene&, const Mechanisms&, double dt, const SoftContacts&, Flows&);

}  // namespace carom
