#pragma once
// Which disc's event is next. Each disc has exactly one event, so that the queues hold slots.

#include <cstddef>
#include <set>
#include <tuple>
#include <vector>

#include "solvers/events/disc.hpp"

namespace carom {

/// A calendar of lists, in constant time: as many days as there are discs, a day as long as a few events take, and a
/// list for what lies beyond the last day (R. Brown, Commun. ACM 31, 1220 (1988); G. Paul, J. Comput. Phys. 221, 615
/// (2007), whose current day is a tree; here it is a list of a few, and searched).
class Calendar {
  public:
    /// Makes the queue of these events, at a time before all of them.
    void fill(std::vector<GasEvent>& events, double now);
    /// The slot with the next event; no_slot if there is none.
    Slot next(std::vector<GasEvent>& events);
    /// A disc has another event, not before that which is next.
    void change(std::vector<GasEvent>& events, Slot slot, double due) {
        unlink(events, slot);
        events[slot].due = due;
        link(events, slot);
    }
    /// The events happen earlier by so much, as they say already.
    void shift(std::vector<GasEvent>& events, double by);

    /// Calls f(slot) for every disc whose event is so many days after that of the last `next`. The days are numbered.
    template <class F>
    void for_day(const std::vector<GasEvent>& events, std::size_t ahead, F f) const {
        if (today_ + ahead >= days_) return;
        for (Slot slot = first_[today_ + ahead]; slot != no_slot; slot = events[slot].next) f(slot);
    }
    /// The one in such a place of that day's list.
    Slot on_day(const std::vector<GasEvent>& events, std::size_t ahead, std::size_t place) const {
        if (today_ + ahead >= days_) return no_slot;
        Slot slot = first_[today_ + ahead];
        for (; place > 0 && slot != no_slot; --place) slot = events[slot].next;
        return slot;
    }
    std::size_t today() const { return today_; }

  private:
    void link(std::vector<GasEvent>& events, Slot slot) {
        GasEvent& event = events[slot];
        const double day = (event.due - begins_) * per_day_;
        // The comparison also sends an infinite day, and one too late for an index, beyond the last.
        std::size_t list = day < static_cast<double>(days_) ? static_cast<std::size_t>(day > 0 ? day : 0) : days_;
        list = list < today_ ? today_ : list;
        const Slot first = first_[list];
        event.next = first;
        event.previous = first_list | static_cast<Slot>(list);
        if (first != no_slot) events[first].previous = slot;
        first_[list] = slot;
    }
    void unlink(std::vector<GasEvent>& events, Slot slot) {
        const GasEvent& event = events[slot];
        if (event.next != no_slot) events[event.next].previous = event.previous;
        if (event.previous >= first_list)
            first_[event.previous & ~first_list] = event.next;
        else
            events[event.previous].next = event.next;
    }
    bool turn_page(std::vector<GasEvent>& events);

    static constexpr Slot first_list = 0x80000000;  ///< as `previous`: the list whose first it is

    std::vector<Slot> first_;  ///< of each day's list; the last one is for later
    std::size_t days_ = 0, today_ = 0;
    double begins_ = 0;      ///< the first day [s]
    double per_day_ = 1;     ///< days a second
    std::size_t taken_ = 0;  ///< events since the first day
};

/// The plain one that tests hold the calendar against.
class SortedQueue {
  public:
    void fill(std::vector<GasEvent>& events, double now);
    Slot next(const std::vector<GasEvent>&) const { return sorted_.empty() ? no_slot : std::get<2>(*sorted_.begin()); }
    void change(std::vector<GasEvent>& events, Slot slot, double due);
    void shift(std::vector<GasEvent>& events, double by);

    template <class F>
    void for_day(const std::vector<GasEvent>&, std::size_t, F) const {}
    Slot on_day(const std::vector<GasEvent>&, std::size_t, std::size_t) const { return no_slot; }
    std::size_t today() const { return 0; }

  private:
    std::set<std::tuple<double, std::uint32_t, Slot>> sorted_;
};

}  // namespace carom
