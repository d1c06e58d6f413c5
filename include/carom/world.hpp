#pragma once
#include <carom/archive.hpp>
#include <carom/body.hpp>
#include <carom/error.hpp>
#include <carom/event.hpp>
#include <carom/force.hpp>
#include <carom/integrator.hpp>
#include <carom/joint.hpp>
#include <carom/mixing.hpp>
#include <carom/query.hpp>
#include <carom/solver.hpp>
#include <carom/wall.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>

namespace carom {

struct Settings {
    Vec2 gravity{};
    Integrator integrator = Verlet{};
    Solver solver = Impulse{};
    LongStep long_step = LongStep::substep;
    Mixing restitution_mixing = Mixing::minimum;
    Mixing friction_mixing = Mixing::geometric_mean;
    int threads = 1;
};
constexpr std::string_view describe(const Settings*) { return "What holds for the world as a whole."; }
template <std::same_as<Settings> T>
constexpr auto fields(const T*) {
    return std::tuple{field("gravity", &T::gravity, "m/s²", any, "acceleration of every body"),
                      field("integrator", &T::integrator, "method that moves the bodies under the forces"),
                      field("solver", &T::solver,
                            "method that makes bodies bounce; a scene that names none has softstep if there are "
                            "joints, or shapes that meet"),
                      field("long_step", &T::long_step,
                            "what happens when a step is too long for springs, drag and soft discs to be stable"),
                      field("restitution_mixing", &T::restitution_mixing,
                            "how the restitution of a contact follows from those of the two"),
                      field("friction_mixing", &T::friction_mixing,
                            "how Coulomb's coefficient of a contact follows from those of the two"),
                      field("threads", &T::threads, "", Range{1, 1024, false, "a whole number from 1 to 1024"},
                            "number of threads; the result does not depend on it")};
}

/// All energy [J] and where it went. Heat and work are summed since the start of the world.
struct Energy {
    double kinetic = 0;     ///< translation, ½ m v²
    double rotational = 0;  ///< ½ I ω²
    double gravity = 0;     ///< −m g·x
    double spring = 0;      ///< springs and torsion springs
    double field = 0;       ///< attractions, constant forces, force fields with a potential
    struct Heat {
        double damping = 0;  ///< in springs
        double drag = 0;
        double impact = 0;  ///< inelastic
        double friction = 0;
        double joint_damping = 0;   ///< in the springs of joints
        double joint_friction = 0;  ///< of brakes and dry friction in joints
        double limit = 0;           ///< of joints that run against their limits
        double bath = 0;            ///< given to thermal walls; negative if they gave more
        double total() const {
            return damping + drag + impact + friction + joint_damping + joint_friction + limit + bath;
        }
    } heat;
    struct Work {
        double driven = 0;      ///< by driven bodies on the others
        double wind = 0;        ///< by a medium that moves
        double user = 0;        ///< by forces without a potential
        double motor = 0;       ///< by the motors of joints
        double overlap = 0;     ///< by pushing overlapping bodies apart
        double correction = 0;  ///< by closing joints that gape, against gravity and joints' springs
        double total() const { return driven + wind + user + motor + overlap + correction; }
    } work;
    double initial_total = 0;  ///< total of the bodies, forces and speeds as they were given
    /// What the numerical method created (+) or lost (−): how far the work of the forces, as the method sums it up, is
    /// from the change of their potentials and of the kinetic energy. No difference of total energies.
    double residual = 0;

    double potential() const { return gravity + spring + field; }
    double total() const { return kinetic + rotational + potential(); }
    /// What no account explains: rounding, or the ledger is wrong.
    double unaccounted() const { return total() - initial_total - (work.total() - heat.total() + residual); }
};

/// Momentum [kg m/s] and angular momentum about the origin [kg m²/s].
struct Momentum {
    Vec2 linear{};
    double angular = 0;
};
/// The momentum of the dynamic bodies and who gave it, since the start of the world.
struct MomentumBalance {
    Momentum total;
    Momentum initial;  ///< of the bodies as they were given
    Momentum gravity;
    Momentum walls;     ///< their impacts, and the carrying of what rests on them
    Momentum held;      ///< fixed and driven bodies: springs to them, impacts on them
    Momentum medium;    ///< drag and wind; damping on the whole relative velocity, which turns a pair
    Momentum field;     ///< constant forces, force fields with a potential
    Momentum user;      ///< forces without a potential
    Momentum residual;  ///< of the numerical method; across a periodic box there is no angular momentum to keep

    /// What no account explains: rounding, or the ledger is wrong.
    Momentum unaccounted() const;
};

/// Wall-clock time [s] that steps spent on one stage of their work.
struct StageTime {
    std::string_view stage;
    double seconds;
};

/// Bodies, forces and walls, and the time. A world is a value: a copy is a snapshot that lives on its own.
/// Different worlds may be used by different threads at once; one world by one at a time, const members included, which
/// put in order what was edited. An id of an unrelated world is an error only if there is none like it here.
class World {
    enum class Defaults;

  public:
    explicit World(const Settings& settings = {});
    /// `World({})`. Without this one {} could mean Settings or another World, and would not compile.
    explicit World(Defaults) : World() {}
    World(const World& other);
    /// Takes everything from the other world, which can then only be assigned to or destroyed.
    World(World&& other) noexcept;
    World& operator=(const World& other);
    World& operator=(World&& other);  ///< likewise
    ~World();

    // Editing. Everything is checked here: a value outside its field's range is an Error, after which the world is as
    // it was. Energy and momentum that an edit brings in or takes out are booked as given: initial_total, initial.
    BodyId add(const Body& body);
    /// Removes a body and all forces and joints on it.
    void remove(BodyId id);
    /// Changes a body to what add() would make of this: `Body b = world.body(id); b.friction = 1; world.set(id, b);`.
    /// Its id, row, joints and forces stay; if the centre of mass of its shapes moves, they stay at the same points of
    /// the shapes. Wakes it and the bodies that rest on it.
    /// - body() returns the moment of inertia as a given value: reset it to have the one of a new mass or shape.
    /// - If the shapes have a density, the mass follows from it: another mass than the body had is an Error.
    /// - A body that is no longer driven loses its curve. One that is driven along a curve stays on it: another
    ///   position or velocity is an Error.
    void set(BodyId id, const Body& body);

    // Forces act until they, or a body that they name, are removed. Adding, changing or removing one wakes the bodies
    // that it names, or all bodies if it acts on all.
    ForceId<Spring> add(const Spring& spring);
    ForceId<TorsionSpring> add(const TorsionSpring& spring);
    ForceId<Drag> add(const Drag& drag);
    ForceId<Attraction> add(const Attraction& attraction);
    ForceId<SoftDiscs> add(const SoftDiscs& discs);
    ForceId<ConstantForce> add(const ConstantForce& force);
    ForceId<ForceField> add(ForceField field);
    ForceId<UserForce> add(UserForce force);
    template <class Force>
    void remove(ForceId<Force> id);
    template <class Force>
    void set(ForceId<Force> id, const std::type_identity_t<Force>& force);

    // Walls. Adding, changing or removing walls wakes all bodies. Where walls are removed, those after them in the list
    // get new numbers in events; contacts with the removed ones end in the next step, under their old numbers.
    WallId<Rectangle> add(const Rectangle& walls);
    WallId<HalfPlane> add(const HalfPlane& wall);
    WallId<Stadium> add(const Stadium& walls);
    template <class Walls>
    void remove(WallId<Walls> id);
    template <class Walls>
    void set(WallId<Walls> id, const std::type_identity_t<Walls>& walls);
    /// At most one periodic box; walls and a periodic box exclude each other.
    void add(const Periodic& box);
    /// Adds a joint. What it leaves open, such as a length, follows from where its bodies are now; joint() returns all
    /// of it.
    JointId add(const Joint& joint);
    void remove(JointId id);
    /// Changes a joint, such as the speed of its motor or the place of a hand. If its anchors are unchanged, an `at`
    /// that is given puts both of them there.
    void set(JointId id, const Joint& joint);
    /// Moves a driven body along a curve: its pose as a smooth function of time. The velocity is computed from
    /// differences of the curve, good to 1e-8, however fast or slow the curve is, as far as its digits go; so the curve
    /// is called for times up to 2/1024 s before and after, also before 0 s, and for farther ones where it changes by
    /// hardly more than rounding in that time. An empty curve, {}, ends the present one: the body goes on with the
    /// velocity that it has.
    void drive(BodyId id, std::function<Pose(double time)> curve);
    /// Whether a curve moves the body.
    bool follows_curve(BodyId id) const;

    const Settings& settings() const;
    /// Changes methods, gravity and the like; time, bodies and forces stay.
    void configure(const Settings& settings);

    /// Advances the time by dt > 0 [s]: at most 1e300, and at least 1e-300 under SoftStep.
    void step(double dt);
    double time() const;
    std::uint64_t steps() const;
    /// Starts, from zero, or stops measuring how long the stages of steps take. It costs some 50 ns a stage.
    void measure_stages(bool on);
    /// What was measured; the last entry is all time outside of stages. Only SoftStep has stages.
    std::vector<StageTime> stage_times() const;
    /// Number of impacts between discs and with walls so far.
    std::uint64_t collisions() const;
    GasTally gas() const;
    /// Under the event-driven solver Events, whether a body is moved in time steps: it is dynamic, but no disc of the
    /// gas.
    bool in_steps(BodyId id) const;
    /// An Error if there is anything in the world that the solver cannot handle, naming it; step() throws the same.
    void check() const;

    /// What happened in the last step: contacts and impacts under SoftStep, sensors under every solver that lets bodies
    /// have shapes. Empty before the first step and after restore(). Valid until the next step.
    const StepEvents& events() const;
    /// Under SoftStep, where bodies were pressed together at the end of the last step, with the forces of its last
    /// substep; without those of bodies and shapes that are gone since, and empty after restore(). Bounces are not
    /// forces: events() has them.
    std::vector<ContactPoint> contacts() const;
    /// The contact points of one body, as a or as b. The first question after a step takes as long as all of them, and
    /// each further one no longer than those of its body.
    std::vector<ContactPoint> contacts(BodyId id) const;

    // Bodies, as rows of arrays. The order is that of ids(); removing a body moves the last one into its place.
    std::size_t size() const;
    std::span<const BodyId> ids() const;
    std::span<const Vec2> positions() const;
    std::span<const double> angles() const;
    std::span<const Vec2> velocities() const;
    std::span<const double> angular_velocities() const;
    std::span<const Kind> kinds() const;
    std::span<const double> masses() const;
    std::span<const double> moments_of_inertia() const;
    std::span<const double> radii() const;
    std::span<const std::vector<Shape>> shapes() const;

    // One body.
    bool contains(BodyId id) const;
    /// The body named so; an Error with the nearest name if there is none.
    BodyId find(std::string_view name) const;
    /// The origin of the body's frame [m], the frame of shapes() and anchors: its centre of mass, even if the shapes
    /// that it was given had another origin. Fixed and driven bodies, and shapes without an area, keep the origin they
    /// were given.
    Vec2 position(BodyId id) const;
    double angle(BodyId id) const;
    /// Position and angle: to_world(world.pose(id), point) is where a point of the body is, and to_body() the inverse.
    Pose pose(BodyId id) const;
    Vec2 velocity(BodyId id) const;
    double angular_velocity(BodyId id) const;
    /// Whether the body is at rest, with all that it touches, and SoftStep skips it. It wakes when, for it or for a
    /// body that it rests with,
    /// - a moving body touches it, or what bore it is gone;
    /// - it is changed (set, set_position, set_velocity, an impulse), or a force or joint on it is;
    /// - a fixed or driven body is put into it (add, set, set_position), deeper than bodies at rest overlap;
    /// - walls or settings change at all.
    /// A body on which forces act that may change, as springs do, never sleeps.
    bool asleep(BodyId id) const;
    /// Wakes the body and, in the next step, all that it rests with.
    void wake(BodyId id);
    /// The body as it is now; adding it to another world makes an equal one there.
    Body body(BodyId id) const;
    /// Moves a body, or gives it a velocity; an Error for a body that follows a curve, which determines both. Setting
    /// the velocity that it already has changes nothing and wakes nothing.
    void set_position(BodyId id, Vec2 position, double angle);
    void set_velocity(BodyId id, Vec2 velocity, double angular_velocity);
    /// Gives a dynamic body an impulse [N s] at a point of the world [m]. Its work and momentum are booked as the
    /// user's. Wakes the body, unless the impulse is 0. A body without a moment of inertia does not turn. Joints pass
    /// the impulse on in the next step; the energy that this costs is residual.
    void apply_impulse(BodyId id, Vec2 impulse, Vec2 point);
    /// The same for an angular impulse [N m s], counterclockwise.
    void apply_angular_impulse(BodyId id, double impulse);
    /// A position as it is inside the periodic box; the position itself if there is no box.
    Vec2 wrapped(Vec2 position) const;

    // Queries: what is where, under every solver. A body without shapes is a disc of its radius, or a point; in a
    // periodic box bodies are where positions() says. A `way` is a displacement. Wrong numbers, shapes and ids are
    // Errors. Walls are not bodies: overlap queries and sensors never find them; rays and moving shapes do if Sought
    // says so. Behind its edge a wall is solid without end, and a ray meets at most one: where it leaves the room that
    // all walls leave open.

    /// The first shape that a ray meets from an origin along a way [m]; of several met at once the one with the lowest
    /// row, walls last. A ray that begins inside a shape does not find that one, and passes through a chain from
    /// behind.
    std::optional<Hit> cast_ray(Vec2 origin, Vec2 way, const Sought& sought = {}) const;
    /// All shapes that a ray meets, in the order in which it meets them, each once.
    std::vector<Hit> cast_ray_through(Vec2 origin, Vec2 way, const Sought& sought = {}) const;
    /// The first shape that another one meets when it is moved along a way [m] without turning; at fraction 0 if it
    /// overlaps one already. A shape that it merely touches (to rounding) and does not move into is not met: it can
    /// slide along the floor that it stands on, from tile to tile, and rise from it.
    std::optional<Hit> cast_shape(const Geometry& shape, const Pose& from, Vec2 way, const Sought& sought = {}) const;
    /// The shapes that overlap or touch another one, an upright box, or a point, in the order of rows.
    std::vector<ShapeId> shapes_touching(const Geometry& shape, const Pose& at, const Sought& sought = {}) const;
    std::vector<ShapeId> shapes_in_box(Vec2 low, Vec2 high, const Sought& sought = {}) const;
    std::vector<ShapeId> shapes_at(Vec2 point, const Sought& sought = {}) const;
    /// The smallest upright box around all shapes of a body, sensors included [m]; a body that is a point is the box.
    Bounds bounds(BodyId id) const;
    /// Where two bodies are nearest; nothing if one of them has no shape that `sought` finds.
    std::optional<ClosestPoints> closest_points(BodyId a, BodyId b, const Sought& sought = {}) const;
    /// All pairs of shapes that would collide and overlap, and shapes inside walls, the deepest first: a scene had
    /// better not start with any. Round walls, and images in a periodic box, are not looked at.
    std::vector<Overlap> overlaps() const;

    // Joints, in the order in which they were added. They need the solver SoftStep, or Events, which uses it for bodies
    // in steps.
    std::span<const Joint> joints() const;
    std::span<const JointId> joint_ids() const;
    /// The joints that hold a body.
    std::vector<JointId> joints(BodyId id) const;
    /// Whether the joint still exists: it does not if it was removed or broke, or one of its bodies was removed.
    bool contains(JointId id) const;
    /// The joint named so; an Error with the nearest name if there is none.
    JointId find_joint(std::string_view name) const;
    Joint joint(JointId id) const;
    Reaction reaction(JointId id) const;
    Breach breach(JointId id) const;

    // One force, or one of the walls.
    template <class Force>
    bool contains(ForceId<Force> id) const;
    template <class Force>
    Force force(ForceId<Force> id) const;
    template <class Walls>
    bool contains(WallId<Walls> id) const;
    template <class Walls>
    Walls wall(WallId<Walls> id) const;

    // Forces and walls, for drawing and saving, in the order in which they were added.
    std::span<const Spring> springs() const;
    std::span<const TorsionSpring> torsion_springs() const;
    std::span<const Drag> drags() const;
    std::span<const Attraction> attractions() const;
    std::span<const SoftDiscs> soft_discs() const;
    std::span<const ConstantForce> constant_forces() const;
    std::span<const ForceField> fields() const;
    std::span<const UserForce> user_forces() const;
    std::span<const Rectangle> rectangles() const;
    std::span<const HalfPlane> half_planes() const;
    std::span<const Stadium> stadiums() const;
    std::optional<Periodic> periodic() const;
    /// The id of the force or of the walls at a place of one of these lists.
    template <class Force>
    ForceId<Force> force_id(std::size_t place) const;
    template <class Walls>
    WallId<Walls> wall_id(std::size_t place) const;

    /// The longest step [s] that is stable for springs, drag and soft discs as they are now, so that step() does not
    /// cut it; infinity if there are none, and under methods that are stable at any step or choose their own.
    double stable_step() const;

    /// All that stepping changes, bit by bit: bodies with their ids, motion, time, accounts and what the methods
    /// remember. Settings, forces, joints, walls and curves are not included, for functions cannot be saved; but for
    /// joints that may break. What was edited since the last step is booked, as by a step. The bytes have no checksum:
    /// add one where they may be damaged, as checkpoints (carom/output.hpp) do.
    void save(Saver& to) const;
    /// Takes over the state of a world that was made as this one was; it goes on with the same bits. Bytes that cannot
    /// be a state are an Error, after which this world is as it was; a damaged number goes unnoticed.
    /// Edits of settings, walls, forces, joints and curves that the saved world had since it was made have to be made
    /// here too, before restore(); so has set() with shapes that have another centre of mass, which moves the points
    /// where forces and joints act. Other bodies that were added, changed or removed, and joints that broke, are
    /// restored; but no forces and joints on bodies that were removed here: if the state has more of them, that is an
    /// Error.
    void restore(Loader& from);

  private:
    struct State;
    friend Energy energy(const World&);
    friend MomentumBalance momentum_balance(const World&);
    std::unique_ptr<State> state_;
};

/// Advances a world to `duration` seconds from now in steps of `step`; `observe(world)` is called after each one. To go
/// on with a world that was restored in the middle of such a run, give the number of steps `done` so far.
void run(World& world, double duration, double step, const std::function<void(const World&)>& observe = {},
         std::uint64_t done = 0);
/// How many steps that is; the last one may be shorter.
std::uint64_t steps_of(double duration, double step);

}  // namespace carom
