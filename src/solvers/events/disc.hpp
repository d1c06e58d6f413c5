#pragma once
// What the exact gas knows of a disc. Two records of a cache line between them: what predictions of others read, and
// what its own event needs.

#include <carom/vec2.hpp>
#include <cstdint>
#include <limits>

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
    Vec2 x{};                ///< from the middle of its cell, at its clock [m]
    Vec2 v{};                ///< [m/s]
    double clock = 0;        ///< [s]
    std::uint32_t hits = 0;  ///< how often its velocity has changed: an event that expected another number is void
    Slot next_in_cell = no_slot;
    Cell cell{};
    Slot partner = no_slot;                 ///< of the next hit: a disc, an obstacle from first_obstacle on, or none
    std::int32_t turns_x = 0, turns_y = 0;  ///< how often it went around what is rolled up
};
static_assert(sizeof(GasDisc) == 64);

/// A disc's one event, and its place in the queue.
struct GasEvent {
    double due = 0;                           ///< the earlier of the next hit and of leaving the cell [s]
    double hit = 0;                           ///< the next hit alone
    std::uint32_t partner_hits = 0;           ///< of the partner, when the hit was foreseen
    std::uint32_t row = 0;                    ///< of the body: settles the order of events at the same instant
    Slot next = no_slot, previous = no_slot;  ///< in the queue's list
};
static_assert(sizeof(GasEvent) == 32);

inline bool earlier(const GasEvent& a, const GasEvent& b) { return a.due < b.due || (a.due == b.due && a.row < b.row); }

}  // namespace carom
