#pragma once
// All that a world is: the one place that knows everything.

#include <carom/analysis.hpp>
#include <carom/world.hpp>

#include "collision/queries.hpp"
#include "collision/walls.hpp"
#include "forces/dynamics.hpp"
#include "integrators/propose.hpp"
#include "math/compensated.hpp"
#include "solvers/events/advance.hpp"
#include "solvers/impulse.hpp"
#include "solvers/mechanism.hpp"
#include "solvers/soft_step.hpp"
#include "world/together.hpp"

namespace carom {

struct World::State {
    Settings settings;
    Bodies bodies;
    carom::State motion;
    Forces forces;
    Numbered<Rectangle> rectangles;
    Numbered<HalfPlane> half_planes;
    Numbered<Stadium> stadiums;
    std::optional<Periodic> periodic;

    CompensatedSum time;
    std::uint64_t steps = 0;
    Contacts contacts;
    SoftContacts soft_contacts;
    Mechanisms mechanisms;
    std::uint32_t joints_given = 0;  ///< numbers so far
    std::vector<BodyId> let_go;      ///< by joints that broke, beside an exact gas
    EventGas gas;
    Memory memory;
    std::vector<ShapePair> touching, sensed;  ///< at the end of the last step, sorted
    std::vector<ShapePair> touching_at_rest;  ///< those of bodies that sleep, which are not among the others
    StepEvents events;
    StageProfile profile;

    /// Whether forces and curves of the user's are being asked. A copy of the world is not at it.
    struct AtWork {
        bool now = false;
        AtWork() = default;
        AtWork(const AtWork&) {}
        AtWork& operator=(const AtWork&) { return *this; }
    } at_work;
    class Working {
      public:
        explicit Working(AtWork& at_work) : at_work_(at_work), before_(at_work.now) { at_work.now = true; }
        Working(const Working&) = delete;
        Working& operator=(const Working&) = delete;
        ~Working() { at_work_.now = before_; }

      private:
        AtWork& at_work_;
        bool before_;
    };

    std::vector<BodyId> put;     ///< since anything was settled: what nothing moves, and may lie among sleepers now
    bool holds_removed = false;  ///< forces may hold on to bodies that are gone, or be removed themselves

    // Derived from the above whenever something was edited.
    bool edited = true;  ///< the state, or
    enum class Changed : std::uint8_t { nothing, actions, all };
    Changed changed = Changed::all;  ///< what there is, too: forces and joints, or anything
    Dynamics dynamics;
    Walls walls;
    std::vector<Piece> pieces;     ///< of SoftStep; under other solvers made when somebody asks
    std::size_t fitting_rows = 0;  ///< of so many bodies they are as these are now
    Places places;                 ///< of the pieces, made to fit when somebody asks
    Together together;             ///< of an exact gas and others
    bool any_sensor = false;
    Sweep sensor_sweep;                        ///< its storage
    std::optional<std::size_t> beyond_solver;  ///< the row of a body that would have to collide and cannot
    std::vector<bool> may_rest;                ///< by row: nothing acts on it that may change
    /// What the world had, and what was put in or taken out by edits since.
    struct Given {
        double energy = 0, potential = 0;
        Momentum momentum;
    };
    Given given;
    Given before_edit;  ///< what the world had before the edits since the last step

    /// An Error if a step is at work: who is asked in it for a force may look at the world, and no more.
    void check_idle() const;
    /// Call when the motion is changed from outside: what methods remember of it does not hold any more.
    void disturb();
    /// Call before every such change whose energy is booked as given: it is no residual.
    void edit();
    /// Call before every change of what there is: forces and joints, with who they act on stirred, or
    void change();
    /// bodies from this row on, or
    void change_bodies(std::size_t first);
    /// walls, settings and curves, which wakes all that sleep.
    void change_for_all();
    /// Wakes a body and whom it rests with, or carries.
    void stir(BodyId id);
    /// Wakes those whom joints hold on to it.
    void stir_joined(BodyId id);
    /// Call when a body was put somewhere or is another one now: if nothing moves it,
    void note_put(BodyId id);
    /// it wakes those whom it touches, when all is where it belongs.
    void stir_touched();
    bool follows_curve(BodyId id);
    /// An Error if it does: what `who` would change comes from the curve.
    void check_off_curve(BodyId id, const char* who);
    /// Has what it is to be move as it does on its curve, to the last bit; an Error if that is another motion.
    void keep_on_curve(BodyId id, Body& made);
    /// An Error if the body has a joint that would not hold it as this one: no dynamic one, or one that does not turn.
    void check_joints(BodyId id, const Body& made);
    /// An Error if the joint would hold a body still that does not turn; `point`: as if that one had no inertia.
    void check_turning(const Joint&, std::optional<BodyId> point = {}) const;
    /// The points of a body that forces and joints hold on to, as its frame is put elsewhere in it.
    void move_anchors(BodyId id, Vec2 by);
    /// Gives a body an impulse at its centre and an angular one, by the user.
    void push(std::size_t row, Vec2 impulse, double turn);

    // Of forces and walls.
    template <class T>
    Numbered<T>& list();
    /// Call before a force is added, changed or removed: wakes those on whom it acts.
    template <class Force>
    void change_force(const Force&);
    template <class Force>
    auto take(Force&&);
    template <class Walls>
    WallId<Walls> take_walls(const Walls&);
    template <class T>
    std::optional<std::size_t> find(std::uint32_t number);
    template <class T>
    std::uint32_t number_at(std::size_t place);
    /// Where one of a list is; an Error if it is gone.
    template <class T>
    std::size_t place_of(std::uint32_t number, const char* id);
    /// What remembers walls by number follows, where some are put before others or taken out.
    void renumber_walls(std::size_t first, std::size_t removed, std::size_t added);
    /// The forces on the bodies that there are.
    const Forces& current_forces();
    /// The joints of the bodies that there are.
    const std::vector<Joint>& current_joints();
    /// The place of a joint among all; an Error if it is gone.
    std::size_t place_of(JointId id);
    /// Takes out joints that bore too much.
    void break_joints();
    /// Makes the pieces of bodies that changed anew.
    void fit_pieces();
    /// The pieces of the bodies that there are, where these are.
    PlacedPieces placed_pieces();
    /// The walls that there are, for questions that seek them.
    Walls sought_walls(const Sought&) const;
    /// Where the bodies of a contact are pressed together, those that there are.
    void add_points(const SoftContact&, std::vector<ContactPoint>&) const;
    std::vector<ContactPoint> contact_points() const;
    std::vector<ContactPoint> contact_points(BodyId of);
    /// Finds what happened in a step, under SoftStep by its contacts.
    void note_events();
    /// Makes forces by row and walls from what the user gave.
    void derive();
    /// Makes what is derived fit again.
    void settle();
    /// The same, and books what was edited and wakes whom it touches: before a step, or before all is saved. Who asks
    /// between two edits does not, so that no bit depends on questions.
    void close_edits();
    /// What the solver 'events' works on, and an Error that names what it cannot do.
    GasScene gas_scene();
    void check_solver();
    void check_gas_alone();
    /// Into how many parts the solver cuts every step.
    int least_parts() const;
    /// The longest step [s] whose parts are stable; infinity if no step is too long.
    double stable_step(const Stiffness&) const;
    /// Into how many equal parts each of those must be cut to be stable, for all forces as they are now; an Error that
    /// says how long a step may be if that is asked for.
    int parts(double dt) const;
    /// Whether bodies touch by SoftStep.
    bool is_soft() const { return std::holds_alternative<SoftStep>(settings.solver) || !together.empty(); }
    /// A step of an exact gas and of the others beside it.
    void step_together(double dt, int cuts);
    void take_turns(double h, int cuts);
    /// What is left of such a substep.
    struct Turn {
        double substep = 0;  ///< all of it [s]
        double left = 0;     ///< to the others [s]
        double ahead = 0;    ///< by so much the gas is behind them [s]
    };
    Turn take_turn(const Turn& turn, int cuts, bool may_stop);
    void move_company(double h, int cuts);
    void move_company_again(double h, int cuts);
    /// Moves the bodies by a step of dt [s].
    void move(double dt);
    void finish_step(double dt);
    /// What snapshots keep of a world, as references.
    template <class S>
    static auto stored(S& world);
    /// The ledgers, for the forces as they are derived.
    Energy energy() const;
    MomentumBalance momentum_balance() const;
    /// What of them bodies and forces have now.
    Energy stored_energy() const;
    Momentum momentum() const;
    Given has() const;
    /// What was given until now, by edits since the last step too.
    Given given_so_far() const;
};

}  // namespace carom
