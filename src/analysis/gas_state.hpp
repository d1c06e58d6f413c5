#pragma once
// What a GasMeter keeps: gas.cpp fills it, gas_results.cpp makes numbers, curves and fields of it.

#include <array>
#include <carom/gas.hpp>

#include "analysis/blocks.hpp"
#include "analysis/diffusion.hpp"
#include "analysis/measured_room.hpp"
#include "collision/grid.hpp"

namespace carom {

struct GasMeter::State {
    static constexpr std::size_t speed_bins = 40, distance_bins = 60, height_bins = 40, lags = 50, cells = 16;
    static constexpr std::size_t longest_lag = lags - 1, half_lag = lags / 2;
    static constexpr double fastest = 4;  // in units of √(kT/m)
    static constexpr double highest = 8;  // in units of kT/(m g), where there is no lid

    /// Where each sum lies in the samples.
    enum Sum : std::size_t {
        one,
        time_passed,
        temperature,
        virial,
        wall_impulse,
        disc_collisions,
        speed,
        drift_x,  ///< of a box that moves as a whole
        drift_y,
        looks,       ///< at distances
        references,  ///< discs from which they were measured
        speeds,
        pair_distances = speeds + speed_bins,
        ways = pair_distances + distance_bins,
        memory = ways + lags,
        origins = memory + lags,
        heights = origins + lags,
        in_cells = heights + height_bins,
        count = in_cells + 5 * cells * cells
    };
    /// What is summed up in a cell.
    enum Part : std::size_t { discs_in, momentum_x, momentum_y, kinetic_in, mass_in, parts };
    static_assert(count == in_cells + parts * cells * cells);

    MeasuredRoom room;
    std::vector<BodyId> ids;
    std::vector<std::size_t> rows;
    std::vector<std::size_t> followed;  // among the rows
    double unit = 1;                    ///< kT at the start [J], by which speeds are binned
    double widest = 0;                  ///< disc [m]
    double mean_radius = 0, mass = 0;   ///< mass of all [kg]
    bool counts = false;
    bool falls = false;   ///< there is gravity
    bool pushed = false;  ///< what is no disc of the gas moves: there is no one room, and no one pressure

    /// Where gravity pulls, and how far up discs are counted.
    struct Column {
        Vec2 up{};
        double floor = 0, top = 0;  ///< [m]
        double scale = 0;           ///< kT/(m g) [m]; 0 without gravity
        double lid = 0;             ///< height above the floor to which centres can be [m]; 0 if there is none
    } column;
    bool is_column = false;  ///< of equal masses, as wide above as below: it has the law of an ideal gas

    double last_time = 0, step = 0;
    std::uint64_t frames = 0;
    GasTally last;
    std::vector<GasFrame> past;  ///< the last ones, the newest first
    Blocks blocks{count};

    Grid grid;
    std::vector<std::uint32_t> near;

    /// That of the centres, on which the walls push a radius away from them.
    MeasuredRoom inner_room() const { return room.walls ? room.within(mean_radius) : room; }
    double discs() const { return static_cast<double>(rows.size()); }
    /// Whether the discs of a box move as a whole, with all that gravity gives them: a post would stop them.
    bool drifts() const { return room.periodic && room.empty && rows.size() > 1; }
    /// Of two degrees of freedom a disc the momentum of such a box takes two away.
    double moving() const { return discs() - (drifts() ? 1 : 0); }
    /// Why there is no pressure by the virial, none on the walls, or no coefficient of diffusion, in words; empty if
    /// there is one.
    std::string keeps_from_pressing() const;
    std::string keeps_from_pressing_walls() const;
    std::string keeps_from_diffusing() const;
    /// How long the ways are whose growth that is.
    Ways grown_ways() const;
    /// What the mean squared way grows by in the later half of what is looked at, as terms.
    std::array<Blocks::Term, 2> growth_of_ways() const;
    /// Distances that are looked at: from contact to some diameters, and to no image.
    double farthest() const { return std::min(4 * widest, (room.periodic ? 0.5 : 0.125) * room.narrower_side()); }
    /// How far from walls discs are whose neighbours count: next to a wall discs lie in layers, and such are no
    /// neighbours yet.
    double margin() const { return 2 * farthest(); }
    bool has_distances() const { return widest > 0 && room.empty && column.scale == 0; }
    /// Around the discs whose neighbours count [1/m²]: of others, for where one is there is no other.
    double density() const;

    /// The centre of mass of a box that moves as a whole, and its velocity; of all others the frame they are in.
    struct Whole {
        Vec2 place{}, velocity{};
    };
    Whole whole(const World& world) const;
    double heat(const World& world) const;
    void add_velocities(const World& world, std::vector<double>& sums) const;
    void add_distances(const World& world, std::vector<double>& sums);
    void add_ways(const World& world, double passed, std::vector<double>& sums);
    void add_fields(const World& world, std::vector<double>& sums) const;
    void add_heights(const World& world, std::vector<double>& sums) const;
    void measure_column(const World& world);
    GasCurve speed_curve() const;
    GasCurve pair_correlation() const;
    GasCurve height_curve() const;
};

}  // namespace carom
