#pragma once
// Bodies that are moved in steps, in the company of the exact gas: through a step it sees each on a parabola, which
// every hit kinks.

#include <limits>
#include <vector>

#include "forces/dynamics.hpp"
#include "solvers/events/obstacles.hpp"
#include "solvers/impact.hpp"
#include "solvers/mechanism.hpp"

namespace carom {

/// One of them, through a step of its own solver.
struct GasMover {
    static constexpr std::uint32_t none = 0xffffffff;

    std::uint32_t row = 0;
    std::uint32_t mechanism = none, part = 0;  ///< that it is a part of, and which
    double mass = 0, inertia = 0, inverse_mass = 0, inverse_inertia = 0;
    double reach = 0;  ///< of its outline from its centre, at most [m]
    Vec2 half{};       ///< the same along either axis of its own frame [m]

    double clock = 0;  ///< of what follows, on the clock of the gas: the beginning of the step, or the last hit [s]
    Vec2 x{}, v{}, a{};
    double angle = 0, w = 0, alpha = 0;
    double cosine = 1, sine = 0;  ///< of the angle
    Vec2 planned{};               ///< velocity where the step was stopped, as the gas saw it
    double planned_spin = 0;
    bool hit = false;  ///< in this step
    Vec2 kick{};       ///< what hits gave its velocity since discs near it were listed [m/s]
    Wrench given{};    ///< by the gas in this step
    Vec2 gained{};     ///< of its velocity, by hits of this step [m/s], [rad/s]
    double gained_spin = 0;
    Vec2 pushed{};  ///< how far they have moved it at the end of its step [m], [rad]
    double pushed_turn = 0;
    std::uint32_t kinks = 0;                        ///< that its own blows are yet to make in this step
    std::uint32_t first_touch = 0, last_touch = 0;  ///< of the company's

    bool turns() const { return w != 0 || alpha != 0; }
    /// It was not hit yet.
    void begin_hits() { hit = false, given = {}, gained = pushed = {}, gained_spin = pushed_turn = 0; }
    Vec2 velocity_at(Vec2 lever) const { return v + cross(w, lever); }
    /// Goes on to a time.
    void move(double time);
    /// Has this angle now.
    void face(double angle);
};

/// Where a body may touch another, or a wall, in a step.
struct GasTouch {
    static constexpr double give = 1e-4;  ///< by so much of the body's reach a contact may give way to hits

    std::uint32_t mover = GasMover::none, other = GasMover::none;
    Vec2 normal{};  ///< to the other
    Vec2 lever{}, lever_of_other{};
    double gap = 0;  ///< the narrowest of the step [m]
    double restitution = 0;
    bool at_wall = false;
    std::uint32_t number = 0;  ///< the same for both of two that touch
};

/// What a blow of its own gains a body, so long after the step began [s].
struct GasKink {
    std::uint32_t mover;
    double time;
    Vec2 v;
    double w;
};

/// A step of the company without the gas.
struct GasWays {
    double h = 0;        ///< how long it takes [s]
    double ahead = 0;    ///< by so much it begins later than that of the gas [s]
    double substep = 0;  ///< of which it is a part [s]
    double no_stop = 0;  ///< nothing ends it early in so long before its end [s]
    std::vector<GasKink> kinks{};
    std::vector<GasTouch> touches{};
};

/// A disc as it is seen from a body, in the frame of that, at an instant: as if the body did not turn on.
GasFlight seen_from(const GasMover& mover, const GasFlight& flight);
/// The acceleration of a disc as it is seen from a body that turns on, along the axes of the world.
Vec2 acceleration_seen_from(const GasMover& mover, const GasFlight& flight);

/// Whether a disc can strike a body in the next `most` [s], even one that becomes faster by so much; a quick look.
bool may_strike(const GasMover& mover, const GasFlight& flight, double most, double faster = 0);

/// How long it takes until a disc strikes a part of the outline of a body, if that is in the next `most` [s], or
/// infinity. The flight is in the world's frame from the body's centre, as both are `after` seconds from its clock on.
double time_to(const GasMover& mover, double after, const GasObstacle& obstacle, const GasFlight& flight, double most);

/// How an impulse of 1 N s at a point changes the velocities of a body.
struct GasYield {
    std::uint32_t mover;
    Vec2 v{};
    double w = 0;
};

/// All of them.
class GasCompany {
  public:
    GasCompany() = default;
    GasCompany(const std::vector<bool>& stepped, const Bodies& bodies, const std::vector<Piece>& pieces);

    bool empty() const { return mover.empty(); }
    /// Their ways from one state to the other,
    void set_out(const State& start, const State& end, const Mechanisms& mechanisms, GasWays ways);
    /// and by which clock.
    void set_clock(double from, double end);
    void set_back(double by);
    bool has_kinks() const { return next_ < ways_.kinks.size(); }
    /// When the next kink comes.
    double smooth_until() const { return ways_.kinks[next_].time; }
    /// Makes the kinks that are due.
    void kink();
    /// How long their step took, to the end or until it was stopped [s].
    double gone() const { return until - begin_; }
    /// To those that were hit, and are where and as fast as their own solver has moved them for so long [s],
    /// adds what the gas gave them, and books it. So a hit finds them now.
    void arrive(const Dynamics& dynamics, State& state, double moved);
    /// They are as fast as the gas saw them, who move otherwise as overlaps are undone.
    void be_as_planned();
    /// The step is over.
    void rest();
    /// Whose row it is; none if nobody's.
    std::uint32_t of_row(std::uint32_t row) const { return row < of_row_.size() ? of_row_[row] : GasMover::none; }
    /// The same of all rows; none if there is no company.
    const std::vector<std::uint32_t>& of_rows() const { return of_row_; }
    /// Two that touch: the impulses of an impact, at the instant that is the disc's, and their books. The normal is
    /// from the body to the disc; afterwards the disc flies off `restitution` times as fast as it came, and at least so
    /// fast. False if that would send bodies on other ways than their own solver thought, for a blow of their own is
    /// yet to come or they would be pressed into what they touch: then nothing has happened, and the step is to end
    /// here.
    struct Impact {
        std::uint32_t struck;
        double time;
        Vec2 normal;
        double restitution, least, friction;
    };
    bool strike(const Impact& impact, const Party& disc, Flows& account);
    /// The step ends, before a disc strikes what is in a part of the outline. Its solver has to say where all are now,
    /// and then that hit is made.
    void stop(double time, Slot disc, std::uint32_t part) {
        stopped = true, until = time, striker = disc, about_to_hit = part;
    }
    /// How an impulse on a body, now, changes its velocities, and those of all that joints hold to it. The first is the
    /// body itself. All of them are moved on to this time.
    void find_yields(std::uint32_t struck, double time, Vec2 lever, Vec2 direction, std::vector<GasYield>& yields);
    /// Holds the limits that are reached, and against which so many times the impulse of the yields that were found
    /// last drives the body's joints. Returns whether there are any, for which yields are to be found anew.
    bool hold_stops(std::uint32_t struck, double push);
    /// They give way again.
    void let_stops_go(std::uint32_t struck);
    /// Holds what bodies lean on against so many times the impulse of the yields that were found last, until it is let
    /// go: where it does not bounce, or would by a hair. Returns whether there is any.
    bool hold_touches(double time, double push, const std::vector<GasYield>& yields);
    /// What they are where that holds, by impulses along the normals of those touches [N s] that are added to these.
    void keep_touches(std::vector<GasYield>& yields, std::vector<double>& held) const;
    /// Books what they gave, who are not of the company; `rest` is what they all gave.
    void book_held(const std::vector<double>& held, bool others_hold, Wrench rest, Flows& account) const;
    void let_touches_go() { held_.clear(); }

    std::vector<GasMover> mover;
    std::vector<std::uint32_t> outline;  ///< its obstacles, body by body
    /// Discs that can strike one of them in what is left of the step while none has been kicked by more than `faster`.
    std::vector<Slot> near;
    std::vector<bool> is_near;                               ///< by slot
    double faster = 0;                                       ///< [m/s]
    double until = std::numeric_limits<double>::infinity();  ///< the end of the step, on the clock of the gas [s]
    bool stopped = false;                                    ///< before that was planned,
    Slot striker = no_slot;                                  ///< by this disc,
    std::uint32_t about_to_hit = 0;                          ///< which is about to strike this part of the outline

  private:
    void link(const Mechanisms& mechanisms, const State& state);
    void list_touches();
    bool leads_astray(double time, double push, const std::vector<GasYield>& yields) const;
    /// How fast the two of a touch come nearer, and so fast that contacts give way to it in a substep [m/s].
    double closing_now(const GasTouch& touch) const;
    double slow_for(const GasMover& m) const { return GasTouch::give * m.reach / ways_.substep; }
    bool is_pressed(const GasTouch& touch, double by) const;
    const GasTouch* most_pressed(double push, const std::vector<GasYield>& yields) const;

    const Mechanisms* mechanisms_ = nullptr;  ///< during a step
    std::vector<Mechanism> linked_;           ///< copies, with rigid rows alone but in an impact
    std::vector<std::uint32_t> of_row_;
    GasWays ways_;          ///< in this step, its kinks by the clock of the gas
    std::size_t next_ = 0;  ///< of the kinks
    double begin_ = 0;      ///< of the company's step, by the clock of the gas [s]
    /// A touch that holds in a hit, and what its impulse of 1 N s does where those before it hold.
    struct HeldTouch {
        GasTouch touch;
        std::vector<GasYield> yields;
        std::vector<double> by_others;  ///< their impulses meanwhile [N s]
        double ease;                    ///< 0 if the others hold it already
    };
    std::vector<HeldTouch> held_;
};

}  // namespace carom
