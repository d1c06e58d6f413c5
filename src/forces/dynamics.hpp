#pragma once
// The right-hand side of the equations of motion: all forces of a world, with rows in place of ids.

#include <carom/force.hpp>
#include <functional>
#include <vector>

#include "forces/attraction.hpp"
#include "forces/drag.hpp"
#include "forces/field.hpp"
#include "forces/network.hpp"
#include "forces/soft_discs.hpp"
#include "forces/spring.hpp"
#include "math/scratch.hpp"
#include "state/bodies.hpp"
#include "state/numbered.hpp"
#include "state/row_ranges.hpp"
#include "state/rows.hpp"

namespace carom {

/// A driven body on a curve.
struct Drive {
    BodyId body;
    std::function<Pose(double time)> curve;
};

/// Where a curve leads and how fast, at a time [s].
struct OnCurve {
    Pose pose;
    Vec2 velocity;
    double angular_velocity;
};
OnCurve on_curve(const std::function<Pose(double time)>& curve, double time);
void put(const OnCurve&, std::size_t row, State&);

/// Everything that acts, as the user gave it.
struct Forces {
    Vec2 gravity{};
    Numbered<Spring> springs;
    Numbered<TorsionSpring> torsion_springs;
    Numbered<Drag> drags;
    Numbered<Attraction> attractions;
    Numbered<SoftDiscs> soft_discs;
    Numbered<ConstantForce> constant_forces;
    Numbered<ForceField> fields;
    Numbered<UserForce> user_forces;
    std::vector<Drive> drives;

    /// Drops all that holds on to bodies that are gone, and curves of bodies that are not driven any more.
    void forget_removed(const Bodies& bodies);
};

/// Whether a force names one or two bodies, or may do so; the others act on all.
template <class Force>
concept Holding = requires(const Force& f) {
    BodyId{f.a};
}
|| requires(const Force& f) { std::optional<BodyId>{f.body}; };

/// Calls act(id) for the bodies that a force names.
template <Holding Force, class Act>
void each_body_of(const Force& force, const Act& act) {
    if constexpr (requires { force.a; })
        act(force.a), act(force.b);
    else if constexpr (requires { *force.body; }) {
        if (force.body) act(*force.body);
    } else
        act(force.body);
}
/// Whether a body that it names is gone.
template <Holding Force>
bool is_left(const Force& force, const Bodies& bodies) {
    bool left = false;
    each_body_of(force, [&](BodyId id) { left = left || !bodies.contains(id); });
    return left;
}
/// Makes it one of those whose body is gone.
template <Holding Force>
void leave(Force& force) {
    if constexpr (requires { force.a; })
        force.a = BodyId{};
    else
        force.body = BodyId{};
}

/// What limits the step of an explicit method: the largest angular frequency of springs and soft discs [rad/s], and the
/// damping rate of theirs and of drag [1/s].
struct Stiffness {
    double frequency = 0;
    double damping_rate = 0;
};

/// Accelerations of some rows that are no force's of the world's, and by what they grow in a second.
struct Guidance {
    struct Row {
        std::uint32_t row;
        Vec2 linear, growth;
        double angular, angular_growth;  ///< zero if no force of the world's turns anybody
    };
    Scratch<Row> rows;
    double since;  ///< when they are what they are [s]
};

class Dynamics {
  public:
    Dynamics() = default;
    Dynamics(const Forces& forces, const Bodies& bodies, int threads = 1, const std::optional<Periodic>& box = {});

    /// What an evaluation is for. With the accelerations alone, as in a round of an iteration that is not the last, the
    /// flows in `rates` mean nothing; with wrenches the powers mean nothing, and velocities need not be right.
    enum class Wanted { all, wrenches, accelerations };
    /// dv/dt and the flows at a state, whose driven bodies are first put in their places for its time.
    void evaluate(State& state, Rates& rates, Wanted wanted = Wanted::all) const {
        evaluate(state, rates, some_, wanted);
    }
    /// That of some rows alone, with the flows of what acts on them, if no force reaches from them to others; null: of
    /// all.
    void evaluate(State& state, Rates& rates, const RowRanges* some, Wanted wanted = Wanted::all) const {
        if (some || !few_)
            evaluate_many(state, rates, some, wanted);
        else if (wanted == Wanted::all)
            evaluate_few<Wanted::all>(state, rates);
        else if (wanted == Wanted::wrenches)
            evaluate_few<Wanted::wrenches>(state, rates);
        else
            evaluate_few<Wanted::accelerations>(state, rates);
        add_guidance(state, rates);
    }
    /// What a Guided adds; evaluate() does it itself.
    void add_guidance(const State& state, Rates& rates) const {
        if (!guidance_) return;
        const double passed = state.time - guidance_->since;
        for (const Guidance::Row& r : guidance_->rows) {
            rates.acceleration.linear[r.row] += r.linear + passed * r.growth;
            rates.acceleration.angular[r.row] += r.angular + passed * r.angular_growth;
        }
    }
    /// The first half of it: forces and torques in the place of accelerations, but gravity, and the flows of each.
    void add_up(State& state, Rates& rates, Wanted wanted = Wanted::all, const RowRanges* some = nullptr) const;
    /// The second half: accelerations from forces, and the flows of all together.
    void accelerate(const State& state, Rates& rates, Wanted wanted = Wanted::all,
                    const RowRanges* some = nullptr) const;
    /// What a kick gives in energy and momentum, on the accounts of the method, and whether all that it and a drift
    /// with it moved are numbers.
    struct Kicked {
        Flows gained;
        bool finite = true;
    };
    /// v += h a.
    Kicked kick(const Motion& acceleration, double h, State& state) const;
    /// Both, block by block while the rows are in the cache if no force looks at velocities. Then and in a large world
    /// the accelerations are left in `rates` only if they are to be kept.
    enum class Keep { accelerations, nothing };
    Kicked evaluate_and_kick(double h, State& state, Rates& rates, Keep keep) const;
    /// kick() and x += h v, but for bodies driven along curves.
    Kicked kick_and_drift(const Motion& acceleration, double kick_time, double drift_time, State& state) const;
    /// Whether all that moved are numbers.
    bool drift(double h, State& state) const;

    /// Whether the next two can be: the springs of a large network are all there is, between rows not far apart. What
    /// these pass once through memory for, the ones above do in several passes, and to the same bits.
    bool moves_in_waves(const State& state) const;
    /// What a wave brought: what its kicks gave, and whether all places and velocities are numbers after it.
    struct Wave {
        Flows first_gain, gain;
        bool finite;
    };
    /// evaluate_and_kick() and drift().
    Wave kick_then_drift(double h, State& state, Rates& rates) const;
    /// kick_and_drift(), and evaluate_and_kick() again, which keeps the accelerations.
    Wave drift_then_kick(double kick_time, double drift_time, State& state, Rates& rates) const;

    /// Whether no force reaches from any body to any other: then kicks and drifts may be of some rows, between which
    /// and the others nothing acts.
    bool may_leave_out() const { return attractions_.empty() && user_forces_.empty(); }

    /// Calls act(first, last) for the ranges of rows that are evaluated now: all, unless an Attention says which.
    template <class Act>
    void each_range(const State& state, const Act& act) const {
        some_ ? some_->within(0, state.size(), act) : act(0, state.size());
    }

    /// Whether all places and velocities are numbers, of some rows or of all.
    bool is_finite(const State& state, const RowRanges* some = nullptr) const;
    /// Puts the bodies driven along curves where they are at the state's time.
    void place_driven(State& state) const;
    /// Whether dv/dt or a power depends on velocity, so that a kick must look at it more than once.
    bool needs_velocity() const { return needs_velocity_; }
    /// Whether a force depends on velocity, or may: functions of the user's are told it. Not of quadratic drag alone,
    /// for which what a blow has just thrown may be too fast to look at once more in the same step.
    bool sees_velocity() const { return sees_velocity_; }
    /// Whether a force may turn velocities, as a magnetic one does: functions of the user's may.
    bool may_turn_velocities() const { return !fields_.empty() || !user_forces_.empty(); }
    /// Whether a force may turn a body without inertia: what keeps it as it is does work then.
    bool turns_points() const { return turns_points_; }
    /// Whether a function of the user's says where some body is.
    bool places() const { return !placed_.empty(); }
    /// Where a field was no finite number, of all evaluations from a time on.
    const std::optional<FieldDoubt>& field_doubt() const { return doubt_; }
    void forget_doubt_before(double time) {
        if (doubt_ && doubt_->time < time) doubt_.reset();
    }
    /// Whether there is a force that may turn a body; else no force looks at angles either.
    bool turns() const { return turns_; }
    /// Whether a force on any body, or on that in a row, may depend on where bodies are, how they move, or on time.
    bool varies() const { return varies_; }
    bool varies(std::size_t row) const { return varied_[row]; }
    /// Whether every body flies freely on a parabola: no force but gravity.
    bool is_free_flight() const;
    Vec2 gravity() const { return gravity_; }

    /// Potential energies [J].
    double gravity_potential(const State& state) const;
    double spring_potential(const State& state) const;
    double field_potential(const State& state) const;

    /// An upper bound at this state, node by node (docs/theory/stability.md).
    Stiffness stiffness(const State& state) const;
    /// One for every state, up to √2 above that in frequency; infinity where a turning arm or a quadratic drag has
    /// none. It costs nothing.
    Stiffness stiffness_at_most() const { return bound_; }

    // For the implicit method, which wants the springs' derivatives.
    Springs springs() const;
    const TorsionSprings& torsion_springs() const { return torsion_springs_; }
    const std::vector<double>& mass() const { return mass_; }
    const std::vector<double>& inertia() const { return inertia_; }
    const std::vector<double>& inverse_mass() const { return inverse_mass_; }
    const std::vector<double>& inverse_inertia() const { return inverse_inertia_; }

  private:
    friend class Attention;
    friend class Guided;
    void note_varied(const std::vector<Link>& links);
    void take_pair_forces(const Forces& forces, const Bodies& bodies, const std::optional<Periodic>& box);
    void evaluate_many(State& state, Rates& rates, const RowRanges* some, Wanted wanted) const;
    /// That of so few rows that calls from one part to the next would take longer than the forces: all in one place.
    template <Wanted wanted>
    void evaluate_few(State& state, Rates& rates) const;
    template <class Sum, class Work>
    void add_over(const RowRanges* some, std::size_t rows, Sum& total, const Work& work) const;
    /// Some consecutive rows, with the forces and torques, or the accelerations, of these alone. No torques: all are 0.
    struct Block {
        std::size_t first, last;
        Vec2* linear;
        double* angular;

        std::size_t size() const { return last - first; }
    };
    static Block block_of(Motion& motion, std::size_t first, std::size_t last) {
        return {first, last, motion.linear.data() + first, motion.angular.data() + first};
    }
    /// Springs between centres and soft discs: what a block of rows can be told alone.
    void write_forces_between(const State& state, const Block& load, Flows& flow,
                              SpringNetwork::Pass* pass = nullptr) const;
    void add_soft_discs(const State& state, const Block& load, Flows& flow) const;
    /// The forces that are no block's: all but those.
    void add_others(const State& state, Rates& rates, const RowRanges* some) const;
    void look_around(const State& state) const;
    /// Driven bodies in their places, neighbours known, rates with room, and no flows yet if they are wanted.
    void begin(State& state, Rates& rates, Wanted wanted) const;
    bool feels_nothing() const { return network_.empty() && soft_discs_.empty() && !others_; }
    void accelerate(const State& state, const Block& load, Flows& flow, Wanted wanted = Wanted::all) const;
    /// Angular accelerations from torques, with Σ I α and I α ω, and over what is held Σ τ and τ ω.
    struct Turning {
        double torque = 0, power = 0, held = 0, held_power = 0;
    };
    Turning turn(const State& state, const Block& load) const;
    void book(const AccelerationSums& sum, const Turning& turning, Flows& flow) const;
    void book_wrenches(const AccelerationSums& sum, const Turning& turning, Flows& flow) const;
    /// Whether all that it changed are numbers.
    bool kick(std::size_t first, std::size_t last, const Vec2* linear, std::span<const double> turning, double h,
              State& state, Flows& gained) const;
    /// Whether all that moved is numbers.
    static bool drift(std::size_t first, std::size_t last, double h, State& state);
    static bool is_finite(std::size_t first, std::size_t last, const State& state);
    RowArrays arrays(const State& state) const;
    Stiffness bound_stiffness(const std::vector<Link>& links) const;
    /// How often a spring counts at a body of its two.
    double share(Row self, Row other) const;

    int threads_ = 1;
    Vec2 gravity_{};
    std::vector<Kind> kind_;
    std::vector<double> given_mass_;      ///< as the user's forces see it
    std::vector<double> mass_, inertia_;  ///< 0 for what forces do not move
    std::vector<double> inverse_mass_, inverse_inertia_;
    struct PlacedRow {
        std::size_t row;
        std::function<Pose(double)> curve;
    };
    std::vector<PlacedRow> placed_;
    SpringNetwork network_;  ///< the springs between centres
    Springs springs_;        ///< the others
    TorsionSprings torsion_springs_;
    Drags drags_;
    Attractions attractions_;
    mutable std::vector<SoftDiscRows> soft_discs_;  ///< neighbours are looked for when they are wanted
    ConstantForces constant_forces_;
    Fields fields_;
    mutable std::optional<FieldDoubt> doubt_;  ///< nobody's result
    std::vector<UserForce> user_forces_;
    bool needs_velocity_ = false, sees_velocity_ = false, turns_ = false, turns_points_ = false, varies_ = false;
    std::size_t reach_ = 0;  ///< the farthest that two rows with a spring of the network are apart
    const RowRanges* some_ = nullptr;
    mutable const Guidance* guidance_ = nullptr;
    std::vector<bool> varied_;  ///< by row: a force that varies may act there
    bool few_ = false;          ///< rows
    bool others_ = false;       ///< forces beside gravity, the network's and soft discs'
    Stiffness bound_;
};

/// As long as it lasts, evaluates, kicks and drifts these rows alone; null: all.
class Attention {
  public:
    Attention(Dynamics& dynamics, const RowRanges* some) : dynamics_(dynamics) { dynamics.some_ = some; }
    Attention(const Attention&) = delete;
    Attention& operator=(const Attention&) = delete;
    ~Attention() { dynamics_.some_ = nullptr; }

  private:
    Dynamics& dynamics_;
};

/// As long as it lasts, all evaluations give these accelerations beside those of the forces: to bodies, and to no flow,
/// so that what they give is the method's.
class Guided {
  public:
    Guided(const Dynamics& dynamics, const Guidance& guidance) : dynamics_(dynamics) { dynamics.guidance_ = &guidance; }
    Guided(const Guided&) = delete;
    Guided& operator=(const Guided&) = delete;
    ~Guided() { dynamics_.guidance_ = nullptr; }

  private:
    const Dynamics& dynamics_;
};

}  // namespace carom
