#pragma once
// A part of GasRun: memory asked for in time, in a gas that no cache near the processor holds. Nothing is computed with
// it.

#include <algorithm>
#include <type_traits>

#include "solvers/events/run.hpp"

namespace carom {

/// How many events before one what it needs is asked for: its partner and the cells around, then the discs in there,
/// then those around its partner.
inline constexpr std::size_t fetch_far = 10, fetch_soon = 6, fetch_next = 3;

/// The disc that is hit at a disc's event, if it is one; otherwise one that nobody meets.
template <class Queue>
Slot GasRun<Queue>::struck_by(Slot i) const {
    return std::min(discs_.disc[i].partner, none_);
}

template <class Queue>
void GasRun<Queue>::fetch_ahead() {
    if constexpr (std::is_same_v<Queue, Calendar>) {
        Queue& queue = part_.queue;
        queue.scout([this](Slot i) { prefetch(&discs_.disc[i]), prefetch(&discs_.event[i]); });
        const std::span<const Calendar::Entry> today = queue.today();
        if (today.size() <= fetch_far) return;
        const auto fetch_discs = [this](Slot j) { prefetch(&discs_.disc[std::min(j, none_)]); };
        const Slot far = today[fetch_far].slot, soon = today[fetch_soon].slot, next = today[fetch_next].slot;
        const Slot partner = struck_by(far);
        prefetch(&discs_.disc[partner]), prefetch(discs_.event.data() + partner);
        queue.fetch_link(partner);
        part_.cells.fetch_around(discs_.disc[far].cell);
        part_.cells.for_first_around(discs_.disc[soon].cell, fetch_discs);
        if (const Slot j = struck_by(soon); j != none_) {
            part_.cells.fetch_around(discs_.disc[j].cell);
            queue.fetch_ring(j);
        }
        if (const Slot j = struck_by(next); j != none_) part_.cells.for_first_around(discs_.disc[j].cell, fetch_discs);
    }
}

}  // namespace carom
