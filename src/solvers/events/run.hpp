#pragma once
// The course of the exact gas through one step of the world.

#include <array>

#include "solvers/events/edge.hpp"
#include "solvers/events/gas.hpp"
#include "solvers/events/meet.hpp"
#include "solvers/impact.hpp"

namespace carom {

/// What a disc meets next.
struct GasMeeting {
    double time = 0;
    std::uint32_t partner = no_slot;
};

template <class Queue>
class GasRun {
  public:
    /// Of a part of a gas. Where that is a block, its edge says what is beyond it.
    GasRun(const GasScene& scene, const GasData& gas, GasPart<Queue>& part, GasBooks& books, GasEdge* edge = nullptr);
    /// All events up to a time of the gas's clock.
    void run(double until);
    /// The company goes on ways that nobody foresaw: all look whom they hit now.
    void meet_company();
    /// Blows of its own kink its ways now.
    void kink_company();
    /// The hit before which the company was stopped, which is now where its own solver has it.
    void make_hit(State& state);
    /// The events of all discs, from nothing.
    void foresee_all();
    /// The state at a time of the gas's clock.
    void show(State& state, double now);

  private:
    void watch_for_jam(double due);
    void watch_for_press(Slot i, const GasObstacle& o, double flown);
    void watch_for_wedge(Slot i, const GasObstacle& o, double flown);
    [[noreturn]] void end_pressed(const GasObstacle& o, const char* how) const;
    void fetch_ahead();
    Slot struck_by(Slot i) const;

    // Where discs are.
    void move(Slot i, double time);
    void book_fall(Slot i, double from, double to);

    // What will be.
    double radius(Slot i) const { return discs_.radius[i & mask_]; }
    double inverse_mass(Slot i) const { return discs_.inverse_mass[i & mask_]; }
    void foresee(Slot i);
    void settle(Slot i, const GasMeeting& next);
    void note(Slot i);
    struct Exit {
        double time;
        int x, y;
    };
    void look_around(Slot i, GasMeeting& next) const;
    void look_ahead(Slot i, const Exit& exit, GasMeeting& next) const;
    double time_to_meet(Slot i, Slot j, Vec2 offset) const;
    template <class CellOf, std::size_t... which>
    void look_into(CellOf cell_of, std::index_sequence<which...>, Slot i, GasMeeting& next) const;
    void look_at(GasOthers& others, Slot i, GasMeeting& next) const;
    void look_for_obstacles(Slot i, GasMeeting& next) const;
    GasFlight flight(Slot i, const GasObstacle& o) const;
    GasFlight flight(Slot i, const GasNear& near) const;
    GasFlight flight(Slot i, const GasMover& mover, double time) const;
    void look_for_movers(Slot i, GasMeeting& next) const;
    void take_if_sooner(double time, std::uint32_t partner, GasMeeting& next) const;
    Exit exit_of(const GasDisc& d) const;

    // What happens.
    void queue_all();
    bool foretells(Slot i);
    std::uint64_t random_seed(Slot i) const;
    void happen(Slot i);
    void leave_cell(Slot i);
    void hit_disc(Slot i, Slot j);
    void hit_obstacle(Slot i, std::uint32_t k);
    bool hit_mover(Slot i, std::uint32_t part);
    void look_for_company();
    void look_for_company(Slot i);
    void look_with_all();
    void list_near();
    void note_near(Slot i);
    double as_foreseen_now(double due, double again) const;
    struct Meeting {
        double time;
        Vec2 offset;  ///< from the cell of the first to that of the image it meets
    };
    Meeting as_foreseen_now(Slot i, Slot j) const;
    std::int32_t open_books(Slot i);
    std::int32_t distance(Slot i) const;
    bool bounce(Slot i, Slot j, Vec2 offset);
    bool bounce_with_all(Slot i, Slot j, Vec2 d);
    struct Surfaces {
        double restitution, friction;
        bool warms = false, made_elastic = false;
    };
    Surfaces meeting(const Surfaces& a, const Surfaces& b, double approach, Slot i, Slot j, double weight = 0);
    double weight_in_bounce(Slot i, Vec2 gravity, Vec2 normal, double approach) const;
    bool collapses(Slot i, double approach);
    double beyond_rounding(Slot i) const;
    void turn_up(Slot i);
    Party party(Slot i);
    double least_rebound(Slot i, Vec2 gravity, Vec2 normal) const;
    void lift(Slot i, const GasObstacle& o, Vec2 normal, double approach, double least);
    void warm_up(Slot i, const GasObstacle& wall, Vec2 normal);

    const GasScene& scene_;
    const GasData& gas_;
    GasPart<Queue>& part_;
    GasDiscs& discs_;
    GasBooks* const own_;
    GasBooks* books_;  ///< of the event that happens: its own, or another block's
    GasEdge* const edge_;
    const Vec2 g_;
    const bool falls_;
    const bool alone_;  ///< there are no obstacles
    /// Distances at a hit are multiplied by this: of a square that is 1 or another power of two but for rounding, more
    /// than half of the roundings go one way, and discs of that diameter gained 2e-17 of their energy at a hit.
    const double scale_;
    const Slot mask_;  ///< of the number of a disc in an array that has one entry if all are alike
    const Slot none_;  ///< one beyond the last: a disc that nobody meets
    const bool fetches_;
    const MeetKernel& kernel_;
    const GasView view_;
    double now_ = 0;           ///< when what happens was foreseen to
    double stuck_since_ = -1;  ///< since when no time passes, and how many events that were
    std::uint64_t stuck_ = 0;
    int pressed_ = 0;  ///< blows of what moves on discs that are far too fast and have no way to fly,
    int wedged_ = 0;   ///< and in steps on those that have none at all
    std::array<Vec2, cells_around> offset_;  ///< of the cells around
};

}  // namespace carom
