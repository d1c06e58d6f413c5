#pragma once
// The exact gas: discs that fly freely from event to event, each with a clock of its own.

#include <carom/archive.hpp>
#include <carom/solver.hpp>

#include "solvers/events/cells.hpp"
#include "solvers/events/company.hpp"
#include "solvers/events/obstacles.hpp"
#include "solvers/events/queue.hpp"

namespace carom {

/// An obstacle that discs in a cell can strike; of a periodic box's or a plane's cells that which is so many turns on.
struct GasNear {
    std::uint32_t obstacle = 0;
    std::int32_t turns_x = 0, turns_y = 0;
};

/// All that the method keeps from step to step: it goes on from here, not from the world's state, so that the course
/// of the gas does not depend on the steps at whose ends somebody looks. Times are by the gas's own clock, which is set
/// back now and then to stay precise.
struct GasData {
    bool fits = false;  ///< the world is as the last step left it

    GasGrid grid;
    double widest = 0;  ///< diameter [m]
    bool alike = true;  ///< all of one radius and mass
    bool plain = true;  ///< all elastic and smooth

    std::vector<GasObstacle> obstacle;
    std::vector<std::uint32_t> everywhere;  ///< obstacles that all discs look at
    std::vector<GasNear> near;              ///< the others, by cells of storage
    std::vector<std::uint32_t> first_near;  ///< of each cell; none if there are none

    double now = 0, now_low = 0;  ///< the clock in two parts
    double begin = 0;             ///< of the last step
    double set_back = 1;          ///< by how much the clock goes back when it has gone twice as far [s]

    double stride = 0, first_stride = 0;  ///< how long blocks foretell at a time [s]
    std::uint32_t made_anew = 0;          ///< how often, for random numbers that are new as well

    GasTally tally;
};
auto members(Maybe_const<GasData> auto& g) {
    auto& [fits, grid, widest, alike, plain, obstacle, everywhere, near, first_near, now, now_low, begin, set_back,
           stride, first_stride, made_anew, tally] = g;
    return std::tie(fits, grid, widest, alike, plain, obstacle, everywhere, near, first_near, now, now_low, begin,
                    set_back, stride, first_stride, made_anew, tally);
}

/// Discs with the lists of the cells and the queue of their events, which follow from them.
template <class Queue>
struct GasPart {
    GasDiscs discs;
    GasWindow window;
    GasCells cells;
    Queue queue;
    bool queued = false;  ///< the queue and the lists are those of the discs
};

/// What a gas is made of.
struct GasScene {
    const Events& options;
    const Walls& walls;
    const Bodies& bodies;
    const std::vector<Piece>& pieces;
    Vec2 gravity{};
    int threads = 1;
    GasCompany* company = nullptr;  ///< bodies that are moved in steps; among the others they are as if fixed
};

/// The bodies that fly.
struct MovingDiscs {
    std::vector<std::size_t> row;
    std::vector<Vec2> centre;
    std::vector<double> radius;
};
MovingDiscs moving_discs(const Bodies& bodies, const State& state);

/// An Error that names what the method cannot do: of the bodies and the walls as they are now. With the option `relax`
/// discs that overlap or lie outside the room are moved apart instead; returns how far the farthest [m].
double check_gas(const GasScene& scene, State& state);

/// Moves discs until none overlaps; an Error if that does not come to an end.
double relax_gas(const GasScene& scene, State& state);

/// Which part of the room the discs fill; 0 if it has no bounds.
double packing_fraction(const GasScene& scene);

/// Makes the data anew from a state. Of its own clock this is the time 0.
void fill_gas(const GasScene& scene, const State& state, GasData& gas, GasDiscs& discs);

}  // namespace carom
