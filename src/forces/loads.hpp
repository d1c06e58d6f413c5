#pragma once
#include <cmath>
#include <cstdint>
#include <span>

#include "math/elementary.hpp"
#include "state/motion.hpp"
#include "state/row_ranges.hpp"

namespace carom {

using Row = std::uint32_t;

/// What forces add up into: force [N] and torque [N m] a body, and the flows into the ledger. Forces between bodies
/// give no momentum to the whole: they fill energy accounts alone.
struct Loads {
    std::span<Vec2> force;
    std::span<double> torque;
    Flows& flow;
    const RowRanges* some = nullptr;  ///< rows that are looked at, if not all

    /// Whether a force on this row is one of them.
    bool act_on(Row row) const { return !some || some->contains(row); }
    /// Calls act(row) for those from first to last − 1.
    template <class Act>
    void each_row(Row first, Row last, const Act& act) const {
        const auto each = [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i) act(static_cast<Row>(i));
        };
        some ? some->within(first, last, each) : each(first, last);
    }
};

/// A point of a body, seen from its centre, turned into the world's frame.
inline Vec2 turned(Vec2 point, double angle) {
    if (point == Vec2{} || angle == 0) return point;
    const auto turn = portable::sincos(angle);
    return {turn.cos * point.x - turn.sin * point.y, turn.sin * point.x + turn.cos * point.y};
}

}  // namespace carom
