#include "solvers/events/queue.hpp"

#include <algorithm>

#include "state/pages.hpp"

namespace carom {

namespace {
constexpr double events_a_day = 3;
}  // namespace

void Calendar::fill(std::vector<GasEvent>& events, double now) {
    // Half of the discs have their event within the median time, and then another one soon.
    std::vector<double> due;
    for (const GasEvent& event : events)
        if (event.due < gas_never) due.push_back(event.due);
    double page = 1;
    if (!due.empty()) {
        std::nth_element(due.begin(), due.begin() + static_cast<std::ptrdiff_t>(due.size() / 2), due.end());
        page = due[due.size() / 2] - now;
    }
    days_ = 64;
    while (days_ < events.size()) days_ *= 2;
    reserve_large(first_, days_ + 1);
    first_.assign(days_ + 1, no_slot);
    per_day_ = page > 0 ? static_cast<double>(events.size()) / events_a_day / page : 1;
    if (!(per_day_ < gas_never)) per_day_ = 1;
    begins_ = now;
    today_ = 0, taken_ = 0;
    for (Slot slot = 0; slot < events.size(); ++slot) link(events, slot);
}

Slot Calendar::next(std::vector<GasEvent>& events) {
    for (;;) {
        while (today_ < days_ && first_[today_] == no_slot) ++today_;
        if (today_ < days_) break;
        if (!turn_page(events)) return no_slot;
    }
    Slot best = first_[today_];
    for (Slot other = events[best].next; other != no_slot; other = events[other].next)
        if (earlier(events[other], events[best])) best = other;
    ++taken_;
    return best;
}

/// The first day again, at the earliest event of those that were put off; false if nothing will ever happen.
bool Calendar::turn_page(std::vector<GasEvent>& events) {
    double first = gas_never;
    for (Slot slot = first_[days_]; slot != no_slot; slot = events[slot].next)
        first = std::min(first, events[slot].due);
    if (first == gas_never) return false;
    // Only how fast the queue is depends on the length of a day.
    const double wanted = events_a_day * static_cast<double>(days_), found = static_cast<double>(taken_) + 1;
    if (found > 2 * wanted || found < 0.5 * wanted) per_day_ *= std::clamp(found / wanted, 0.25, 4.0);
    begins_ = first;
    today_ = 0, taken_ = 0;
    Slot slot = first_[days_];
    first_[days_] = no_slot;
    while (slot != no_slot) {
        const Slot after = events[slot].next;
        link(events, slot);
        slot = after;
    }
    return true;
}

void Calendar::shift(std::vector<GasEvent>& events, double by) {
    // Anew, for the day of an event must not depend on when it was put there.
    begins_ -= by;
    std::fill(first_.begin(), first_.end(), no_slot);
    for (Slot slot = 0; slot < events.size(); ++slot) link(events, slot);
}

void SortedQueue::fill(std::vector<GasEvent>& events, double) {
    sorted_.clear();
    for (Slot slot = 0; slot < events.size(); ++slot)
        if (events[slot].due < gas_never) sorted_.insert({events[slot].due, events[slot].row, slot});
}

void SortedQueue::change(std::vector<GasEvent>& events, Slot slot, double due) {
    GasEvent& event = events[slot];
    sorted_.erase({event.due, event.row, slot});
    event.due = due;
    if (due < gas_never) sorted_.insert({due, event.row, slot});
}

void SortedQueue::shift(std::vector<GasEvent>& events, double) { fill(events, 0); }

}  // namespace carom
