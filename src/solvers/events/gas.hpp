#pragma once
// The exact gas: discs that fly freely from event to event, each with a clock of its own.

#include <carom/archive.hpp>
#include <carom/solver.hpp>

#include "solvers/events/grid.hpp"
#include "solvers/events/obstacles.hpp"
#include "solvers/events/queue.hpp"

namespace carom {

/// An obstacle that discs in a cell can strike; of a periodic box's or a plane's cells that which is so many turns on.
struct GasNear {
    std::uint32_t obstacle = 0;
    std::int32_t turns_x = 0, turns_y = 0;
};

/// How a disc turns.
struct GasSpin {
    double angle = 0, velocity = 0, clock = 0;
};

/// What the rule against inelastic collapse remembers of a disc.
struct GasPast {
    double last_hit = 0;
    std::uint32_t short_flights = 0;  ///< in a row
};

/// All that the method keeps from step to step: it goes on from here, not from the world's state, so that the course
/// of the gas does not depend on the steps at whose ends somebody looks. Times are by the gas's own clock, which is set
/// back now and then to stay precise.
struct GasData {
    bool fits = false;  ///< the world is as the last step left it

    GasGrid grid;
    double widest = 0;          ///< diameter [m]
    bool alike = true;          ///< all of one radius and mass
    bool plain = true;          ///< all elastic and smooth
    std::vector<GasDisc> disc;  ///< and one more at the end, for empty cells
    std::vector<GasEvent> event;
    std::vector<double> radius, inverse_mass;  ///< one number if all are alike
    std::vector<GasSpin> spin;                 ///< none if nothing turns
    std::vector<GasPast> past;                 ///< none if all are elastic

    std::vector<GasObstacle> obstacle;
    std::vector<std::uint32_t> everywhere;  ///< obstacles that all discs look at
    std::vector<GasNear> near;              ///< the others, by cells of storage
    std::vector<std::uint32_t> first_near;  ///< of each cell; none if there are none

    double now = 0, now_low = 0;  ///< the clock in two parts
    double set_back = 1;          ///< by how much the clock goes back when it has gone twice as far [s]

    std::uint64_t disc_hits = 0, obstacle_hits = 0;
    std::uint64_t made_elastic = 0;  ///< by the rule against inelastic collapse
    double virial = 0;               ///< Σ distance of the centres × impulse, over the hits of discs [J s]
    double wall_impulse = 0;         ///< Σ impulse across the wall, over the hits of walls [N s]
    std::uint64_t drawn = 0;         ///< random numbers
};
auto members(Maybe_const<GasData> auto& g) {
    auto& [fits, grid, widest, alike, plain, disc, event, radius, inverse_mass, spin, past, obstacle, everywhere, near,
           first_near, now, now_low, set_back, disc_hits, obstacle_hits, made_elastic, virial, wall_impulse, drawn] = g;
    return std::tie(fits, grid, widest, alike, plain, disc, event, radius, inverse_mass, spin, past, obstacle,
                    everywhere, near, first_near, now, now_low, set_back, disc_hits, obstacle_hits, made_elastic,
                    virial, wall_impulse, drawn);
}

/// The gas with a queue of its events. The queue, and the lists of the cells, follow from the data.
template <class Queue>
struct GasOf {
    GasData data;
    std::vector<Slot> first_in_cell;
    Queue queue;
    bool queued = false;  ///< the queue and the lists are those of the data
};
using EventGas = GasOf<Calendar>;

/// What a gas is made of.
struct GasScene {
    const Events& options;
    const Walls& walls;
    const Bodies& bodies;
    const std::vector<Piece>& pieces;
    Vec2 gravity{};
};

/// An Error that names what the method cannot do: of the bodies and the walls as they are now.
void check_gas(const GasScene& scene, const State& state);

/// Moves the state by h [s], from event to event.
template <class Queue>
void advance(const GasScene& scene, State& state, double h, GasOf<Queue>& gas);

/// Makes the data anew from a state. Of its own clock this is the time 0.
void fill_gas(const GasScene& scene, const State& state, GasData& gas);

}  // namespace carom
