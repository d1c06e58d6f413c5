#pragma once
// What the exact gas knows of a disc. Two records of a cache line between them: what predictions of others read, and
// what its own event needs.

#include <carom/archive.hpp>
#include <carom/vec2.hpp>
#include <cstdint>
#include <limits>
#include <vector>

namespace carom {

using Slot = std::uint32_t;  ///< of a disc in the arrays of the gas, which are in the order of cells, not of rows
inline constexpr Slot no_slot = 0xffffffff;
inline constexpr double gas_never = std::numeric_limits<double>::infinity();
/// Partners from here on are obstacles.
inline constexpr std::uint32_t first_obstacle = 0x80000000;

/// A cell of the grid, in storage: a plane without end, and a periodic box, are rolled up.
struct Cell {
    std::uint16_t x = 0, y = 0;
    bool operator==(const Cell&) const = default;
};

struct alignas(64) GasDisc {
    Vec2 x{};                     ///< from the middle of its cell, at its clock [m]
    Vec2 v{};                     ///< [m/s]
    double clock = 0;             ///< [s]
    std::uint32_t hits = 0;       ///< how often its velocity has changed: an event that expected another number is void
    Slot next_in_cell = no_slot;  ///< where many are in a cell
    Cell cell{};
    Slot partner = no_slot;                 ///< of the next hit: a disc, an obstacle from first_obstacle on, or none
    std::int32_t turns_x = 0, turns_y = 0;  ///< how often it went around what is rolled up
};
static_assert(sizeof(GasDisc) == 64);
/// Whom nobody meets.
inline constexpr GasDisc nobody{.x = {gas_never, gas_never}, .hits = 0xffffffff};

/// A disc's one event.
struct GasEvent {
    double due = 0;                  ///< the earlier of the next hit and of leaving the cell [s]
    double hit = 0;                  ///< the next hit alone
    std::uint32_t partner_hits = 0;  ///< of the partner, when the hit was foreseen
    std::uint32_t row = 0;           ///< of the body: settles the order of events at the same instant
};
static_assert(sizeof(GasEvent) == 24);

/// How a disc turns.
struct GasSpin {
    double angle = 0, velocity = 0, clock = 0;
};

/// What the rule against inelastic collapse remembers of a disc.
struct GasPast {
    double last_hit = 0;
    std::uint64_t short_flights = 0;  ///< in a row
};

/// The discs of a gas, or of a part of it: an entry for each, in the order of cells at first.
struct GasDiscs {
    std::vector<GasDisc> disc;  ///< and one more at the end, for empty cells
    std::vector<GasEvent> event;
    std::vector<double> radius, inverse_mass;  ///< one number if all are alike
    std::vector<GasSpin> spin;                 ///< none if nothing turns
    std::vector<GasPast> past;                 ///< none where no energy is lost

    Slot size() const { return static_cast<Slot>(event.size()); }
};
auto members(Maybe_const<GasDiscs> auto& discs) {
    auto& [disc, event, radius, inverse_mass, spin, past] = discs;
    return std::tie(disc, event, radius, inverse_mass, spin, past);
}

}  // namespace carom
